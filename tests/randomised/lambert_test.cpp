/// Lambert's problem: each returned arc is propagated by Kepler's classical equation, and the number of arcs
/// compared with the minimum times.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"
#include "tests/randomised/kepler_oracle.hpp"

namespace nlmech::orbit::randomised::lambert_test {
namespace {

using nlmech::randomised::Case;
using nlmech::randomised::randomised_test;

LambertProblem any_problem(Draw& draw) {
  LambertProblem p;
  p.mu = draw.log_uniform(1e-6, 1e20);
  const double r = draw.log_uniform(1e-6, 1e12), ratio = draw.chance(0.2) ? 1 : draw.log_uniform(1e-4, 1e4);
  p.from = r * direction(draw);
  Vector3<double> to = direction(draw);
  const double near = draw.log_uniform(1e-16, 1);
  if (draw.chance(0.2)) to = (near * to - p.from / r).normalized();
  if (draw.chance(0.2)) to = (near * to + p.from / r).normalized();
  p.to = r * ratio * to;
  const double size = std::max(r, r * ratio);
  p.time = size * std::sqrt(size / p.mu) *
           draw.log_uniform(draw.chance(0.2) ? 1e-8 : 1e-2, draw.chance(0.2) ? 1e6 : 300);
  if (draw.chance(0.5)) p.normal = direction(draw);
  return p;
}

std::string words(const LambertProblem& p, const LambertArc& arc) {
  return fmt::format(
      "--from {:.17g},{:.17g},{:.17g} --to {:.17g},{:.17g},{:.17g} --time {:.17g} --mu {:.17g} {} {} {}",
      p.from[0], p.from[1], p.from[2], p.to[0], p.to[1], p.to[2], p.time, p.mu,
      arc.long_way ? "--long-way" : "", arc.revolutions, arc.branch == LambertBranch::low ? "low" : "high");
}

/// Does the angular momentum have the requested sign, relative to the plane of the positions or to the given
/// normal?
bool is_on_its_side(const LambertProblem& p, const LambertArc& arc, const LambertSolution& s) {
  const State ends{p.from, p.to}, start{p.from, s.v1};
  const auto wide = as<Real>(ends), leaving = as<Real>(start);
  const Vector3<Real> h = cross(leaving.position, leaving.velocity);
  Vector3<Real> normal = cross(wide.position, wide.velocity);
  if (are_opposite(p)) normal = as<Real>(State{p.from, *p.normal}).velocity;
  return (h.dot(normal) > 0) != arc.long_way;
}

/// Miss of an arc over 8 kappa eps |r_2|. If it exceeds 1e-6 |r_2|, the arc must also pass the centre on the
/// requested side.
Case judged(const LambertProblem& p, const LambertArc& arc, const LambertSolution& s) {
  const State start{p.from, s.v1};
  const KeplerCondition kappa = kepler_condition(start, p.time, p.mu);
  const auto check_end = [&](const auto& end) {
    const double miss = distance(p.to, end.position) / p.to.norm();
    const std::string what = words(p, arc) + fmt::format(" kappa {:.3g}", kappa.position);
    if (!(64 * kappa.position * eps < 1)) return Case::wrong(what);
    if (miss > 1e-6 && !is_on_its_side(p, arc, s)) return Case::wrong("other side: " + what);
    return Case::judged(miss / (kappa.position * eps), 8, what);
  };
  const double share = s.v1.squaredNorm() * p.from.norm() / p.mu;
  const bool plain = std::abs(1 - share) > 1e-2 && std::abs(2 - share) > 1e-2 && share > 1e-2 &&
                     share < 100 && kappa.position < 1e6 &&
                     cross(p.from, s.v1).norm() > 1e-2 * p.from.norm() * s.v1.norm();
  return plain ? check_end(conic<Wide>(start, p.time, p.mu)) : check_end(conic<Real>(start, p.time, p.mu));
}

TEST(RandomisedLambert, EveryArcArrives) {
  randomised_test({.quick = 200, .full = 50'000}, [](Draw& draw) {
    const LambertProblem p = any_problem(draw);
    const LambertArc arc{draw.chance(0.5), draw.chance(0.5) ? 0 : draw.whole(0, 20),
                         draw.chance(0.5) ? LambertBranch::low : LambertBranch::high};
    const LambertSolution s = solve_lambert(p, arc);
    if (!s.status.ok()) return Case::refused();
    if (!s.v1.allFinite() || !s.v2.allFinite()) return Case::wrong(words(p, arc));
    return judged(p, arc, s);
  });
}

/// Minimum time of M revolutions over Lagrange's angle alpha in (0, 2 pi), by golden-section search: t =
/// sqrt(a^3/mu) (2 pi M + alpha - sin alpha - beta + sin beta), a = s/(2 sin^2(alpha/2)), sin(beta/2) =
/// +-lambda sin(alpha/2). For positions a few rounding errors apart lambda is near 1 and the minimum near
/// alpha = pi, where the arcsine loses half of its digits; cos^2(beta/2) = cos^2(alpha/2) + (c/s)
/// sin^2(alpha/2) does not.
Wide least_time_by_angles(const LambertProblem& p, bool long_way, int revolutions) {
  const auto from = as<Wide>(State{p.from, p.to});
  const Wide r1 = length(from.position), r2 = length(from.velocity),
             c = length(Vector3<Wide>(from.velocity - from.position));
  const Wide s = (r1 + r2 + c) / 2, pi = std::numbers::pi_v<Wide>;
  const Vector3<Wide> both = from.position / r1 + from.velocity / r2;
  const Wide lambda = std::sqrt(r1 * r2) * length(both) / (2 * s) * (long_way ? -1 : 1);
  const auto time = [&](Wide alpha) {
    const Wide half = std::sin(alpha / 2), other = std::cos(alpha / 2), a = s / (2 * half * half);
    const Wide beta = 2 * std::atan2(lambda * half, std::sqrt(other * other + c / s * half * half));
    return std::sqrt(a / p.mu) * a * (2 * pi * revolutions + alpha - std::sin(alpha) - beta + std::sin(beta));
  };
  const Wide golden = (std::sqrt(Wide(5)) - 1) / 2;
  Wide low = 1e-6L, high = 2 * pi - 1e-6L;
  for (int i = 0; i < 100; ++i) {
    const Wide x = high - golden * (high - low), y = low + golden * (high - low);
    (time(x) < time(y) ? high : low) = time(x) < time(y) ? y : x;
  }
  return time((low + high) / 2);
}

// There are two arcs of M revolutions if the time exceeds the minimum, and none otherwise.
TEST(RandomisedLambert, NoArcIsMissingAndNoneInvented) {
  randomised_test({.quick = 300, .full = 200'000}, [](Draw& draw) {
    const LambertProblem p = any_problem(draw);
    const bool long_way = draw.chance(0.5);
    const int revolutions = draw.whole(1, 30);
    LambertArc arc{long_way, revolutions, LambertBranch::low};
    const LambertSolution low = solve_lambert(p, arc);
    if (low.status.outcome() == Outcome::outside_validity) return Case::refused();
    const Wide least = least_time_by_angles(p, long_way, revolutions);
    if (std::abs(least / p.time - 1) < 1e-9L) return Case::undecided();
    if (low.status.ok() != (least < p.time)) return Case::wrong(words(p, arc) + " " + low.status.text());
    const double stated = least_time(p, long_way, revolutions);
    if (!low.status.ok())
      return Case::judged(static_cast<double>(std::abs(stated / least - 1)), 64 * eps, words(p, arc));
    arc.branch = LambertBranch::high;
    const LambertSolution high = solve_lambert(p, arc);
    if (high.status.outcome() == Outcome::outside_validity) return Case::refused();
    if (!high.status.ok() || !(low.reciprocal_axis >= high.reciprocal_axis))
      return Case::wrong(words(p, arc));
    return Case::judged(static_cast<double>(std::abs(stated / least - 1)), 64 * eps, words(p, arc));
  });
}

// Finite numbers of any size give finite velocities that reach the end, or a failure with a message.
TEST(RandomisedLambert, AnyFiniteNumbers) {
  randomised_test({.quick = 1000, .full = 200'000, .least_right = 0.001}, [](Draw& draw) {
    LambertProblem p;
    for (int i = 0; i < 3; ++i) p.from[i] = draw.any_finite(), p.to[i] = draw.any_finite();
    p.time = std::abs(draw.any_finite());
    p.mu = std::abs(draw.any_finite());
    const Transfer t =
        corrected_transfer({p.from, p.to, p.time, {.mu = p.mu}}, {draw.chance(0.5), 0, LambertBranch::low});
    if (!t.status.ok()) return t.status.sentence().empty() ? Case::wrong(words(p, {})) : Case::refused();
    if (!t.v1.allFinite() || !t.v2.allFinite()) return Case::wrong(words(p, {}));
    return Case::judged(t.miss / p.to.stableNorm(), largest_miss, words(p, {}));
  });
}

// Results of the command by both methods: within a millionth of the distance.
TEST(RandomisedTransfer, EverySuccessArrives) {
  randomised_test({.quick = 30, .full = 20'000}, [](Draw& draw) {
    const LambertProblem l = any_problem(draw);
    const TransferProblem p{l.from, l.to, l.time, {.mu = l.mu}, l.normal};
    Transfer t;
    if (draw.chance(0.5)) {
      t = collocate(p,
                    {.nodes = draw.whole(10, 60),
                     .basis = draw.one_of({TransferBasis::polynomial, TransferBasis::stable_gaussian}),
                     .guess = draw.one_of({TransferGuess::arc, TransferGuess::line, TransferGuess::random})});
    } else {
      t = corrected_transfer(p, {draw.chance(0.5), draw.whole(0, 5), LambertBranch::low});
    }
    if (!t.status.ok()) return Case::refused();
    const auto end = conic<Real>({p.from, t.v1}, p.time, p.gravity.mu);
    // The reported miss, and 8 kappa eps of its measurement.
    const double kappa = kepler_condition({p.from, t.v1}, p.time, p.gravity.mu).position;
    return Case::judged(distance(p.to, end.position) / p.to.norm(), largest_miss + 8 * kappa * eps,
                        words(l, {}));
  });
}

}  // namespace
}  // namespace nlmech::orbit::randomised::lambert_test

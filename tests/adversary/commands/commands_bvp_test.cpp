/// Random boundary value problems by whole programs: what `rbf_inverse` prints with exit code 0 is integrated
/// from its own begin by other integrators in extended precision.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "tests/adversary/commands/command_run.hpp"
#include "tests/adversary/kepler_oracle.hpp"

namespace nlmech::adversary::commands_bvp_test {
namespace {

using Wide = long double;
constexpr double eps = std::numeric_limits<double>::epsilon();

namespace odeint = boost::numeric::odeint;

/// From 0 to the time with a stepper that controls its error; nothing if it comes to a standstill.
template <class Controlled, std::size_t n, class Rhs, class See>
std::optional<std::array<Wide, n>> integrated(Controlled stepper, const Rhs& rhs, std::array<Wide, n> x,
                                              Wide time, const See& see) {
  Wide t = 0, h = time / 100;
  for (int steps = 0; t < time; ++steps) {
    if (steps > 400'000) return {};
    h = std::min(h, time - t);
    while (stepper.try_step(rhs, x, t, h) != odeint::success) {
      if (!(h > 1e-18L * time)) return {};
    }
    for (const Wide v : x) {
      if (!std::isfinite(v)) return {};
    }
    see(x);
  }
  return x;
}

/// What is prescribed of x1, x2 at the begin and at the end.
struct Prescribed {
  std::array<bool, 2> begin, end;
};
Prescribed prescribed(const std::string& which) {
  if (which == "free") return {{true, true}, {false, false}};
  if (which == "fixed" || which == "harmonic") return {{true, true}, {true, true}};
  if (which == "final-only") return {{false, false}, {true, true}};
  return {{which[1] == '1', which[1] == '2'}, {which[3] == '1', which[3] == '2'}};
}

/// A random task of the Duffing oscillator under an unknown force.
struct Task {
  std::string which, words;
  double time, beta, bound = HUGE_VAL;
  std::array<double, 2> target{}, weights{1, 1};
};

Task any_task(Draw& draw) {
  Task t;
  t.which = draw.one_of({"free", "fixed", "x1x1", "x1x2", "x2x1", "x2x2", "final-only", "harmonic"});
  t.time = draw.log_uniform(1e-2, draw.chance(0.2) ? 20 : 4);
  t.beta = draw.chance(0.1) ? 0 : draw.log_uniform(1e-3, draw.chance(0.2) ? 1e3 : 10);
  t.words = fmt::format("rbf_inverse duffing --case {} --final-time {:.17g} --beta {:.17g}", t.which, t.time,
                        t.beta);
  if (t.which == "harmonic") {
    const double w = 3, T = t.time;  // Eq. 5.34 with amplitudes 1.5, 2, 3
    t.target = {1.5 * std::cos(w * T) + 2 * std::cos(3 * w * T) + 3 * std::cos(w * T / 3),
                -(1.5 * w * std::sin(w * T) + 6 * w * std::sin(3 * w * T) + w * std::sin(w * T / 3))};
  } else {
    for (double& x : t.target)
      x = draw.chance(0.15) ? 0 : draw.signed_log(draw.chance(0.2) ? 1e-8 : 1e-2, 10);
    t.words += fmt::format(" --target {:.17g},{:.17g}", t.target[0], t.target[1]);
    const Prescribed p = prescribed(t.which);
    if (!(p.end[0] && p.end[1]) && draw.chance(0.5)) {
      for (double& s : t.weights) s = draw.chance(0.1) ? 0 : draw.log_uniform(1e-3, 1e4);
      t.words += fmt::format(" --weights {:.17g},{:.17g}", t.weights[0], t.weights[1]);
    }
  }
  if (draw.chance(0.2)) {
    t.bound = draw.log_uniform(draw.chance(0.3) ? 1e-6 : 0.1, 100);
    t.words += fmt::format(" --bound {:.17g}", t.bound);
  }
  return t;
}

/// The printed extremal: cost,x1_0,x2_0,lambda1_0,lambda2_0,x1_T,x2_T,miss.
using Printed = std::array<double, 8>;

/// Its flight under f = -lambda2, within the bound, with the integral of f^2/2.
struct Flight {
  std::array<Wide, 5> end;
  Wide x = 0, lambda = 0;  // greatest on the way
};
std::optional<Flight> fly(const Task& task, const Printed& p) {
  Flight f{};
  const auto see = [&f](const std::array<Wide, 5>& x) {
    f.x = std::max({f.x, std::abs(x[0]), std::abs(x[1])});
    f.lambda = std::max({f.lambda, std::abs(x[2]), std::abs(x[3])});
  };
  const std::array<Wide, 5> start = {p[1], p[2], p[3], p[4], 0};
  see(start);
  const Wide bound = task.bound, beta = task.beta;
  // Dormand and Prince's pair: Fehlberg's estimate of order eight does not see the corner of a clipped force
  // between the ends of a step.
  const auto end = integrated(
      odeint::make_controlled(1e-22L, 1e-14L, odeint::runge_kutta_dopri5<std::array<Wide, 5>, Wide>()),
      [bound, beta](const std::array<Wide, 5>& x, std::array<Wide, 5>& d, Wide) {
        const Wide u = std::clamp(-x[3], -bound, bound);
        d = {x[1], u - x[0] - beta * x[0] * x[0] * x[0], x[3] * (1 + 3 * beta * x[0] * x[0]), -x[2],
             u * u / 2};
      },
      start, task.time, see);
  if (!end) return {};
  f.end = *end;
  return f;
}

/// What is left of all conditions, in units of a share of the largest state and co-state on the way.
std::pair<double, std::string> left_of(const Task& t, const Printed& p, const Flight& f) {
  const bool bounded = std::isfinite(t.bound);
  // The smoothing of a bound is 1e-5 of it, for a tenth of the way or less near a corner; else the solver's
  // share.
  const double share = bounded ? 1e-6 : 1e-9, force = bounded ? 1e-6 * t.bound : 0;
  const double x = static_cast<double>(f.x), natural = x * (1 + t.beta * x * x + 1 / (t.time * t.time));
  const double x_unit = 1e-9 * x + force * t.time * std::max(1.0, t.time) + 1e-20;
  // Co-states that vanish have the rounding of what they might be.
  const double l_unit = share * static_cast<double>(f.lambda) + 4 * eps * natural * std::max(1.0, 1 / t.time);
  const Prescribed given = prescribed(t.which);
  std::pair<double, std::string> worst{0, "nothing"};
  const auto hold = [&](double left, const std::string& what) {
    if (!(left <= worst.first)) worst = {left, what};
  };
  double cost = static_cast<double>(f.end[4]);
  for (std::size_t i = 0; i < 2; ++i) {
    const double end = static_cast<double>(f.end[i]), l = static_cast<double>(f.end[i + 2]), s = t.weights[i];
    const std::string name = std::to_string(i + 1);
    hold(given.begin[i] ? std::abs(p[i + 1]) / x_unit : std::abs(p[i + 3]) / l_unit, "begin of " + name);
    hold(std::abs(end - p[i + 5]) / x_unit, "printed end of x" + name);
    if (given.end[i]) {
      hold(std::abs(end - t.target[i]) / x_unit, "end of x" + name);
    } else {
      cost += s * (end - t.target[i]) * (end - t.target[i]) / 2;
      hold(std::abs(l - s * (end - t.target[i])) / (l_unit + s * x_unit), "transversality of " + name);
    }
  }
  hold(std::abs(cost - p[0]) / (share * cost + 1e-20), "cost");
  return worst;
}

Case control(Draw& draw) {
  const Task t = any_task(draw);
  const Ran r = ran(t.words, 20);
  if (const auto failure = failed(r)) return *failure;
  Printed p{};
  if (r.rows.size() != 1 || r.rows[0].size() != p.size()) return Case::wrong(r.words + ": rows");
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = number(r.rows[0][i]);
  const auto flight = fly(t, p);
  if (!flight) return Case::wrong(r.words + ": cannot be integrated");
  const auto [left, what] = left_of(t, p, *flight);
  return Case::judged(left, 1, fmt::format("{}: {}; printed {}", r.words, what, fmt::join(r.rows[0], ",")));
}

TEST(AdversaryCommands, ExtremalsArriveAtTheirCost) {
  if (const std::string what = missing_program("rbf_inverse"); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 8, .full = 1'000}, control);
}

}  // namespace

namespace {

using orbit::State;
using orbit::Vector3;
namespace oracle = orbit::adversary;

std::string triple(const Vector3<double>& v) {
  return fmt::format("{:.17g},{:.17g},{:.17g}", v[0], v[1], v[2]);
}

/// A random arc, as the command takes it.
struct Arc {
  orbit::LambertProblem p;
  double j2 = 0, radius = 0;
  std::string words;
};
Arc any_arc(Draw& draw) {
  Arc a;
  a.p.mu = draw.log_uniform(1e-3, 1e18);
  const double r = draw.log_uniform(1e-3, 1e12), ratio = draw.chance(0.2) ? 1 : draw.log_uniform(0.05, 20);
  a.p.from = r * oracle::direction(draw);
  a.p.to = r * ratio * oracle::direction(draw);
  const double size = std::max(r, r * ratio);
  a.p.time = size * std::sqrt(size / a.p.mu) * draw.log_uniform(1e-2, draw.chance(0.2) ? 1e3 : 30);
  a.words = fmt::format("rbf_inverse lambert --from {} --to {} --time {:.17g} --mu {:.17g}", triple(a.p.from),
                        triple(a.p.to), a.p.time, a.p.mu);
  if (orbit::are_opposite(a.p)) {
    a.p.normal = oracle::direction(draw);
    a.words += " --plane " + triple(*a.p.normal);
  }
  if (draw.chance(0.3)) a.words += " --long-way";
  if (draw.chance(0.3))
    a.words += fmt::format(" --revolutions {} --branch {}", draw.whole(1, 8), draw.one_of({"low", "high"}));
  if (draw.chance(0.15)) a.words += " --method collocation";
  if (draw.chance(0.3)) {
    a.j2 = draw.signed_log(1e-6, 1e-2);
    a.radius = std::min(r, r * ratio) * draw.log_uniform(0.1, 1);
    a.words += fmt::format(" --zonal {:.17g} --radius {:.17g}", a.j2, a.radius);
  }
  return a;
}

/// The flight under a point mass and J2, in units of the begin's distance and of its circular motion.
std::optional<std::array<Wide, 6>> fly(const Arc& a, const Vector3<double>& v) {
  const Wide unit = a.p.from.norm(), speed = std::sqrt(Wide(a.p.mu) / unit), j = Wide(a.j2) * 1.5L,
             R = a.radius / unit;
  std::array<Wide, 6> s{};
  for (std::size_t i = 0; i < 3; ++i)
    s[i] = a.p.from[static_cast<Eigen::Index>(i)] / unit, s[i + 3] = v[static_cast<Eigen::Index>(i)] / speed;
  auto end = integrated(
      odeint::make_controlled(1e-17L, 1e-17L, odeint::runge_kutta_fehlberg78<std::array<Wide, 6>, Wide>()),
      [j, R](const std::array<Wide, 6>& x, std::array<Wide, 6>& d, Wide) {
        const Wide r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2], q = 1 / (r2 * std::sqrt(r2));
        const Wide w = j * R * R / r2, z = 5 * x[2] * x[2] / r2;
        d = {x[3],
             x[4],
             x[5],
             -q * x[0] * (1 + w * (1 - z)),
             -q * x[1] * (1 + w * (1 - z)),
             -q * x[2] * (1 + w * (3 - z))};
      },
      s, a.p.time * speed / unit, [](const auto&) {});
  if (!end) return {};
  for (std::size_t i = 0; i < 3; ++i) (*end)[i] *= unit, (*end)[i + 3] *= speed;
  return end;
}

/// The arrival by Kepler's classical equation, or with J2 by integration.
std::optional<std::pair<Vector3<Wide>, Vector3<Wide>>> arrival(const Arc& a, const Vector3<double>& v) {
  std::pair<Vector3<Wide>, Vector3<Wide>> at;
  if (a.j2 == 0) {
    const auto end = oracle::conic<oracle::Real>({a.p.from, v}, a.p.time, a.p.mu);
    for (int i = 0; i < 3; ++i)
      at.first[i] = static_cast<Wide>(end.position[i]), at.second[i] = static_cast<Wide>(end.velocity[i]);
    return at;
  }
  const auto end = fly(a, v);
  if (!end) return {};
  for (int i = 0; i < 3; ++i)
    at.first[i] = (*end)[static_cast<std::size_t>(i)], at.second[i] = (*end)[static_cast<std::size_t>(i) + 3];
  return at;
}

// The miss is no more than a millionth of the distance, as the page says, and it is the one that is printed:
// to its three digits and to what the data determine. So is the velocity at the arrival, to what a millionth
// of the distance changes it.
Case transfer(Draw& draw) {
  const Arc a = any_arc(draw);
  const Ran r = ran(a.words, 10);
  if (const auto failure = failed(r)) return *failure;
  if (r.rows.size() != 1 || r.rows[0].size() != 7) return Case::wrong(r.words + ": rows");
  Vector3<double> v0, v1;
  for (int i = 0; i < 3; ++i)
    v0[i] = number(r.rows[0][static_cast<std::size_t>(i)]),
    v1[i] = number(r.rows[0][static_cast<std::size_t>(i) + 3]);
  const auto end = arrival(a, v0);
  if (!end) return Case::undecided(r.words);
  const orbit::KeplerCondition kappa = orbit::kepler_condition({a.p.from, v0}, a.p.time, a.p.mu);
  const double distance = a.p.to.norm(), printed = number(r.rows[0][6]);
  const double miss = oracle::distance(a.p.to, end->first);
  const double rounding = 16 * kappa.position * eps * distance;
  if (rounding > 1e-7 * distance) return Case::undecided(r.words);
  const double speed = v1.norm();
  const double apart =
      oracle::distance(v1, end->second) / (speed * (16 * kappa.velocity * eps + 1e-6 * (1 + kappa.velocity)));
  const double unsaid = std::abs(miss - printed) / (rounding + 0.01 * printed);
  return Case::judged(std::max({miss / (1e-6 * distance + rounding), unsaid, apart}), 1,
                      fmt::format("{}: printed {}, miss {:.3g}, kappa {:.3g}, velocity {:.3g}", r.words,
                                  fmt::join(r.rows[0], ","), miss, kappa.position, apart));
}

TEST(AdversaryCommands, TransfersArriveAsPrinted) {
  if (const std::string what = missing_program("rbf_inverse"); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 20, .full = 5'000}, transfer);
}

}  // namespace
}  // namespace nlmech::adversary::commands_bvp_test

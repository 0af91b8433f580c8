/// Random toggles: limit points, bifurcation points and equilibria against dense eigenvalues, long double,
/// scans of a function of one unknown, and paths with other step sizes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/toggle_path.hpp"
#include "tests/randomised/randomised.hpp"

namespace nlmech::randomised::frames_test {
namespace {

using algebraic::CriticalPoint;
using algebraic::Path;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using frames::Toggle;
using frames::ToggleFrame;

constexpr double eps = std::numeric_limits<double>::epsilon();

Toggle random_toggle(Draw& draw, int elements) {
  Toggle t;
  t.height = draw.log_uniform(0.05, 12.9);
  t.ea *= draw.chance(0.5) ? 1 : draw.log_uniform(0.03, 30);
  t.elements = draw.whole(1, elements);
  return t;
}

std::string words_of(const Toggle& t) {
  return fmt::format("height {:.17g}, EA {:.17g}, {} elements", t.height, t.ea, t.elements);
}

/// All critical points of a path with the given first load and turn.
Status walk(const ToggleFrame& whole, const Toggle& t, double first, double turn,
            std::vector<CriticalPoint>& found) {
  frames::LoadedFrame equations(whole.frame, whole.load);
  Path path({.first = first, .turn = turn}, equations, VectorXd::Zero(whole.frame.size()), 0);
  const Status status = path.start();
  if (!status.ok()) return status;
  const auto is_through = [&](const Path& p) {
    return -p.now().x[whole.apex] >= 2.2 * t.height && p.now().slope > 0 && p.now().negative == 0;
  };
  return follow(path, is_through, 4000, found);
}

/// The smallest eigenvalue of the dense tangent, with rows and columns scaled by the tangent at rest; |F| in
/// long double relative to the terms of axial forces and displacements.
struct Singular {
  double eigenvalue = 0, force = 0;
};

MatrixXd tangent_of(const ToggleFrame& whole, const VectorXd& x) {
  Eigen::SparseMatrix<double> k;
  static_cast<void>(whole.frame.tangent<double>(x, k));
  return MatrixXd(k);
}

Singular singular_at(const ToggleFrame& whole, const CriticalPoint& c) {
  frames::Frame::Displacements<long double> f;
  if (!whole.frame.force<long double>(c.point.x.cast<long double>(), f).ok()) return {1, HUGE_VAL};
  f -= static_cast<long double>(c.point.load) * whole.load.cast<long double>();
  const MatrixXd rest = tangent_of(whole, VectorXd::Zero(c.point.x.size())), k = tangent_of(whole, c.point.x);
  const VectorXd scale = rest.diagonal().cwiseSqrt();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(
      MatrixXd(k.array() / (scale * scale.transpose()).array()), Eigen::EigenvaluesOnly);
  return {spectrum.eigenvalues().cwiseAbs().minCoeff(),
          static_cast<double>(f.norm()) /
              ((rest.cwiseAbs() * c.point.x.cwiseAbs()).norm() + std::abs(c.point.load))};
}

TEST(RandomisedFrames, CriticalPointsAreSingularAndTheSameForEveryStep) {
  randomised_test({.quick = 12, .full = 3'000, .least_right = 0.3}, [](Draw& draw) {
    Toggle t = random_toggle(draw, 12);
    t.full = true;
    const ToggleFrame whole = make_frame(t);
    const double stiffness =
        frames::Williams{.height = t.height, .length = t.length, .ea = t.ea}.stiffness(0.);
    const double first = t.height * stiffness * draw.log_uniform(1e-4, 1);
    std::vector<CriticalPoint> found;
    const Status status = walk(whole, t, first, draw.uniform(0.1, 0.5), found);
    if (!status.ok()) return Case::refused(status.text());
    const std::string what = fmt::format("{}, first {:.6g}", words_of(t), first);
    double worst = 0;
    for (const CriticalPoint& c : found) {
      const Singular s = singular_at(whole, c);
      // Bifurcation points are interpolated within a twentieth of a step.
      worst = std::max({worst, s.eigenvalue / 1e-6, s.force / 1e-9});
    }
    // A path with short steps.
    Toggle own = t;
    const frames::TogglePath other = critical_points(own);
    std::vector<CriticalPoint> fine;
    if (!walk(whole, t, std::min(first, 0.001 * t.height * stiffness), 0.06, fine).ok() || !other.status.ok())
      return Case::undecided(what);
    const double scale = std::abs(found.empty() ? 1 : found[0].point.load);
    if (fine.size() != found.size() || other.events.size() != found.size())
      return Case::wrong(fmt::format("{}: {}, {} and {} critical points", what, found.size(), fine.size(),
                                     other.events.size()));
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (fine[i].kind != found[i].kind) return Case::wrong(what + ": other kinds");
      worst = std::max(worst, std::abs(fine[i].point.load - found[i].point.load) / (1e-6 * scale));
    }
    return Case::judged(worst, 1, what);
  });
}

/// Load of the half toggle of one element at a drop, minus @p load, in long double.
long double rest_of(const ToggleFrame& half, double drop, double load) {
  frames::Frame::Displacements<long double> f;
  const frames::Frame::Displacements<long double> x =
      frames::Frame::Displacements<long double>::Constant(1, -static_cast<long double>(drop));
  const Status status = half.frame.force<long double>(x, f);
  return status.ok() ? f[0] / static_cast<long double>(half.load[0]) - static_cast<long double>(load)
                     : std::numeric_limits<long double>::quiet_NaN();
}

/// Drops at which a half toggle of one element carries a load, ascending, by a scan of its one unknown.
std::vector<double> drops_of(const ToggleFrame& half, double load, double end) {
  const auto rest = [&](double drop) {
    VectorXd f;
    const Status status = half.frame.force<double>(VectorXd::Constant(1, -drop), f);
    return status.ok() ? f[0] / half.load[0] - load : std::nan("");
  };
  std::vector<double> drops;
  constexpr int parts = 3000;
  const double begin = load < 0 ? -end : 0;
  double low = begin, at_low = rest(low);
  for (int i = 1; i <= parts; ++i) {
    double a = low, b = begin + (end - begin) * i / parts;
    const double at_b = rest(b);
    low = b;
    const double before = std::exchange(at_low, at_b);
    if (!((before > 0) != (at_b > 0)) || std::isnan(before) || std::isnan(at_b)) continue;
    for (int k = 0; k < 100; ++k) {
      const double middle = a + (b - a) / 2;
      ((rest(middle) > 0) == (before > 0) ? a : b) = middle;
    }
    drops.push_back(a);
  }
  return drops;
}

TEST(RandomisedFrames, EquilibriaOfOneElementAreThoseOfAScan) {
  const std::vector<std::string> names = {
      "newton", "damped-newton", "broyden", "levenberg-marquardt", "dogleg",         "energy-trust-region",
      "riks",   "crisfield",     "gdc",     "chow-yorke",          "newton-homotopy"};
  randomised_test({.quick = 60, .full = 30'000, .least_right = 0.3}, [&](Draw& draw) {
    Toggle t = random_toggle(draw, 1);
    t.height = draw.log_uniform(0.05, 0.7);  // below the buckling of a member
    const ToggleFrame half = make_frame(t);
    const double load = draw.signed_log(1e-3, 300);
    frames::Equilibrium equations(half.frame, half.load, load);
    VectorXd x = VectorXd::Zero(1);
    algebraic::NamedSolver method{.name = draw.one_of(names), .iterations = 500};
    method.tolerance = draw.log_uniform(1e-12, 1e-6);
    method.scale = std::abs(load) / 2;
    const algebraic::Report report = find_root(method, equations, x);
    if (!report.status.ok()) return Case::refused(report.status.text());
    const std::string what =
        fmt::format("{}, {} under {:.17g}: drop {:.12g}", method.name, words_of(t), load, -x[0]);
    Eigen::SparseMatrix<double> k;
    static_cast<void>(half.frame.tangent<double>(x, k));
    const double slope = std::abs(k.coeff(0, 0));
    // |F| over the slope; near a limit point the square root of |F| over the curvature, about EA/l^3.
    const double distance =
        4 * std::min(report.bound / slope, std::sqrt(report.bound * 1e3 / t.ea) * t.length) + 1e-9 * t.height;
    const std::vector<double> drops = drops_of(half, load, 6 * t.height + 2);
    if (drops.empty() || std::abs(x[0]) > 5 * t.height + 2) return Case::undecided(what);
    double nearest = HUGE_VAL;
    for (const double d : drops) nearest = std::min(nearest, std::abs(d + x[0]));
    const bool is_path = method.name == "riks" || method.name == "crisfield" || method.name == "gdc";
    if (is_path) {  // the first on the path from rest, downwards or upwards
      const auto below = std::lower_bound(drops.begin(), drops.end(), 0.);
      if (load > 0 ? below == drops.end() : below == drops.begin()) return Case::undecided(what);
      const double first = load > 0 ? *below : *(below - 1);
      nearest = std::abs(first + x[0]);
      if (std::abs(x[0]) > std::abs(first)) return Case::judged(nearest, distance, what);
    }
    // The scan misses two roots between neighbouring points, near a limit load.
    const long double behind = rest_of(half, -x[0] - distance, load),
                      ahead = rest_of(half, -x[0] + distance, load);
    return Case::judged((behind > 0) != (ahead > 0) ? 0 : nearest, distance, what);
  });
}

TEST(RandomisedFrames, EquilibriaCarryTheirLoadAndEnergiesAreLeast) {
  randomised_test({.quick = 60, .full = 20'000, .least_right = 0.3}, [](Draw& draw) {
    const Toggle t = random_toggle(draw, 40);
    const ToggleFrame half = make_frame(t);
    const double load = draw.signed_log(1e-2, 1e4);
    frames::Equilibrium equations(half.frame, half.load, load);
    VectorXd x = VectorXd::Zero(half.frame.size());
    algebraic::NamedSolver method{.name = draw.one_of({"energy-trust-region", "riks", "newton"}),
                                  .iterations = 500};
    method.scale = std::abs(load) / 2;
    method.tolerance = draw.log_uniform(1e-14, 1e-4);
    method.to_rounding = draw.chance(0.5);
    const algebraic::Report report = find_root(method, equations, x);
    if (!report.status.ok()) return Case::refused(report.status.text());
    const std::string what = fmt::format("{}, {} under {:.17g}, tolerance {:.3g}", method.name, words_of(t),
                                         load, method.tolerance);
    frames::Frame::Displacements<long double> exact;
    if (!half.frame.force<long double>(x.cast<long double>(), exact).ok())
      return Case::wrong(what + ": no F");
    exact -= (static_cast<long double>(load) * half.load.cast<long double>());
    equations.linearise(x);
    MatrixXd k;
    equations.matrix(k);
    if (method.name == "energy-trust-region") {
      const VectorXd scale = k.diagonal().cwiseAbs().cwiseSqrt();
      const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(
          MatrixXd(k.array() / (scale * scale.transpose()).array()), Eigen::EigenvaluesOnly);
      if (spectrum.eigenvalues()[0] < -1e-9) return Case::wrong(what + ": no minimum");
    }
    // Rounding error of F in double: that of every axial force and every displacement.
    double axial = std::abs(load);
    for (std::size_t i = 0; i < half.frame.members().size(); ++i)
      axial = std::max(axial, std::abs(half.frame.member<double>(x, i).axial_force));
    const double rounding = 64 * eps * ((k.cwiseAbs() * x.cwiseAbs()).norm() + axial);
    return Case::judged(static_cast<double>(exact.norm()), report.bound + rounding, what);
  });
}

TEST(RandomisedFrames, LimitPointsOfWilliamsEquation) {
  randomised_test({.quick = 60, .full = 10'000, .least_right = 0.5}, [](Draw& draw) {
    const double height = draw.log_uniform(0.02, 0.95),
                 stiff = draw.chance(0.5) ? 1 : draw.log_uniform(0.1, 1);
    const frames::Williams w{.height = height, .ea = 1.885e6 * stiff};
    frames::LoadedWilliams equations(w);
    Path path({.first = height * w.stiffness(0.) * draw.log_uniform(1e-3, 1)}, equations, VectorXd::Zero(1),
              0);
    const std::string what = fmt::format("height {:.17g}, EA {:.17g}", height, w.ea);
    Status status = path.start();
    std::vector<CriticalPoint> found;
    if (status.ok())
      status = follow(
          path, [&](const Path& p) { return p.now().x[0] > 2.2 * height; }, 4000, found);
    if (!status.ok()) return Case::refused(status.text());
    std::vector<frames::ToggleEvent> events = critical_points(w).events;
    std::erase_if(events, [](const auto& e) { return e.kind == CriticalPoint::Kind::bifurcation; });
    if (events.size() != found.size())
      return Case::wrong(
          fmt::format("{}: {} limit points by a scan, {} by a path", what, events.size(), found.size()));
    double worst = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (events[i].kind != found[i].kind) return Case::wrong(what + ": other kinds");
      worst = std::max(worst, std::abs(events[i].load - found[i].point.load) / std::abs(events[0].load));
    }
    return Case::judged(worst, 1e-11, what);
  });
}

}  // namespace
}  // namespace nlmech::randomised::frames_test

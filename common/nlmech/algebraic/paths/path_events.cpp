#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/paths/fold.hpp"
#include "nlmech/algebraic/paths/path_step.hpp"
#include "nlmech/algebraic/rounding.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::algebraic {
namespace {

constexpr double one_load = 1e-6;  // of the greatest load: largest error of a corrected load

}  // namespace

PathVector between_by_cubic(const PathPoint& begin, const PathPoint& end, double part) {
  const PathVector &a = begin.at, &b = end.at, &s = begin.tangent, &t = end.tangent;
  const double length = PathVector{b.y - a.y, b.m - a.m}.norm(), u = part, w = 1 - part;
  const double from_a = w * w * (1 + 2 * u), from_b = u * u * (1 + 2 * w), at_a = u * w * w * length,
               at_b = -u * u * w * length;
  return {from_a * a.y + from_b * b.y + at_a * s.y + at_b * t.y,
          from_a * a.m + from_b * b.m + at_a * s.m + at_b * t.m};
}

Outcome Path::between(double part, PathPoint& out) {
  const PathVector chord{now_.at.y - before_.at.y, now_.at.m - before_.at.m};
  const PathVector& normal = before_.tangent;
  const double size = chord.norm();
  out.at = between_by_cubic(before_, now_, part);
  const PathVector gone{out.at.y - before_.at.y, out.at.m - before_.at.m};
  const double missing = part * chord.dot(normal) - gone.dot(normal);
  out.at.y += missing * normal.y;
  out.at.m += missing * normal.m;
  int count = 0;
  Outcome outcome = correct_in_plane(normal, size, out.at, count);
  if (outcome == Outcome::success) outcome = describe(normal, out);
  if (outcome == Outcome::success)
    out.arc = before_.arc + PathVector{out.at.y - before_.at.y, out.at.m - before_.at.m}.norm();
  return outcome;
}

Outcome Path::narrow(const std::function<double(const PathPoint&)>& value, double width, Bracket& bracket,
                     PathPoint& out) {
  // Regula falsi with the Illinois rule; a bisection follows three steps that have not halved the interval.
  auto& [low, low_value, high, high_value] = bracket;
  double last = -1, wide = high - low;
  for (int k = 0; k < 80; ++k) {
    const bool is_slow = k % 3 == 0 && k > 0 && high - low > wide / 2;
    if (k % 3 == 0) wide = high - low;
    double part = (low * high_value - high * low_value) / (high_value - low_value);
    if (is_slow || !(part > low && part < high)) part = low + (high - low) / 2;
    const Outcome outcome = between(part, out);
    if (outcome != Outcome::success) return outcome;
    const double here = value(out);
    if (std::isnan(here)) return Outcome::non_finite;
    if (here == 0 || high - low <= width || std::abs(part - last) <= width) return Outcome::success;
    last = part;
    if ((here > 0) == (low_value > 0)) {
      low = part;
      low_value = here;
      high_value /= 2;
    } else {
      high = part;
      high_value = here;
      low_value /= 2;
    }
  }
  return Outcome::success;
}

double Path::part_of(const PathPoint& point) const {
  const PathVector all{now_.at.y - before_.at.y, now_.at.m - before_.at.m},
      gone{point.at.y - before_.at.y, point.at.m - before_.at.m};
  return gone.dot(before_.tangent) / all.dot(before_.tangent);
}

Outcome Path::fold_in(Bracket bracket, PathPoint& out) {
  const auto slope = [](const PathPoint& p) { return p.slope; };
  const bool is_refined = system_.equations().is_symmetric();
  const double low = bracket.low, high = bracket.high;
  Outcome outcome = narrow(slope, is_refined ? 0.02 * (high - low) : 4 * eps, bracket, out);
  if (outcome != Outcome::success || !is_refined) return outcome;
  PathPoint fine = out;
  Eigen::VectorXd direction = out.tangent.y;
  outcome = refine_fold(system_, fine.at, direction);
  if (outcome == Outcome::success) outcome = describe(out.tangent, fine);
  // Newton's iteration may converge to another limit point; the bracketing cannot.
  const double part = part_of(fine);
  if (outcome != Outcome::success || !(part > low && part < high))
    return narrow(slope, 4 * eps, bracket, out);
  out = fine;
  out.arc = before_.arc + PathVector{out.at.y - before_.at.y, out.at.m - before_.at.m}.norm();
  return outcome;
}

Outcome Path::fold(PathPoint& out) {
  if (!has_passed_fold()) return Outcome::not_converged;
  for (const CriticalPoint& point : critical_) {
    if (point.kind == CriticalPoint::Kind::bifurcation) continue;
    out = point.point;
    return Outcome::success;
  }
  return fold_in({0, before_.slope, 1, now_.slope}, out);
}

/// Slope at a fraction of the step: the parabola through the slopes at both ends with the mean slope of the
/// chord.
double Path::expected_slope(double part) const {
  const double length = PathVector{now_.at.y - before_.at.y, now_.at.m - before_.at.m}.norm();
  const double mean = (now_.at.m - before_.at.m) / length, u = part;
  return before_.slope * (1 - u) * (1 - 3 * u) + now_.slope * u * (3 * u - 2) + mean * 6 * u * (1 - u);
}

/// Searches for a pair of limit points within the step, if the parabola of expected_slope() comes near zero.
/// @p first brackets the first of the pair.
Outcome Path::slope_between(std::optional<Bracket>& first) {
  first.reset();
  const double sign = before_.slope > 0 ? 1 : -1, a = before_.slope, b = now_.slope;
  double middle = 0;
  for (int i = 1; i < 16; ++i) {
    if (sign * expected_slope(i / 16.) < sign * expected_slope(middle)) middle = i / 16.;
  }
  if (middle == 0 || sign * expected_slope(middle) > 0.5 * std::min(std::abs(a), std::abs(b)))
    return Outcome::success;
  // Golden-section search for the smallest slope, until its sign changes.
  PathPoint point;
  Outcome outcome = Outcome::success;
  const auto part = golden_section(0, 1, 29, [&](double at) -> std::optional<double> {
    outcome = between(at, point);
    if (outcome != Outcome::success || sign * point.slope < 0) return std::nullopt;
    return sign * point.slope;
  });
  if (outcome != Outcome::success || !part) return outcome;
  first = Bracket{0, a, *part, point.slope};
  return Outcome::success;
}

Outcome Path::folds(std::vector<PathPoint>& out) {
  out.clear();
  if (has_passed_fold()) {
    out.resize(1);
    return fold(out[0]);
  }
  std::optional<Bracket> first;
  Outcome outcome = slope_between(first);
  if (outcome != Outcome::success || !first) return outcome;
  out.resize(2);
  outcome = fold_in(*first, out[0]);
  return outcome == Outcome::success ? fold_in({first->high, first->high_value, 1, now_.slope}, out[1])
                                     : outcome;
}

Outcome Path::crossing(double load, const PathPoint& begin, const PathPoint& end, PathPoint& out) {
  const double m = load * system_.load_scale();
  const double low = begin.at.m - m, high = end.at.m - m;
  if (low == 0 || high == 0) {
    out = low == 0 ? begin : end;
    PathPoint fine = out;
    if (polish(fine) == Outcome::success) out = fine;
    return system_.residual(out.at) ? Outcome::success : Outcome::non_finite;
  }
  if ((low > 0) == (high > 0)) return Outcome::not_converged;
  Bracket bracket{part_of(begin), low, part_of(end), high};
  const Outcome outcome = narrow([&](const PathPoint& p) { return p.at.m - m; }, 1e-11, bracket, out);
  if (outcome != Outcome::success) return outcome;
  const PathPoint coarse = out;
  out.at.m = m;
  // Near a limit point Newton's iteration at a fixed load fails within the rounding of F; the point found on
  // the path is as near to that load as rounding allows.
  const PathVector all{end.at.y - begin.at.y, end.at.m - begin.at.m};
  if (polish(out) != Outcome::success ||
      PathVector{out.at.y - coarse.at.y, out.at.m - coarse.at.m}.norm() > 1e-2 * all.norm()) {
    // If the load jumps past the wanted one, the two ends are not on one path.
    const double greatest = std::max({std::abs(m), std::abs(begin.at.m), std::abs(end.at.m)});
    if (!(std::abs(coarse.at.m - m) <= one_load * greatest)) return Outcome::not_converged;
    out = coarse;
    out.load = load;
    if (!system_.residual({coarse.at.y, m})) return Outcome::non_finite;
  }
  return Outcome::success;
}

Outcome Path::polish(PathPoint& point) {
  const double m = point.at.m;
  Eigen::VectorXd step(system_.size()), trial;
  double before = HUGE_VAL;
  for (int k = 0; k < 60; ++k) {
    if (!system_.residual(point.at) || !system_.linearise(point.at)) return Outcome::non_finite;
    if (system_.inertia().zero > 0) return Outcome::singular_matrix;
    system_.solve(system_.f(), step);
    ++system_.statistics.newton_iterations;
    const double length = step.norm(), size = point.at.y.norm();
    if (length <= 4 * eps * size) break;
    if (length > 0.9 * before) {
      // Success if changes of x in the last digits cause steps of similar size: rounding.
      const Eigen::VectorXd f = system_.f();
      double noise = eps * size;
      for (std::uint64_t sequence = 0; sequence < 2; ++sequence) {
        perturb_last_bits(point.at.y, sequence, trial);
        if (!system_.residual({trial, m})) return Outcome::non_finite;
        system_.solve(system_.f() - f, trial);
        noise = std::max(noise, trial.norm());
      }
      if (!system_.residual(point.at)) return Outcome::non_finite;
      if (length <= 64 * noise) break;
      return Outcome::not_converged;
    }
    system_.move(point.at, {-step, 0});
    before = length;
  }
  point.x = system_.unscaled(point.at.y);
  point.load = m / system_.load_scale();
  point.negative = system_.inertia().negative;
  return Outcome::success;
}

Status Path::switch_branch(const PathPoint& point, const PathVector& across, double length) {
  PathPoint next = point;
  const double sign = length < 0 ? -1 : 1;
  PathVector normal{sign * across.y, sign * across.m};
  next.at.y += std::abs(length) * normal.y;
  next.at.m += std::abs(length) * normal.m;
  int count = 0;
  Outcome outcome = correct_in_plane(normal, std::abs(length), next.at, count);
  if (outcome == Outcome::success) outcome = describe(normal, next);
  if (outcome != Outcome::success)
    return failure(outcome, "no solution on the other branch at this distance; try another one");
  critical_.clear();
  before_ = point;
  before_.tangent = normal;
  earlier_ = before_;
  now_ = next;
  now_.arc = point.arc + std::abs(length);
  length_ = std::min(std::abs(length), first_length_);
  previous_tangent_ = now_.tangent;
  return {};
}

}  // namespace nlmech::algebraic

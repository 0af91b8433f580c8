
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nlmech/algebraic/paths/fold.hpp"
#include "nlmech/algebraic/paths/path_step.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
namespace {

constexpr double one_place = 1e-7;    // of a step: points closer than this count as one
constexpr double is_singular = 1e-5;  // |K v|/|K| of a null vector v, at most
constexpr double agreement = 1e-3;    // of the distance of points: zeros of two interpolations agree
constexpr double around_fork = 0.2;   // of a step: no other critical point near one of refine_fork()

}  // namespace

std::string_view to_string(PointKind kind) noexcept {
  switch (kind) {
    case PointKind::maximum: return "maximum";
    case PointKind::minimum: return "minimum";
    case PointKind::bifurcation: return "bifurcation";
    default: return "step";
  }
}

Path::Mark Path::mark(double part, const PathPoint& point) const {
  return {part, point.slope, point.negative, point.sign, point.is_rounded};
}

Outcome Path::critical_points(std::vector<CriticalPoint>& out) {
  out.clear();
  std::vector<double> parts;
  Outcome outcome = split_points(parts);
  // Near a bifurcation where an eigenvalue vanishes without changing sign, signs are rounding.
  for (const CriticalPoint& c : critical_) {
    if (c.vanishing == 0)
      std::erase_if(parts, [&](double part) { return std::abs(part - part_of(c.point)) < around_fork; });
  }
  std::optional<Bracket> pair;
  if (outcome == Outcome::success && !has_passed_fold()) outcome = slope_between(pair);
  if (outcome != Outcome::success) return outcome;
  if (pair) parts.insert(std::upper_bound(parts.begin(), parts.end(), pair->high), pair->high);
  if (parts.empty()) {
    out = critical_;
    return out.empty() && separated_.has_value() == separated_before_.has_value()
               ? critical_in(mark(0, before_), mark(1, now_), out)
               : outcome;
  }
  separated_ = separated_before_;
  Mark low = mark(0, before_);
  PathPoint point;
  for (const double part : parts) {
    outcome = between(part, point);
    const Mark high = mark(part, point);
    if (outcome == Outcome::success) outcome = critical_in(low, high, out);
    if (outcome != Outcome::success) return outcome;
    low = high;
  }
  return critical_in(low, mark(1, now_), out);
}

/// Bisects the interval until each part has one change or counts as one point.
Outcome Path::critical_in(const Mark& low, const Mark& high, std::vector<CriticalPoint>& out) {
  PathPoint a, point;
  a.slope = low.slope, a.negative = low.negative, a.sign = low.sign;
  point.slope = high.slope, point.negative = high.negative, point.sign = high.sign;
  const PathChanges changes = changes_between(a, point, system_.equations().is_symmetric());
  if (changes.count() == 0) return Outcome::success;
  const auto limit = low.slope > 0 ? CriticalPoint::Kind::maximum : CriticalPoint::Kind::minimum;
  if (changes.count() == 1 && changes.fold) {
    const Outcome outcome = fold_in({low.part, low.slope, high.part, high.slope}, point);
    if (outcome == Outcome::success && is_of_rounding(low, high, point)) {
      const bool is_known =
          separated_ && PathVector{separated_->y - point.at.y, separated_->m - point.at.m}.norm() <=
                            PathVector{now_.at.y - before_.at.y, now_.at.m - before_.at.m}.norm();
      if (is_known) return outcome;
      separated_ = point.at;
      return add_critical(CriticalPoint::Kind::bifurcation, 1, point, out);
    }
    return outcome == Outcome::success ? add_critical(limit, 1, point, out) : outcome;
  }
  if (changes.count() == 1 && low.sign * high.sign < 0) {
    Eigen::VectorXd direction;
    const auto sign = [](const Mark& m) { return static_cast<double>(m.sign); };
    Outcome outcome = branch_in({low.part, sign(low), high.part, sign(high)}, point, direction);
    if (outcome == Outcome::success) outcome = settle_branch(point);
    if (outcome == Outcome::wrong_branch) return outcome;
    if (outcome == Outcome::success) return add_critical(CriticalPoint::Kind::bifurcation, 1, point, out);
  }
  if (changes.fold && changes.branches == 1 && bifurcation_in(low, high, out) == Outcome::success)
    return Outcome::success;
  const double middle = low.part + (high.part - low.part) / 2;
  Outcome outcome = between(middle, point);
  if (outcome != Outcome::success) return outcome;
  if (high.part - low.part > one_place) {
    const Mark between_both = mark(middle, point);
    outcome = critical_in(low, between_both, out);
    return outcome == Outcome::success ? critical_in(between_both, high, out) : outcome;
  }
  if (changes.fold) outcome = add_critical(limit, 1, point, out);
  if (outcome != Outcome::success || changes.branches == 0) return outcome;
  return add_critical(CriticalPoint::Kind::bifurcation, changes.branches, point, out);
}

/// Is a limit point due to a bifurcation perturbed only by rounding? Then replaces @p fold by the bifurcation
/// point.
bool Path::is_of_rounding(const Mark& low, const Mark& high, PathPoint& fold) {
  if (!low.is_rounded || !high.is_rounded) return false;
  const PathVector chord{now_.at.y - before_.at.y, now_.at.m - before_.at.m};
  Fork fork{fold.at};
  if (refine_fork(system_, fork, chord.norm() + fold.at.y.norm(), std::abs(fold.at.m)) != Outcome::success)
    return false;
  fold.at = fork.at;
  fold.x = system_.unscaled(fork.at.y);
  fold.load = fork.at.m / system_.load_scale();
  return true;
}

/// Checks that branches cross at a point of branch_in(), and replaces the point by the crossing. @return
/// `wrong_branch` if the branches pass each other with a gap
Outcome Path::settle_branch(PathPoint& point) {
  if (!system_.equations().is_symmetric()) return Outcome::success;
  const PathVector chord{now_.at.y - before_.at.y, now_.at.m - before_.at.m};
  const double length = chord.norm(),
               load = std::max({std::abs(before_.at.m), std::abs(now_.at.m), std::abs(chord.m)});
  Fork fork{point.at};
  const Outcome outcome = refine_fork(system_, fork, 0.2 * length, 0.2 * load);
  if (outcome != Outcome::success) return outcome == Outcome::wrong_branch ? outcome : Outcome::success;
  const PathVector off{fork.at.y - point.at.y, fork.at.m - point.at.m};
  if (off.norm() <= 1e-5 * length) return Outcome::success;
  point.at = fork.at;
  point.x = system_.unscaled(fork.at.y);
  point.load = fork.at.m / system_.load_scale();
  point.arc = before_.arc + PathVector{fork.at.y - before_.at.y, fork.at.m - before_.at.m}.norm();
  return Outcome::success;
}

//! [a fork from the branch that leaves it]
Outcome Path::bifurcation_in(const Mark& low, const Mark& high, std::vector<CriticalPoint>& out) {
  if (!system_.equations().is_symmetric() || low.negative != high.negative) return Outcome::not_converged;
  const PathVector chord{now_.at.y - before_.at.y, now_.at.m - before_.at.m};
  const double length = chord.norm(), wide = high.part - low.part,
               guess = low.part + wide * low.slope / (low.slope - high.slope);
  PathPoint point, behind, ahead;
  Fork fork{between_by_cubic(before_, now_, guess)};
  const double load = std::max({std::abs(before_.at.m), std::abs(now_.at.m), std::abs(chord.m)});
  Outcome outcome = refine_fork(system_, fork, 0.2 * length, 0.2 * load);
  if (outcome != Outcome::success) return outcome;
  // Is it on this path? The path must pass through it along the null vector.
  point.at = fork.at;
  const double part = part_of(point), side = 0.05 * wide;
  if (!(part > low.part && part < high.part)) return Outcome::not_converged;
  for (const bool is_behind : {true, false}) {
    outcome = between(is_behind ? part - side : part + side, is_behind ? behind : ahead);
    if (outcome != Outcome::success) return outcome;
  }
  const PathVector gone{ahead.at.y - behind.at.y, ahead.at.m - behind.at.m},
      off{(ahead.at.y + behind.at.y) / 2 - fork.at.y, (ahead.at.m + behind.at.m) / 2 - fork.at.m};
  const bool is_along = std::abs(gone.y.dot(fork.null)) >= 0.95 * gone.norm();
  if (!is_along || !(off.norm() <= 0.05 * gone.norm())) return Outcome::not_converged;
  if (!system_.residual(fork.at)) return Outcome::non_finite;
  point.x = system_.unscaled(fork.at.y);
  point.load = fork.at.m / system_.load_scale();
  point.arc = before_.arc + PathVector{fork.at.y - before_.at.y, fork.at.m - before_.at.m}.norm();
  point.negative = fork.negative;
  point.tangent = {fork.null, 0};
  out.push_back({CriticalPoint::Kind::bifurcation, point, system_.unscaled(fork.null).normalized(), 0,
                 std::move(fork.across)});
  return Outcome::success;
}
//! [a fork from the branch that leaves it]

/// Does the path continue through a point without a gap, with the change of sign of its type?
bool Path::is_change_at(double part, CriticalPoint::Kind kind) {
  const PathVector all{now_.at.y - before_.at.y, now_.at.m - before_.at.m};
  PathPoint ahead, behind;
  for (const double reach : {2e-3, 1e-4, 5e-6}) {  // shorter distances where another change is near
    if (between(part - reach, behind) != Outcome::success || between(part + reach, ahead) != Outcome::success)
      return false;
    const PathVector gone{ahead.at.y - behind.at.y, ahead.at.m - behind.at.m};
    if (!(gone.norm() <= 1.3 * 2 * reach * all.norm())) return false;
    const PathChanges changes = changes_between(behind, ahead, system_.equations().is_symmetric());
    if (kind == CriticalPoint::Kind::bifurcation ? changes.branches > 0 : changes.fold) return true;
  }
  return false;
}

/// Adds a critical point if K is singular there and the path is continuous.
Outcome Path::add_critical(CriticalPoint::Kind kind, Eigen::Index vanishing, const PathPoint& point,
                           std::vector<CriticalPoint>& out) {
  const bool is_separated = separated_ && separated_->m == point.at.m;
  if (!is_separated && !is_change_at(part_of(point), kind)) return Outcome::not_converged;
  double norm = 0;  // norm of K nearby: with one unknown K vanishes at the point itself
  for (const PathVector& at : {before_.at, now_.at, point.at}) {
    if (!system_.linearise(at)) return Outcome::non_finite;
    norm = std::max(norm, system_.norm_of_matrix());
  }
  const Eigen::VectorXd null = null_direction(system_);
  system_.multiply(null, rest_);
  if (!(rest_.norm() <= is_singular * norm)) return Outcome::not_converged;
  out.push_back({kind, point, system_.unscaled(null).normalized(), vanishing});
  if (kind == CriticalPoint::Kind::bifurcation) out.back().point.tangent = out.back().across = {null, 0};
  return Outcome::success;
}

/// Bifurcation point in a bracket of the sign of the bordered determinant.
Outcome Path::branch_in(Bracket bracket, PathPoint& out, Eigen::VectorXd& direction) {
  // The bordered function of fold.hpp with a fixed border changes sign with the eigenvalue.
  PathVector border{Eigen::VectorXd(), 0}, null;
  null.y.resize(system_.size());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system_.size());
  const auto value = [&](const PathPoint& p) {
    if (!system_.linearise(p.at)) return HUGE_VAL * 0;
    system_.certify();
    if (!system_.solve_bordered(border.y, border, zero, 1, null)) return HUGE_VAL * 0;
    return null.m;
  };
  // Narrow by the sign first, so that the vanishing eigenvalue becomes the smallest one.
  Outcome outcome = narrow([](const PathPoint& p) { return static_cast<double>(p.sign); },
                           0.02 * (bracket.high - bracket.low), bracket, out);
  if (outcome != Outcome::success) return outcome;
  border.y = null_direction(system_);
  for (const bool is_low : {true, false}) {
    PathPoint end;
    outcome = between(is_low ? bracket.low : bracket.high, end);
    if (outcome != Outcome::success) return outcome;
    (is_low ? bracket.low_value : bracket.high_value) = value(end);
  }
  if (!((bracket.low_value > 0) != (bracket.high_value > 0))) return Outcome::not_converged;
  // Shorter distances where another critical point is near: there the function bends or has a pole, and the
  // zero of the polynomial lies outside the bracket.
  outcome = Outcome::not_converged;
  for (double reach = 0.02; outcome == Outcome::not_converged && reach > one_place; reach /= 10) {
    outcome = narrow(value, reach / 20, bracket, out);
    if (outcome == Outcome::success) outcome = interpolate(value, reach, out);
    const double part = part_of(out), slack = agreement * reach;
    if (!(part > bracket.low - slack && part < bracket.high + slack)) outcome = Outcome::not_converged;
  }
  if (outcome != Outcome::success) return outcome;
  if (!system_.linearise(out.at)) return Outcome::non_finite;
  direction = null_direction(system_);
  out.tangent = {direction, 0};
  return Outcome::success;
}

namespace {

/// Lagrange basis polynomial of node @p i of the nodes @p x from @p first on, at @p at.
double lagrange(const std::array<double, 6>& x, std::size_t first, std::size_t i, double at) {
  double product = 1;
  for (std::size_t j = first; j < x.size(); ++j) {
    if (j != i) product *= (at - x[j]) / (x[i] - x[j]);
  }
  return product;
}

/// Zero of the interpolation polynomial through the nodes from @p first on, between the outer two, which come
/// first; infinite if there is none.
double zero_of(const std::array<double, 6>& parts, const std::array<double, 6>& values, std::size_t first) {
  const auto value_at = [&](double part) {
    double sum = 0;
    for (std::size_t i = first; i < parts.size(); ++i) sum += lagrange(parts, first, i, part) * values[i];
    return sum;
  };
  double low = parts[first], high = parts[first + 1];
  const bool is_positive = values[first] > 0;
  if ((values[first + 1] > 0) == is_positive) return HUGE_VAL;
  for (int i = 0; i < 60; ++i) {
    const double middle = low + (high - low) / 2;
    ((value_at(middle) > 0) == is_positive ? low : high) = middle;
  }
  return low + (high - low) / 2;
}

/// Are the values at the offsets of interpolate() monotone?
bool is_monotone(const std::array<double, 6>& v) {
  const std::array<double, 6> sorted = {v[0], v[2], v[4], v[5], v[3], v[1]};
  return std::ranges::is_sorted(sorted) || std::ranges::is_sorted(sorted, std::greater<>());
}

}  // namespace

/// Zero of value() near @p out, interpolated from points at distances up to @p farthest: at a bifurcation
/// point itself the correction along the other branch is undetermined. If the polynomials through six and
/// four points disagree, as near another singular point, nearer points follow. If agreeing results differ
/// from those of nearer points, as by rounding with thousands of unknowns, the former are kept.
/// @return `not_converged` also if value() is not monotone over the points: another zero is near
Outcome Path::interpolate(const std::function<double(const PathPoint&)>& value, double farthest,
                          PathPoint& out) {
  constexpr std::array<double, 6> offsets = {-1, 1, -0.6, 0.6, -0.2, 0.2};
  std::array<double, 6> parts{}, values{};
  std::array<PathVector, 6> places;
  PathVector best;
  double middle = part_of(out), least = HUGE_VAL;
  int agreeing = 0;
  Outcome outcome = Outcome::success;
  for (const double nearer : {1., 0.1, 0.01}) {
    const double reach = nearer * farthest;
    for (std::size_t i = 0; i < offsets.size() && outcome == Outcome::success; ++i) {
      parts[i] = middle + reach * offsets[i];
      outcome = between(parts[i], out);
      if (outcome != Outcome::success) break;
      values[i] = value(out);
      places[i] = out.at;
    }
    if (outcome == Outcome::success && nearer == 1 && !is_monotone(values)) return Outcome::not_converged;
    if (outcome != Outcome::success) break;
    const double part = zero_of(parts, values, 0), off = std::abs(part - zero_of(parts, values, 2));
    if (agreeing > 0 && !(std::abs(part - middle) <= 10 * least)) break;  // by rounding
    if (!(std::abs(part - middle) <= reach)) outcome = Outcome::not_converged;
    if (nearer == 0.01 && off > 1e-4 * reach) outcome = Outcome::not_converged;
    if (outcome != Outcome::success) break;
    middle = part;
    if (off <= agreement * reach) ++agreeing;
    if (agreeing == 2 && off > least && off > 1e-6 * reach && nearer > 0.01) continue;
    least = off;
    best = {Eigen::VectorXd::Zero(system_.size()), 0};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double share = lagrange(parts, 0, i, part);
      best.y += share * places[i].y;
      best.m += share * places[i].m;
    }
    if (off <= 1e-6 * reach) break;
  }
  if (outcome != Outcome::success && agreeing < 2) return outcome;
  out.at = std::move(best);
  out.x = system_.unscaled(out.at.y);
  out.load = out.at.m / system_.load_scale();
  out.arc = before_.arc + PathVector{out.at.y - before_.at.y, out.at.m - before_.at.m}.norm();
  return Outcome::success;
}

Status follow(Path& path, const std::function<bool(const Path&)>& is_done, std::int64_t steps,
              std::vector<CriticalPoint>& found) {
  std::vector<CriticalPoint> here;
  const std::int64_t first = path.statistics().steps;
  while (!is_done(path)) {
    if (path.statistics().steps - first >= steps)
      return failed_with(Outcome::step_limit,
                         "path: {} steps end at load {:.10g}, arc {:.6g}; allow more, or longer ones (turn)",
                         steps, path.now().load, path.now().arc);
    Outcome outcome = Outcome::success;
    do {
      Status status = path.advance();
      // Stop at a point that the equations report as another branch.
      if (status.ok()) status = path.system().status();
      if (!status.ok()) return status;
      outcome = path.critical_points(here);
    } while (outcome != Outcome::success && path.take_back());
    if (outcome != Outcome::success)
      return failed_with(outcome,
                         "path: between the loads {:.10g} and {:.10g} eigenvalues of dF/dx change their "
                         "signs, and no limit or branch point is found; take shorter steps (turn)",
                         path.before().load, path.now().load);
    found.insert(found.end(), here.begin(), here.end());
  }
  return {};
}

}  // namespace nlmech::algebraic

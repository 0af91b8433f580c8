#include "nlmech/algebraic/paths/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nlmech/algebraic/paths/path_step.hpp"
#include "nlmech/algebraic/rounding.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
namespace {

constexpr double converged = 1e-8;       // of a step: the next correction would be about its square
constexpr double load_converged = 1e-6;  // of the greatest load, in the same correction
constexpr double stalled = 1e-4;         // corrections of this size that no longer shrink are rounding

constexpr double most_noise = 1e-2;     // of a step: longer corrections are not rounding
constexpr double least_to_edge = 1e-3;  // of a first step: smallest distance to another branch

void check(const PathMethod& method) {
  const auto require = [](bool good, const char* option, double value, const char* range) {
    if (!good) throw invalid_argument("path: {} = {}; it must be {}", option, value, range);
  };
  require(method.first > 0 && std::isfinite(method.first), "first", method.first, "positive");
  require(method.turn > 0 && method.turn <= 1, "turn", method.turn, "positive and at most 1");
  require(method.longest > 0, "longest", method.longest, "positive");
  require(method.shortest > 0 && method.shortest < 1, "shortest", method.shortest, "between 0 and 1");
  require(method.iterations > 0, "iterations", method.iterations, "positive");
  require(method.aim > 0, "aim", method.aim, "positive");
}

}  // namespace

Path::Path(const PathMethod& method, Loaded& equations, const Eigen::VectorXd& x, double load)
    : method_(method), system_(equations, x, load, method.scale) {
  check(method);
  now_.at = system_.scaled(x, load);
  step_.y.resize(x.size());
}

Status Path::failure(Outcome outcome, const char* what) const {
  const Status why = system_.status();
  return failed_with(outcome, "path: after {} steps at load {:.10g}, arc {:.6g}, {}{}{}",
                     system_.statistics.steps, now_.load, now_.arc, what, why.ok() ? "" : ": ",
                     why.sentence());
}

Status Path::start(bool upwards) {
  now_.arc = 0;
  PathVector along{Eigen::VectorXd::Zero(system_.size()), upwards ? 1. : -1.};
  const double first = method_.first * system_.load_scale();
  int count = 0;
  Outcome outcome = Outcome::success;
  if (!system_.residual(now_.at)) outcome = Outcome::non_finite;
  if (outcome == Outcome::success && system_.f().squaredNorm() > 0)
    outcome = correct_in_plane(along, std::max(first, now_.at.norm()), now_.at, count);
  if (outcome == Outcome::success) outcome = start_tangent(along);
  if (outcome != Outcome::success)
    return failure(outcome, "no solution with a tangent is found at the start; start elsewhere");
  // The first step changes the load by `first`.
  first_length_ = length_ = first / std::max(std::abs(now_.tangent.m), 0.1);
  previous_tangent_ = now_.tangent;
  earlier_ = before_ = now_;
  return {};
}

Outcome Path::start_tangent(const PathVector& along) {
  Outcome outcome = describe(along, now_);
  if (outcome == Outcome::success && std::abs(now_.slope) > 1e-3) return outcome;
  // At a limit point the tangent has no load part; its direction is the null vector of K.
  if (!system_.linearise(now_.at)) return Outcome::non_finite;
  PathVector row{null_direction(system_), 0};
  outcome = describe(row, now_);
  if (outcome != Outcome::success || now_.slope * along.m >= 0) return outcome;
  row.y = -row.y;
  return describe(row, now_);
}

Outcome Path::describe(const PathVector& direction, PathPoint& point) {
  if (!system_.linearise(point.at)) return Outcome::non_finite;
  system_.certify();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system_.size());
  if (!system_.solve_bordered(direction, zero, 1, step_)) return Outcome::singular_matrix;
  const double length = step_.norm();
  point.tangent = {step_.y / length, step_.m / length};
  point.negative = system_.inertia().negative;
  point.is_rounded = system_.is_rounded();
  // The bordered determinant has the same sign for every row with a positive product with the tangent.
  point.sign = system_.bordered_sign();
  // Near a limit point of a steep path only the second form has the right sign.
  point.slope = point.tangent.m;
  if (system_.equations().is_symmetric() && std::isnormal(system_.bordered_ratio()))
    point.slope = 1 / (system_.bordered_ratio() * length);
  point.x = system_.unscaled(point.at.y);
  point.load = point.at.m / system_.load_scale();
  return Outcome::success;
}

Outcome Path::correct_in_plane(const PathVector& normal, double size, PathVector& at, int& count) {
  double before = HUGE_VAL, before_load = HUGE_VAL;
  // Load of accepted points only: predictors and iterates may be far off.
  greatest_ = std::max({greatest_, std::abs(now_.at.m), method_.first * system_.load_scale()});
  for (count = 1; count <= method_.iterations; ++count) {
    if (!system_.residual(at) || !system_.linearise(at)) return Outcome::non_finite;
    rest_ = -system_.f();
    if (!system_.solve_bordered(normal, rest_, 0, step_)) return Outcome::singular_matrix;
    ++system_.statistics.newton_iterations;
    const double length = step_.norm();
    system_.move(at, step_);
    // Test the load separately: where displacements have grown large, the load is a small part of the length.
    const double change = std::abs(step_.m);
    const bool is_load_done = change <= load_converged * greatest_ ||
                              (count > 4 && change <= stalled * greatest_ && change > before_load / 2);
    before_load = std::abs(step_.m);
    if (is_load_done && (length <= converged * size || (length <= stalled * size && length > before / 2)))
      return Outcome::success;
    if (count > 2 && length > before / 2 && length <= most_noise * size &&
        length <= 64 * noise_at(normal, at))
      return Outcome::success;
    if (!(length <= 4 * size) || (count > 3 && length > 2 * before)) return Outcome::newton_diverged;
    before = length;
  }
  return Outcome::not_converged;
}

/// Rounding level of the correction: its size under changes of x in the last digits, as in polish(). It is
/// large near a bifurcation and in slender members, where the smallest stiffness is a tiny part of the
/// greatest.
double Path::noise_at(const PathVector& normal, const PathVector& at) {
  if (!system_.residual(at) || !system_.linearise(at)) return 0;
  const Eigen::VectorXd f = system_.f();
  PathVector shaken{{}, at.m}, step;
  double noise = 0;
  for (std::uint64_t sequence = 0; sequence < 2; ++sequence) {
    perturb_last_bits(at.y, sequence, shaken.y);
    if (!system_.residual(shaken) || !system_.solve_bordered(normal, system_.f() - f, 0, step)) return 0;
    noise = std::max(noise, step.norm());
  }
  return system_.residual(at) ? noise : 0;
}

//! [crisfield's sphere]
Outcome Path::correct_on_sphere(double length, PathVector& at, int& count) {
  double before = HUGE_VAL;
  for (count = 1; count <= method_.iterations; ++count) {
    if (!system_.residual(at) || !system_.linearise(at)) return Outcome::non_finite;
    system_.solve(-system_.f(), free_);
    system_.solve(-system_.load_vector(), forced_);
    // |a + d forced|^2 + (b + d)^2 = length^2 for the change d of the load.
    const Eigen::VectorXd a = at.y + free_ - now_.at.y;
    const double b = at.m - now_.at.m;
    const double square = forced_.squaredNorm() + 1, half = a.dot(forced_) + b;
    const double rest = a.squaredNorm() + b * b - length * length;
    const double discriminant = half * half - square * rest;
    if (!(discriminant >= 0))
      return std::isnan(discriminant) ? Outcome::singular_matrix : Outcome::not_converged;
    // Both roots, without cancellation.
    const double sum = -(half + std::copysign(std::sqrt(discriminant), half));
    const double one = sum / square, other = sum != 0 ? rest / sum : 0;
    // Choose the root that turns less from the direction of the iterate.
    const Eigen::VectorXd displacement = at.y - now_.at.y;
    const double slope = displacement.dot(forced_) + b;
    const double d = slope * one > slope * other ? one : other;
    ++system_.statistics.newton_iterations;
    step_.y = free_ + d * forced_;
    step_.m = d;
    const double change = step_.norm();
    system_.move(at, step_);
    if (change <= converged * length || (change <= stalled * length && change > before / 2))
      return Outcome::success;
    if (!(change <= 4 * length) || (count > 3 && change > 2 * before)) return Outcome::newton_diverged;
    before = change;
  }
  return Outcome::not_converged;
}
//! [crisfield's sphere]

/// Proposed size of the next step.
double Path::proposed() const {
  if (method_.kind != PathMethod::Kind::gdc) return length_;
  // Yang and Shieh: the load increment is the first one times sqrt(GSP), GSP = |u_1|^2/(u_old^T u), with u =
  // dy/dload = tangent.y/tangent.m. In terms of the step size, only the root is divided by a tangent.m that
  // may vanish.
  const double along = std::abs(previous_tangent_.y.dot(now_.tangent.y));
  const double ratio = std::abs(previous_tangent_.m) / std::max(std::abs(now_.tangent.m) * along, 1e-300);
  return factor_ * std::min(first_length_ * std::sqrt(ratio), 4 * length_);
}

Outcome Path::step(double length, PathPoint& next, int& count) {
  next.at.y = now_.at.y + length * now_.tangent.y;
  next.at.m = now_.at.m + length * now_.tangent.m;
  Outcome outcome = Outcome::success;
  switch (method_.kind) {
    case PathMethod::Kind::riks: outcome = correct_in_plane(now_.tangent, length, next.at, count); break;
    case PathMethod::Kind::crisfield: outcome = correct_on_sphere(length, next.at, count); break;
    case PathMethod::Kind::gdc:
      outcome = correct_in_plane({previous_tangent_.y, 0}, length, next.at, count);
      break;
  }
  return outcome == Outcome::success ? describe(now_.tangent, next) : outcome;
}

//! [one path]
/// Do now_ and @p next lie on one path? Tests points, tangents and the middle of the cubic.
bool Path::is_continuous(const PathPoint& next, const PathChanges& changes) {
  const PathVector chord{next.at.y - now_.at.y, next.at.m - now_.at.m};
  PathVector mean{now_.tangent.y + next.tangent.y, now_.tangent.m + next.tangent.m};
  const double size = chord.norm(), length = mean.norm();
  mean = {mean.y / length, mean.m / length};
  const double off = PathVector{chord.y / size - mean.y, chord.m / size - mean.m}.norm();
  if (changes.count() == 0 && off <= 0.02) return true;
  const PathVector middle = between_by_cubic(now_, next, 0.5);
  if (!system_.residual(middle) || !system_.linearise(middle)) return false;
  const auto [least, most] = std::minmax(now_.negative, next.negative);
  const Eigen::Index negative = system_.inertia().negative;
  if (negative < least || negative > most) return false;
  rest_ = -system_.f();
  return system_.solve_bordered(mean, rest_, 0, step_) && step_.norm() <= 0.01 * size;
}

/// Accepts @p next if it lies on the same path and a critical point is found for every change of sign.
bool Path::go_to(const PathPoint& next) {
  const PathChanges changes = changes_between(now_, next, system_.equations().is_symmetric());
  if (!is_continuous(next, changes)) return false;
  PathPoint last_but_one = std::exchange(before_, std::exchange(now_, next));
  separated_before_ = separated_;
  critical_.clear();
  if (changes.count() == 0 || critical_in(mark(0, before_), mark(1, now_), critical_) == Outcome::success) {
    earlier_ = std::move(last_but_one);
    return true;
  }
  critical_.clear();
  separated_ = separated_before_;
  now_ = std::exchange(before_, std::move(last_but_one));
  return false;
}
//! [one path]

bool Path::take_back() {
  const double length = PathVector{now_.at.y - before_.at.y, now_.at.m - before_.at.m}.norm() / 4;
  if (!(length >= method_.shortest * first_length_)) return false;
  now_ = std::exchange(before_, earlier_);
  previous_tangent_ = before_.tangent;
  length_ = length;
  factor_ /= 4;
  critical_.clear();
  separated_ = separated_before_;
  ++system_.statistics.rejected;
  return true;
}

/// Do the equations report another branch (or a pole) at the last evaluation?
bool Path::is_other_branch() const {
  const Outcome outcome = system_.status().outcome();
  return outcome == Outcome::wrong_branch || outcome == Outcome::at_pole;
}

Status Path::advance() {
  double length = std::min(proposed(), method_.longest * first_length_);
  PathPoint next;
  next.at = now_.at;
  bool is_beyond = false;
  for (;;) {
    int count = 0;
    const Outcome outcome = step(length, next, count);
    // Refers to the new point, the last one evaluated. Reject a point that the equations report as another
    // branch.
    is_beyond = is_other_branch();
    if (outcome == Outcome::success) {
      const PathVector chord{next.at.y - now_.at.y, next.at.m - now_.at.m};
      const double angle = std::acos(std::clamp(next.tangent.dot(now_.tangent), -1., 1.));
      const double distance = chord.norm(),
                   lag = std::acos(std::clamp(chord.dot(now_.tangent) / std::max(distance, 1e-300), -1., 1.));
      next.arc = now_.arc + distance;
      if (!is_beyond && std::max(angle, 2 * lag) <= 1.5 * method_.turn && go_to(next)) {
        adapt(length, std::max(angle, 2 * lag), count);
        previous_tangent_ = before_.tangent;
        ++system_.statistics.steps;
        return {};
      }
    }
    ++system_.statistics.rejected;
    length /= 2;
    factor_ /= 2;
    const bool is_short = length < method_.shortest * first_length_;
    if (is_beyond && (is_short || (outcome == Outcome::success && length < least_to_edge * first_length_)))
      return failure(Outcome::wrong_branch, "the path ends here");
    if (is_short)
      return failure(outcome == Outcome::non_finite ? outcome : Outcome::step_underflow,
                     "even the shortest step cannot be distinguished from a jump to another branch: the path "
                     "ends or branches here; start elsewhere");
  }
}

void Path::adapt(double length, double angle, int count) {
  const double by_turn = method_.turn / std::max(angle, 1e-3),
               by_count = std::sqrt(static_cast<double>(method_.aim) / count);
  length_ = length;
  if (method_.kind == PathMethod::Kind::gdc)
    factor_ = std::min(1., 2 * factor_);
  else
    length_ *= std::clamp(std::min(by_turn, by_count), 0.3, 2.);
}

}  // namespace nlmech::algebraic

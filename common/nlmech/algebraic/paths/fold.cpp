#include "nlmech/algebraic/paths/fold.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "nlmech/algebraic/rounding.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::algebraic {
namespace {

/// Gradient of g with respect to (y, m), by central differences of K v.
PathVector gradient(PathSystem& system, const PathVector& at, const Eigen::VectorXd& v) {
  PathVector ahead = at, behind = at, out;
  Eigen::VectorXd plus(v.size()), minus(v.size());
  const double step = 1e-5 * at.norm() / v.norm();
  ahead.y += step * v;
  behind.y -= step * v;
  system.multiply_at(ahead, v, plus);
  system.multiply_at(behind, v, minus);
  out.y = (minus - plus) / (2 * step);
  const double load = 1e-5 * at.norm();
  ahead = behind = at;
  ahead.m += load;
  behind.m -= load;
  system.multiply_at(ahead, v, plus);
  system.multiply_at(behind, v, minus);
  out.m = (minus - plus).dot(v) / (2 * load);
  return out;
}

}  // namespace

Outcome refine_fold(PathSystem& system, PathVector& at, Eigen::VectorXd& direction) {
  PathVector null, step, border;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system.size());
  null.y = step.y = zero;
  double before = HUGE_VAL;
  for (int k = 0; k < 30; ++k) {
    if (!system.residual(at) || !system.linearise(at)) return Outcome::non_finite;
    border.y = direction.normalized();
    border.m = 0;
    if (!system.solve_bordered(border.y, border, zero, 1, null)) return Outcome::singular_matrix;
    direction = null.y;
    const Eigen::VectorXd rest = -system.f();
    const PathVector row = gradient(system, at, null.y);
    const double size = row.norm();
    if (!(size > 0 && std::isfinite(size))) return Outcome::non_finite;
    // Scale the row to norm 1, as the other rows.
    const PathVector unit{row.y / size, row.m / size};
    if (!system.solve_bordered(unit, rest, -null.m / size, step)) return Outcome::singular_matrix;
    ++system.statistics.newton_iterations;
    const double length = step.norm(), reach = at.norm();
    // A short step that no longer shrinks is due to rounding; with many elements it may be longer.
    if (length > before / 2 && (length <= 1e-11 * reach || (k > 6 && length <= 1e-5 * reach)))
      return Outcome::success;
    system.move(at, step);
    if (length <= 2 * eps * reach) return Outcome::success;
    if (!(length <= 2 * reach)) return Outcome::not_converged;
    before = length;
  }
  return Outcome::not_converged;
}

namespace {

/// Lyapunov-Schmidt reduction: mu as a function of s and the load.
class Reduced {
 public:
  Reduced(PathSystem& system, Eigen::VectorXd border)
      : system_(system), row_{std::move(border), 0}, zero_(Eigen::VectorXd::Zero(system.size())) {}

  /// Newton's iteration for x and mu at the s and load of @p at.
  Outcome correct(PathVector& at) {
    PathVector step;
    double before = HUGE_VAL;
    for (int k = 0; k < 12; ++k) {
      if (!system_.residual(at) || !system_.linearise(at)) return Outcome::non_finite;
      const Eigen::VectorXd rest = -system_.f() - mu * row_.y;
      if (!system_.solve_bordered(row_.y, row_, rest, 0, step)) return Outcome::singular_matrix;
      ++system_.statistics.newton_iterations;
      const double length = step.y.norm();
      mu += step.m;
      step.m = 0;
      system_.move(at, step);
      const double size = at.norm();
      if (length <= 4 * eps * size) return Outcome::success;
      // Steps that no longer shrink are due to rounding; with many slender members they may be long.
      if (k > 1 && length > before / 2)
        return length <= 1e-6 * size ? Outcome::success : Outcome::not_converged;
      before = length;
    }
    return Outcome::not_converged;
  }
  /// Derivatives of mu and x with respect to s and the load.
  Outcome derive(const PathVector& at) {
    if (!system_.linearise(at)) return Outcome::non_finite;
    system_.certify();
    const bool is_solved = system_.solve_bordered(row_.y, row_, zero_, 1, along) &&
                           system_.solve_bordered(row_.y, row_, -system_.load_vector(), 0, under);
    slope = {along.m, under.m};
    return is_solved ? Outcome::success : Outcome::singular_matrix;
  }

  /// Rounding level of mu: its change by the last digits of x and of the data of the equations.
  double rounding(const PathVector& at) {
    double most = system_.equations().data_rounding(system_.unscaled(row_.y));
    if (!system_.residual(at)) return most;
    const double here = row_.y.dot(system_.f());
    PathVector perturbed{{}, at.m};
    double changes = 0;
    for (std::uint64_t sequence = 0; sequence < 4; ++sequence) {
      perturb_last_bits(at.y, sequence, perturbed.y);
      if (system_.residual(perturbed)) changes = std::max(changes, std::abs(row_.y.dot(system_.f()) - here));
    }
    return most + changes;
  }

  double mu = 0;
  PathVector along, under;
  Eigen::Vector2d slope{0, 0};

 private:
  PathSystem& system_;
  PathVector row_;
  Eigen::VectorXd zero_;
};

/// Second derivatives of mu, and the inertia at neighbouring loads.
struct Bend {
  Eigen::Matrix2d by;          ///< second derivatives with respect to s and the load
  Eigen::Index negative[2]{};  ///< numbers of negative eigenvalues at the smaller and the greater load
};

/// Central differences with steps @p change in s and load; call derive() at @p at before.
Outcome bend_at(PathSystem& system, const Reduced& reduced, const PathVector& at,
                const Eigen::Vector2d& change, Bend& bend) {
  for (const int i : {0, 1}) {
    Eigen::Vector2d ends[2];
    for (const int side : {0, 1}) {
      const double way = side == 0 ? -change[i] : change[i];
      PathVector place = at;
      place.y += way * (i == 0 ? reduced.along.y : reduced.under.y);
      if (i == 1) place.m += way;
      Reduced there = reduced;
      Outcome outcome = there.correct(place);
      if (outcome == Outcome::success) outcome = there.derive(place);
      if (outcome != Outcome::success) return outcome;
      ends[side] = there.slope;
      // The vanishing eigenvalue has different signs at the two loads; at the point itself its sign is
      // rounding.
      if (i == 1) bend.negative[side] = system.inertia().negative;
    }
    bend.by.col(i) = (ends[1] - ends[0]) / (2 * change[i]);
  }
  return Outcome::success;
}

}  // namespace

Outcome refine_fork(PathSystem& system, Fork& fork, double reach, double load) {
  constexpr double near = 1e-3;  // of the reach: below this step, second derivatives are reused
  if (!system.linearise(fork.at)) return Outcome::non_finite;
  Reduced reduced(system, null_direction(system));
  PathVector& at = fork.at;
  const PathVector start = at;
  Bend bend;
  double before = HUGE_VAL;
  Outcome outcome = reduced.correct(at);
  for (int k = 0; k < 20 && outcome == Outcome::success; ++k) {
    outcome = reduced.derive(at);
    if (outcome == Outcome::success && before > near)
      outcome = bend_at(system, reduced, at, {0.01 * reach, 0.01 * load}, bend);
    if (outcome != Outcome::success) break;
    const double mixed = (bend.by(0, 1) + bend.by(1, 0)) / 2;
    const Eigen::Vector2d step = bend.by.partialPivLu().solve(-reduced.slope);
    const double length = std::max(std::abs(step[0]) / reach, std::abs(step[1]) / load);
    if (!(length <= 1)) return Outcome::not_converged;
    at.y += step[0] * reduced.along.y + step[1] * reduced.under.y;
    at.m += step[1];
    outcome = reduced.correct(at);
    const PathVector displacement{at.y - start.y, 0};
    if (!(displacement.norm() <= reach)) return Outcome::not_converged;
    const bool is_done = length <= 1e-14 || (length <= 1e-6 && length > before / 2);
    before = length;
    if (!is_done) continue;
    if (outcome == Outcome::success) outcome = reduced.derive(at);
    if (outcome != Outcome::success) break;
    // Near an imperfect bifurcation mu is the perturbing force.
    if (!(std::abs(reduced.mu) <= 16 * reduced.rounding(at))) return Outcome::wrong_branch;
    fork.null = reduced.along.y.normalized();
    fork.negative = std::min(bend.negative[0], bend.negative[1]);
    // Tangent of the other branch: 2 mixed ds dload + by(1, 1) dload^2 = 0.
    const double share = mixed != 0 ? -bend.by(1, 1) / (2 * mixed) : 0;
    fork.across = {reduced.under.y + share * reduced.along.y, 1};
    const double size = fork.across.norm();
    fork.across = {fork.across.y / size, 1 / size};
    return Outcome::success;
  }
  return outcome == Outcome::success ? Outcome::not_converged : outcome;
}

}  // namespace nlmech::algebraic

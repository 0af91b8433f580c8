#include "nlmech/algebraic/paths/fold.hpp"

#include <cmath>

#include "nlmech/support/doubles.hpp"

namespace nlmech::algebraic {
namespace {

/// The derivative of g by (y, m), by central differences of K v.
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
    // The row scaled to 1, so that it counts as the others do.
    const PathVector unit{row.y / size, row.m / size};
    if (!system.solve_bordered(unit, rest, -null.m / size, step)) return Outcome::singular_matrix;
    ++system.statistics.newton_iterations;
    const double length = step.norm(), reach = at.norm();
    // A short step that no longer shrinks is rounding; of a structure of many elements it may be long.
    if (length > before / 2 && (length <= 1e-11 * reach || (k > 6 && length <= 1e-5 * reach)))
      return Outcome::success;
    system.move(at, step);
    if (length <= 2 * eps * reach) return Outcome::success;
    if (!(length <= 2 * reach)) return Outcome::not_converged;
    before = length;
  }
  return Outcome::not_converged;
}

}  // namespace nlmech::algebraic

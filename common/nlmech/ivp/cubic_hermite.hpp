/// @file
/// Cubic Hermite interpolation between two states: dense output of methods of order up to 3.
#pragma once

#include <utility>

#include "nlmech/ivp/state.hpp"

namespace nlmech::ivp {

/// Interpolates a step by the cubic that has the states and derivatives of both ends. Its error against the
/// solution through them is at most h^4/384 max |x''''|. It is continuously differentiable from step to step.
class CubicHermite {
 public:
  /// For states of @p size components.
  explicit CubicHermite(int size) : x0(size), x1(size), f0(size), f1(size) {}
  State x0;       ///< state at the start
  State x1;       ///< state at the end
  State f0;       ///< dx/dt at the start
  State f1;       ///< dx/dt at the end
  double t0 = 0;  ///< time of the start
  double h = 1;   ///< step size, signed

  /// Moves to the next step, from time @p t with step size @p length: the end of the last step becomes its
  /// start.
  void next_step(double t, double length) {
    std::swap(x0, x1);
    std::swap(f0, f1);
    t0 = t;
    h = length;
  }
  /// State at time @p t.
  void at(double t, State& x) const {
    const double s = (t - t0) / h, r = 1 - s;
    x = (r * r * (1 + 2 * s)) * x0 + (s * s * (3 - 2 * s)) * x1 + (h * s * r * r) * f0 - (h * s * s * r) * f1;
  }
};

}  // namespace nlmech::ivp

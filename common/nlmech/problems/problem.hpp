/// @file
/// Interface of a problem in C++, whose right-hand side methods can inline. Library problems are texts
/// (texts.hpp).
///
/// A problem has `dimension` and
///
///     template <class T> void operator()(const T& t, const Vector<T, dimension>& x, Vector<T, dimension>&
///     dxdt) const;
///
/// It evaluates the right-hand side with T = double, Jacobians with Dual and Taylor coefficients with
/// PowerSeries. A second-order problem defines `acceleration(t, q, v, a)` instead, and its call operator
/// calls first_order_form(). Optional members:
/// - `discontinuities(t0, t1)`: times strictly between t0 and t1, in the direction of integration, at which
/// the
///   right-hand side or one of its derivatives jumps. A right-hand side that branches on value_of(t) must
///   have it.
/// - `invariants(t, x)`: a vector of quantities that stay constant along every solution.
/// - `lower_bounds()`, `upper_bounds()`: a bound for each component, infinite if there is none. A solution
/// that starts
///   within the bounds stays within them at all later times (not at earlier ones). A run by a method with
///   tolerances that violates bounds or invariants does not end with success (ivp/stated_limits.hpp).
///
/// A problem whose number of components depends on its parameters has the dimension Eigen::Dynamic and a
/// member `size()`.
#pragma once

#include "nlmech/program/vector.hpp"

namespace nlmech::problems {

/// A problem whose right-hand side, or a derivative of it, jumps at known times.
template <class Problem>
concept HasDiscontinuities = requires(const Problem& problem) {
  problem.discontinuities(0.0, 1.0);
};

/// First-order form of a second-order problem (Elgohary 2015, Eq. 4.1): for x = (q, v), dx/dt = (v, a(t, q,
/// v)).
template <class Problem, class T, int n>
void first_order_form(const Problem& problem, const T& t, const Vector<T, n>& x, Vector<T, n>& dxdt) {
  const Vector<T, n / 2> q = x.template head<n / 2>(), v = x.template tail<n / 2>();
  Vector<T, n / 2> a;
  problem.acceleration(t, q, v, a);
  dxdt.template head<n / 2>() = v;
  dxdt.template tail<n / 2>() = a;
}

}  // namespace nlmech::problems

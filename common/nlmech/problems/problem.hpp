/// @file
/// A problem in C++, for right-hand sides that methods inline; those of the library are texts (texts.hpp).
///
/// A problem has `dimension` and
///
///     template <class T> void operator()(const T& t, const Vector<T, dimension>& x, Vector<T, dimension>&
///     dxdt) const;
///
/// With double this is the right-hand side; with Dual it gives Jacobians; with PowerSeries, Taylor
/// coefficients. A second-order problem gives `acceleration(t, q, v, a)` instead, and its call operator hands
/// over to first_order_form(). Optional members, each with this meaning:
/// - `discontinuities(t0, t1)`: times strictly between t0 and t1, in the direction of travel, at which the
///   right-hand side or one of its derivatives jumps. A right-hand side that branches on value_of(t) must
///   have it.
/// - `invariants(t, x)`: a vector of quantities that stay constant along every solution.
/// - `lower_bounds()`, `upper_bounds()`: a number for each component, infinite where there is none. A
///   solution that begins within them stays within them at all later times (not at earlier ones). A run by a
///   method with tolerances that leaves these or the invariants does not end with success
///   (ivp/stated_limits.hpp).
///
/// A problem whose parameters decide how many components it has is of dimension Eigen::Dynamic, and says
/// `size()`.
#pragma once

#include "nlmech/program/vector.hpp"

namespace nlmech::problems {

/// Does the right-hand side, or a derivative of it, jump at known times?
template <class Problem>
concept HasDiscontinuities = requires(const Problem& problem) {
  problem.discontinuities(0.0, 1.0);
};

/// A second-order problem as a first-order one (Elgohary 2015, Eq. 4.1): for x = (q, v), dx/dt = (v, a(t, q,
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

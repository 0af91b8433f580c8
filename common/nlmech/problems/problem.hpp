/// @file
/// What a problem is: a plain aggregate of parameters that is the right-hand side of its equation, for every
/// type of number.
///
/// A problem has `dimension`, `name`, `parameters` (see parameters.hpp) and
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
/// - `equation`: the equation in ASCII, then a semicolon and which letter is which parameter, where names
///   differ.
/// - `state_names()`: names of the components of its state, for the heads of columns.
/// - `initial_state()`, `initial_time`, `final_time`: the data of the publication.
///
/// A problem whose parameters decide how many components it has is of dimension Eigen::Dynamic, and says
/// `size()`.
#pragma once

#include <string>
#include <vector>

#include "nlmech/program/vector.hpp"

namespace nlmech::problems {

/// Is the problem an equation for accelerations, its state made of positions and then velocities?
template <class Problem>
concept SecondOrder = requires(const Problem& problem, const Vector<double, Problem::dimension / 2>& q,
                               Vector<double, Problem::dimension / 2>& a) {
  problem.acceleration(0.0, q, q, a);
};

/// Does the right-hand side, or a derivative of it, jump at known times?
template <class Problem>
concept HasDiscontinuities = requires(const Problem& problem) {
  problem.discontinuities(0.0, 1.0);
};

/// Does the problem know quantities that stay constant along its solutions?
template <class Problem>
concept HasInvariants = requires(const Problem& problem, const Vector<double, Problem::dimension>& x) {
  problem.invariants(0.0, x);
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

/// Does the problem have names of its own for the components of its state?
template <class Problem>
concept NamesItsState = requires(const Problem& problem) {
  problem.state_names();
};

/// Column names of a state: the problem's own; else x1, x2, ..., v1, v2, ... for a second-order problem, and
/// x1, x2, ... for others.
template <class Problem>
[[nodiscard]] std::vector<std::string> state_names(const Problem& problem = {}) {
  if constexpr (NamesItsState<Problem>) {
    return problem.state_names();
  } else {
    std::vector<std::string> names;
    const int positions = SecondOrder<Problem> ? Problem::dimension / 2 : Problem::dimension;
    const auto add = [&names](char letter, int count) {
      for (int i = 1; i <= count; ++i) names.push_back(std::to_string(i).insert(0, 1, letter));
    };
    add('x', positions);
    add('v', Problem::dimension - positions);
    return names;
  }
}

}  // namespace nlmech::problems

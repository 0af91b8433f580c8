/// @file
/// Integration by Hermitian operators: one-step methods with accelerations and jerks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/hermitian/hermitian_operators.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Hermite-Obreshkov steps for q'' = a(t, q, v) by two operators of Table 1 of J. E. Laier, High-order
/// algorithm for non-linear dynamics. Implicit: Newton's iteration solves the 2m equations for positions and
/// velocities; dual numbers give acceleration, jerk and their exact derivatives.
///
/// Order: order_of(solved_for_end(operators)), 4 for Laier and Argyris, 2 for the others, which are all the
/// same method as Newmark{}. On linear problems all but Argyris are stable for every step size and have the
/// spectral radius 1 without damping: components that a step does not resolve neither grow nor decay.
///
/// Newton's iteration may converge to a root that does not continue the solution. Each step is therefore
/// checked by two operators of order 6, one of which evaluates the problem in the middle of the step; their
/// residual is the error estimate.
///  - With a `step`, the integration ends with `wrong_branch` if the estimate, as a displacement, exceeds
///    `branch_tolerance` times the displacements and stiffness times h^2 or damping times h changes by more
///    than 3 over the step. This never happens on linear problems, where a step has one root only.
///  - Without a `step`, the step size is adaptive: a step is accepted if
///    max_i |e_i| / (atol + rtol max(|x0_i|, |x1_i|)) <= 1. The factor to the next step size is
///    0.9 err^(-1/(p + 1)), from 0.2 to 5; a step that is not solved is quartered. If h^2 |a_q| > 2, or if
///    the step is a first one or more than twice as large as the last, it must pass a second estimate, which
///    does not vanish on an oscillation for any step size: see HermitianTrial::unresolved(). The error of
///    each step is controlled; the final error is that of all steps times the condition number of the
///    problem. If the estimates add up to a hundredth of the state and ten thousand tolerances, the run ends
///    with `not_converged`.
///
/// Steps end on the problem's discontinuities. Dense output: the quintic through states and accelerations of
/// both ends, of the order of the method. Statistics::right_hand_sides counts a and j separately: two per
/// Newton iteration and three more per step.
///
/// Tests assert the order of every row (observed within 0.15), 1e-11 for runs forwards and back, no growth of
/// the linear oscillator for h omega up to 1e6, 2000 tolerances for adaptive steps, and a failure status for
/// van der Pol's jumps whenever the final state is wrong.
struct Hermitian {
  static constexpr std::string_view name = "hermitian";  ///< the family; messages name the operators
  HermitianPair operators = laier;                       ///< a row of hermitian_table, or another pair
  double step = 0;                                       ///< step size; 0: adaptive
  double relative_tolerance = 1e-9;                      ///< rtol of adaptive steps, from 1e-14 to 0.1
  double absolute_tolerance = 1e-9;                      ///< atol, positive
  double branch_tolerance = 0.1;                         ///< see above; positive; infinity: never
  algebraic::Newton newton = {};                         ///< solves each step's equations
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const Hermitian& method);

/// See integrate(). @throws std::invalid_argument also for a problem without accelerations or in double only
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Hermitian& method);

}  // namespace nlmech::ivp

/// @file
/// Integration by Hermitian operators: single steps with accelerations and jerks.
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
/// algorithm for non-linear dynamics. Implicit; the 2m equations for positions and velocities are solved by
/// Newton's iteration, acceleration, jerk and their exact derivatives taken from the problem by dual numbers.
///
/// Order: order_of(solved_for_end(operators)), 4 for Laier and Argyris, 2 for the others, which are one
/// method and the one that Newmark{} is. On linear problems all but Argyris are stable for every step and
/// keep the spectral radius 1 where nothing damps: fast parts that a step does not resolve neither grow nor
/// decay.
///
/// A converged Newton iteration does not tell that its root continues the solution. Each step is therefore
/// held to two operators of order 6, one of which asks the problem in the middle of the step; what they leave
/// is the estimate of the error.
///  - With a `step`, a step whose estimate, as a displacement, is more than `branch_tolerance` of the
///    displacements ends the integration with `wrong_branch`, if stiffness times h^2 or damping times h
///    change by more than 3 over it. On linear problems, where a step has one root only, it never does.
///  - Without, steps are chosen: accepted if max_i |e_i| / (atol + rtol max(|x0_i|, |x1_i|)) <= 1. The
///    next one is longer or shorter by 0.9 err^(-1/(p + 1)), at least 0.2 and at most 5 times; a step that
///    is not solved is quartered. Where h^2 |a_q| > 2, and if it is a first one or more than twice as long as
///    the one before, a step must pass a second estimate, which vanishes on no oscillation however long the
///    step: see HermitianTrial::unresolved(). It is the error of a step that is held:
///    at the end there are those of all steps, times the problem's condition.
///    Where the estimates add up to a hundredth of the state and ten thousand tolerances, the run ends with
///    `not_converged`.
///
/// Steps end on announced discontinuities. Dense output: the quintic of both ends with accelerations, of the
/// method's order. Statistics::right_hand_sides counts a and j apart: two a Newton iteration, three a step
/// more.
///
/// Tests hold every row to its order (observed within 0.15), runs there and back to 1e-11, the linear
/// oscillator to no growth for h omega up to 1e6, chosen steps to 2000 tolerances, and van der Pol's jumps to
/// a status wherever an end is wrong.
struct Hermitian {
  static constexpr std::string_view name = "hermitian";  ///< the family; a run's messages name the operators
  HermitianPair operators = laier;                       ///< a row of hermitian_table, or another pair
  double step = 0;                                       ///< length of a step; 0: chosen
  double relative_tolerance = 1e-9;                      ///< rtol where steps are chosen, from 1e-14 to 0.1
  double absolute_tolerance = 1e-9;                      ///< atol, positive
  double branch_tolerance = 0.1;                         ///< see above; positive; infinity: never
  algebraic::Newton newton = {};                         ///< solves each step's equations
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const Hermitian& method);

/// See integrate(). @throws std::invalid_argument also for a problem without accelerations or written for
/// double alone
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Hermitian& method);

}  // namespace nlmech::ivp

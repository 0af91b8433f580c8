/// @file
/// Multi-step transversal linearisation (Roy): the linear part exact, the rest interpolated over p steps.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/transversal/mtl_weights.hpp"

namespace nlmech::ivp {

/// What Mtl solves exactly; the rest of the right-hand side is interpolated. All lead to the same order.
enum class MtlLinear {
  given,    ///< the constant linear terms of the equations (System::linear_terms())
  zero,     ///< nothing (x'' = 0 for a problem with accelerations): collocation at equidistant points
  jacobian  ///< df/dx at the start of each block of p steps: for stiff problems, whose own linear terms may
            ///< grow where solutions do not. Costs an exponential a block, and the time symmetry
};

/// "given", "zero", "jacobian".
[[nodiscard]] std::string_view to_string(MtlLinear linear);

/// Newton's iteration as Mtl uses it.
inline constexpr algebraic::Newton mtl_newton = {.tolerance = 1e-12, .noise = 1e-8, .iterations = 50};

/// Multi-step transversal linearisation (D. Roy, A multi-step transversal linearization method in nonlinear
/// dynamics, extended summary). Over p steps of length h the equation x' = A x + g(t, x) + load is replaced
/// by
///
///     y' = A y + sum over k = 0..p of g(t_k, x_k) phi_k(t) + load                          (Eqs 3, 4)
///
/// and the states at t_1..t_p are those for which y(t_l) = x_l (Eq. 5): p n equations, solved by Newton's
/// iteration with the exact Jacobian. Harmonic loads of the equations are solved exactly; linear
/// problems are exact to rounding for every h. For problems with accelerations A = [0 1; -K -C] and g acts on
/// the velocities. Order: mtl_order().
///
/// With a fixed A symmetric in time, so that energies of oscillators do not drift; not symplectic. Not
/// L-stable. A step too long for the problem may be solved by states that lie on no solution; the estimate
/// of error_tolerance turns that into a status.
/// Dense output: y itself, and exact on linear problems; within a block it is of the order p + 1, as its
/// inner points are.
///
/// Tests hold it to mtl_order() (observed within 0.12), linear problems to rounding for steps of every
/// length, its symmetry to 1e4 eps, and the bound of the energy error to a recorded one (4 %).
struct Mtl {
  static constexpr std::string_view name = "mtl";  ///< on command lines and in tables
  double step = 0.1;                               ///< h, distance of the points, positive
  int points = 3;                                  ///< p, from 1 to 8
  MtlBasis basis = MtlBasis::lagrange;             ///< phi_k
  MtlLinear linear = MtlLinear::given;             ///< A
  /// Ends with `wrong_branch` where the estimated error of a block, max |e_i|/(1 + |x_i|), is greater: with
  /// the default where nothing of the states is right. 0: no estimate, as in the source. y is put into the
  /// equation midway between the points; what is missing there, times h and through (1 - h df/dx)^-1, is the
  /// estimate, of order h^(p+2).
  double error_tolerance = 0.1;
  algebraic::Newton newton = mtl_newton;  ///< the iteration for a block's equations
};

/// @throws std::invalid_argument naming the option that is out of range
void check_options(const Mtl& method);

/// See integrate(). A step of the walk is a block of p steps; the last block may be shorter.
/// @throws std::invalid_argument also for options out of range
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Mtl& method);

}  // namespace nlmech::ivp

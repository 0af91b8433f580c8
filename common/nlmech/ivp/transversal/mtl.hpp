/// @file
/// Multi-step transversal linearisation (Roy): exact for the linear part, nonlinear terms interpolated over p
/// steps.
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

/// Linear part that Mtl solves exactly; the rest of the right-hand side is interpolated. The order is the
/// same for all.
enum class MtlLinear {
  given,    ///< the constant linear terms of the equations (System::linear_terms())
  zero,     ///< none (x'' = 0 for a problem with accelerations): collocation at equidistant points
  jacobian  ///< df/dx at the start of each block of p steps: for stiff problems, whose linear terms may grow
            ///< although solutions do not. Costs one exponential per block; not symmetric in time
};

/// "given", "zero", "jacobian".
[[nodiscard]] std::string_view to_string(MtlLinear linear);

/// Options of Newton's iteration for Mtl.
inline constexpr algebraic::Newton mtl_newton = {.tolerance = 1e-12, .noise = 1e-8, .iterations = 50};

/// Multi-step transversal linearisation (D. Roy, A multi-step transversal linearization method in nonlinear
/// dynamics, extended summary). Over p steps of length h the equation x' = A x + g(t, x) + load is replaced
/// by
///
///     y' = A y + sum over k = 0..p of g(t_k, x_k) phi_k(t) + load                          (Eqs 3, 4)
///
/// and the states at t_1..t_p satisfy y(t_l) = x_l (Eq. 5): p n equations, solved by Newton's iteration with
/// the exact Jacobian. The response to harmonic loads is exact; linear problems are exact to rounding for
/// every h. For problems with accelerations A = [0 1; -K -C] and g acts on the velocities. Order:
/// mtl_order().
///
/// With a fixed A the method is symmetric in time, so energies of oscillators do not drift; it is not
/// symplectic and not L-stable. The equations of a step that is too large may have roots that are no
/// solutions of the problem; error_tolerance turns these into a failure status. Dense output: y, exact for
/// linear problems; within a block of the order p + 1, like its inner points.
///
/// Tests assert mtl_order() (observed within 0.12), linear problems to rounding for every step size, symmetry
/// to 1e4 eps, and a recorded bound of the energy error (4 %).
struct Mtl {
  static constexpr std::string_view name = "mtl";  ///< on command lines and in tables
  double step = 0.1;                               ///< h, spacing of the points, positive
  int points = 3;                                  ///< p, from 1 to 8
  MtlBasis basis = MtlBasis::lagrange;             ///< phi_k
  double width = 3;                                ///< sigma/h of MtlBasis::daf, 2 or more
  MtlLinear linear = MtlLinear::given;             ///< A
  /// The run ends with `wrong_branch` if the error estimate of a block, max |e_i|/(1 + |x_i|), is greater;
  /// the default rejects states without a correct digit. 0: no estimate, as in the source. The estimate, of
  /// order h^(p+2), is (1 - h df/dx)^-1 h times the residual of y midway between the points.
  double error_tolerance = 0.1;
  algebraic::Newton newton = mtl_newton;  ///< the iteration for a block's equations
};

/// @throws std::invalid_argument naming the option that is out of range
void check_options(const Mtl& method);

/// See integrate(). A step in the statistics and for observers is a block of p steps; the last block may be
/// shorter.
/// @throws std::invalid_argument also for options out of range
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Mtl& method);

}  // namespace nlmech::ivp

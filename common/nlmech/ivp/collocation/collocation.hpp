/// @file
/// Collocation in time with fixed steps: radial basis functions (RBF-Coll of the dissertation) and their
/// polynomial limit.
#pragma once

#include <string_view>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/collocation/basis.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Options of Newton's iteration for collocation. Rounding in the derivative matrix limits the updates from
/// below; an iteration that stalls below `noise` counts as converged.
inline constexpr algebraic::Newton collocation_newton = {.tolerance = 1e-12, .noise = 1e-6, .iterations = 50};

/// RBF-Coll (Elgohary 2015, section 4.2, Eqs 4.12-4.16): in each step the state is a sum of radial basis
/// functions centred at N nodes; the equations hold at all nodes but the first, where the state is known.
/// Newton's iteration with the exact Jacobian solves for all unknowns at once, from the constant state. A
/// fixed step has no error estimate: past a pole of the solution, or across a jump much shorter than the
/// step, Newton's iteration may find a root of the step's equations that is not a solution of the problem.
/// The truncation error decreases with the shape c, but the condition of the basis deteriorates: in double
/// precision errors below about 1e-8 cannot be reached. PolynomialCollocation has no such limit.
///
/// Tests assert agreement with the polynomial limit for c h = 0.1 (3 %), and a failure status for extreme
/// shapes, small and large.
struct RbfCollocation {
  static constexpr std::string_view name = "rbf-coll";  ///< on command lines and in tables
  double step = 0.1;                                    ///< step size, positive
  int nodes = 7;                                        ///< N, from 2 to 200
  /// c in 1/time (Eq. 4.8); 0 for the dissertation's rule (N - 1) / (4 step). A shortened step keeps c h, and
  /// so the condition of the basis.
  double shape = 0;
  collocation::Kernel kernel = collocation::Kernel::gaussian;  ///< radial function (Eq. 4.8)
  collocation::NodeFamily points = collocation::NodeFamily::legendre_gauss_lobatto;  ///< family of nodes
  collocation::Inversion inversion =
      collocation::Inversion::solve;              ///< how the derivative matrix is formed (Eq. 4.15)
  algebraic::Newton newton = collocation_newton;  ///< the iteration for a step's equations
};

/// The limit c -> 0 of RbfCollocation: polynomials through the same nodes, computed without loss of digits.
/// With Legendre-Gauss-Lobatto nodes it is an implicit Runge-Kutta method of N - 1 stages and order N - 1,
/// not A-stable; with the left end and Radau nodes it is Radau IIA of order 2 N - 3, L-stable.
///
/// Tests assert the orders N - 1 and 2 N - 3 for 3 to 6 nodes (observed within 0.1 to 0.25), polynomials of
/// its degree to rounding, and the known growth in the instability window of Lobatto nodes (2e-4).
struct PolynomialCollocation {
  static constexpr std::string_view name = "polynomial-coll";   ///< the family; messages name the nodes
  static constexpr std::string_view lobatto_name = "lgl-coll";  ///< on command lines, with Lobatto nodes
  static constexpr std::string_view radau_name = "radau-coll";  ///< with the left end and Radau nodes
  double step = 0.1;                                            ///< step size, positive
  int nodes = 7;                                                ///< N, from 2 to 200
  collocation::NodeFamily points = collocation::NodeFamily::legendre_gauss_lobatto;  ///< family of nodes
  algebraic::Newton newton = collocation_newton;  ///< the iteration for a step's equations
};

/// The name of a method, for messages.
[[nodiscard]] constexpr std::string_view name_of(const RbfCollocation& /*method*/) {
  return RbfCollocation::name;
}
/// The name of its nodes on command lines, "lgl-coll" or "radau-coll"; "polynomial-coll" with others.
[[nodiscard]] constexpr std::string_view name_of(const PolynomialCollocation& method) {
  switch (method.points) {
    case collocation::NodeFamily::legendre_gauss_lobatto: return PolynomialCollocation::lobatto_name;
    case collocation::NodeFamily::left_end_and_radau: return PolynomialCollocation::radau_name;
    default: return PolynomialCollocation::name;
  }
}

/// The basis of a method. @throws std::invalid_argument for options out of range
[[nodiscard]] collocation::Basis basis_of(const RbfCollocation& method);
/// The basis of a method. @throws std::invalid_argument for options out of range
[[nodiscard]] collocation::Basis basis_of(const PolynomialCollocation& method);

/// See integrate().
/// @{
[[nodiscard]] Solution run(const InitialValueProblem& problem, const RbfCollocation& method);
[[nodiscard]] Solution run(const InitialValueProblem& problem, const PolynomialCollocation& method);
/// @}

}  // namespace nlmech::ivp

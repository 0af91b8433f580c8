/// @file
/// Collocation in time, step by step: radial basis functions (the dissertation's RBF-Coll) and their
/// polynomial limit.
#pragma once

#include <string_view>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/collocation/basis.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Newton's iteration as collocation uses it. Rounding in the derivative matrix sets a floor under the
/// updates; an iteration that stalls on it, below `noise`, is done.
inline constexpr algebraic::Newton collocation_newton = {.tolerance = 1e-12, .noise = 1e-6, .iterations = 50};

/// RBF-Coll (Elgohary 2015, section 4.2, Eqs 4.12-4.16): in each step the state is a sum of radial basis
/// functions centred at N nodes; the equations hold at all nodes but the first, where the state is known. All
/// unknowns at once by Newton's iteration with exact Jacobian, from the constant state.
/// A fixed step has no error estimate: past a pole of the solution, or across a jump much shorter than the
/// step, Newton's iteration may find a root of the step's equations that is no solution of the problem. The
/// truncation error and the condition of the basis pull the shape in opposite directions: in double precision
/// errors below about 1e-8 are not to be had; PolynomialCollocation has no such floor.
///
/// Tests hold it to its polynomial limit for c h = 0.1 (3 %), and to a status, not a number, at both ends of
/// the shape.
struct RbfCollocation {
  static constexpr std::string_view name = "rbf-coll";  ///< on command lines and in tables
  double step = 0.1;                                    ///< length of a step, positive
  int nodes = 7;                                        ///< N, from 2 to 200
  /// c in 1/time (Eq. 4.8); 0 for the dissertation's rule (N - 1) / (4 step). A shortened step keeps c times
  /// its length, and with it the condition of the basis.
  double shape = 0;
  collocation::Kernel kernel = collocation::Kernel::gaussian;  ///< which radial function (Eq. 4.8)
  collocation::NodeFamily points =
      collocation::NodeFamily::legendre_gauss_lobatto;  ///< where the nodes stand
  collocation::Inversion inversion =
      collocation::Inversion::solve;              ///< how the derivative matrix is formed (Eq. 4.15)
  algebraic::Newton newton = collocation_newton;  ///< the iteration for a step's equations
};

/// The limit c -> 0 of RbfCollocation: polynomials through the same nodes, formed without loss of digits.
/// With Legendre-Gauss-Lobatto nodes an implicit Runge-Kutta method of N - 1 stages and order N - 1, not
/// A-stable; with the left end and Radau nodes Radau IIA of order 2 N - 3, L-stable.
///
/// Tests hold it to the orders N - 1 and 2 N - 3 for 3 to 6 nodes (observed within 0.1 to 0.25), to
/// polynomials of its degree, which it solves to rounding, and to known growth at the instability window of
/// Lobatto nodes (2e-4).
struct PolynomialCollocation {
  static constexpr std::string_view name = "polynomial-coll";   ///< the family; messages name the nodes
  static constexpr std::string_view lobatto_name = "lgl-coll";  ///< on command lines, with Lobatto nodes
  static constexpr std::string_view radau_name = "radau-coll";  ///< with the left end and Radau nodes
  double step = 0.1;                                            ///< length of a step, positive
  int nodes = 7;                                                ///< N, from 2 to 200
  collocation::NodeFamily points =
      collocation::NodeFamily::legendre_gauss_lobatto;  ///< where the nodes stand
  algebraic::Newton newton = collocation_newton;        ///< the iteration for a step's equations
};

/// What messages call a method.
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

/// @file
/// Scalar homotopies: F(x) = 0 as the end of a flow that never solves a system with dF/dx.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Follows h(x, t) = (t |G|^2 - (1 - t) |x - x(0)|^2)/2 = 0, G = c F, from t = 0 to 1 (Elgohary 2015,
/// Eq. 2.11, with c = 1; Liu, Yeih, Kuo and Atluri 2009) along u = dh/dx:
///
///     dx/dt = -(|G|^2 + |x - x(0)|^2)/2 w/|w|^2,   w = dh/dx = t c B^T G - (1 - t)(x - x(0))
///
/// In t the flow starts and ends with an infinite velocity, like t^-1/2 and (1 - t)^-1/2, and at the start,
/// where w = 0, its direction is free. In the angle phi with t = sin^2 phi, for which h = 0 says
/// tan phi = |x - x(0)|/|G|, the velocity is finite: the flow is taken in phi from 0 to pi/2, by the midpoint
/// rule, and starts along -B^T F. Its way in x is about as long as |G|, so the units of F matter; hence c.
///
/// At t = 1 the rule's error is left of |F|. The homotopy then begins anew from there: every pass shortens
/// |F| by about the error of the rule, of order 2 in one variable, as long as the matrix is well conditioned.
///
/// Tests hold its function to stay zero to second order of the step (ratio of errors within 0.5 of 4).
struct FirstScalarHomotopy {
  /// c, positive; 0: |B^T F|/|B B^T F| at the start of each pass, which is |B^-1| for one unknown and makes
  /// the flow independent of the units of F.
  double weight = 0;
  int steps = 20;                    ///< of equal length in phi in a pass; at least 1
  double tolerance = 1e-10;          ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t iterations = 20'000;  ///< at most so many steps, in all passes
};

/// Products with B and B^T are all it needs; two evaluations of F and B a step. Report::time is t of the pass
/// under way. Outcomes besides success: `singular_matrix` where w vanishes, as on the way to a minimum of
/// |F|; `non_finite`; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] Report find_root(const FirstScalarHomotopy& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Follows x(t) in a fictitious time t along which a scalar function h(x, t) stays zero (Elgohary 2015,
/// section 2.2; Eq. 2.14). With B = dF/dx, the driving vector u = dh/dx and Q = e^t:
///
///     fixed point   h = |F|^2/2 - |x - x(0)|^2/(2 Q)      dx/dt = -|F|^2/2 w/|w|^2, w = B^T F - (x - x(0))/Q
///     Newton        h = |F|^2/2 - |F(x(0))|^2/(2 Q)       dx/dt = -|F|^2/2 w/|w|^2, w = B^T F
///
/// These are Eqs 2.15 and 2.16 with the signs that keep h zero; Eqs 2.12, 2.13 and 2.15 print + for -. On the
/// exact flow |F|^2 Q = |F(0)|^2 for Newton; the fixed-point flow starts with h = |F(0)|^2/2, not on h = 0,
/// and has |F|^2 Q - |x - x(0)|^2 = |F(0)|^2. Both flows agree for t -> infinity.
///
/// What that buys, and what it does not. A step costs F once, B once and the product B^T F, and a singular B
/// is no obstacle as long as B^T F is not zero. But w is the direction of steepest descent of |F|^2/2: near
/// a root, with a step of Euler's rule of length 1, this is gradient descent with Polyak's step length, and
/// the number of iterations grows like cond(B)^2. In one variable a step dt is Newton's step times dt/2. For
/// linear F Euler's rule of any step below 4 brings x closer to every root. The flow is not defined where
/// B^T F = 0 and F is not, at a minimum of |F|; Euler's rule with a fixed step mostly jumps over it, and
/// wanders if no root is near.
///
/// Tests compare the flow with the exact one in one variable, its invariant to first order (ratio of errors
/// within 0.1 of 2), the first step with Newton's times dt/2, and the path with that in turned coordinates
/// (1e-11).
struct ScalarHomotopy {
  /// Which h.
  enum class Function : std::uint8_t {
    fixed_point,  ///< Eqs 2.12 and 2.15
    newton        ///< Eqs 2.13 and 2.16
  };
  Function function = Function::fixed_point;  ///< which h
  double step = 1;                            ///< of fictitious time by Euler's rule, positive
  double tolerance = 1e-10;                   ///< done when |F|, Euclidean, is no greater; not negative
  std::int64_t steps = 100'000;               ///< at most so many steps; else `step_limit`
};

/// Runs the flow. Outcomes besides success: `singular_matrix` where w vanishes and F does not; `non_finite`
/// if F or B^T F is not finite; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range, or x has another size than the equations
[[nodiscard]] Report find_root(const ScalarHomotopy& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

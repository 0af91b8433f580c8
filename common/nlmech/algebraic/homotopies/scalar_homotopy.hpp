/// @file
/// Scalar homotopy methods for F(x) = 0, which need no linear solves with dF/dx.
#pragma once

#include <cstdint>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Follows h(x, t) = (t |G|^2 - (1 - t) |x - x(0)|^2)/2 = 0, G = c F, from t = 0 to 1 (Elgohary 2015,
/// Eq. 2.11, with c = 1; Liu, Yeih, Kuo and Atluri 2009) along u = dh/dx:
///
///     dx/dt = -(|G|^2 + |x - x(0)|^2)/2 w/|w|^2,   w = dh/dx = t c B^T G - (1 - t)(x - x(0))
///
/// In t the velocity is infinite at both ends, like t^-1/2 and (1 - t)^-1/2, and at the start, where w = 0,
/// its direction is free. With t = sin^2 phi, where h = 0 reads tan phi = |x - x(0)|/|G|, the velocity is
/// finite. The flow is therefore integrated in phi from 0 to pi/2 by the midpoint rule, starting along -B^T
/// F. The distance covered in x is about |G|, so the units of F matter; hence c.
///
/// At t = 1 |F| is the error of the midpoint rule. The homotopy then restarts from there: each pass reduces
/// |F| by about the error of the rule, of order 2 in one variable, as long as the matrix is well conditioned.
///
/// Tests check that h stays zero to second order in the step size (ratio of errors within 0.5 of 4).
struct FirstScalarHomotopy {
  /// c, positive; 0: |B^T F|/|B B^T F| at the start of each pass, which is |B^-1| for one unknown and makes
  /// the flow independent of the units of F.
  double weight = 0;
  int steps = 20;                    ///< equal steps in phi per pass; at least 1
  double tolerance = 1e-10;          ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t iterations = 20'000;  ///< limit of steps in all passes
};

/// Needs products with B and B^T only; two evaluations of F and B per step. Report::time is t of the current
/// pass. Outcomes besides success: `singular_matrix` where w vanishes, as near a minimum of |F|;
/// `non_finite`; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations
[[nodiscard]] Report find_root(const FirstScalarHomotopy& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

/// Integrates x(t) in a fictitious time t so that a scalar function h(x, t) stays zero (Elgohary 2015,
/// section 2.2; Eq. 2.14). With B = dF/dx, the driving vector u = dh/dx and Q = e^t:
///
///     fixed point   h = |F|^2/2 - |x - x(0)|^2/(2 Q)      dx/dt = -|F|^2/2 w/|w|^2, w = B^T F - (x - x(0))/Q
///     Newton        h = |F|^2/2 - |F(x(0))|^2/(2 Q)       dx/dt = -|F|^2/2 w/|w|^2, w = B^T F
///
/// These are Eqs 2.15 and 2.16 with the signs that keep h zero; Eqs 2.12, 2.13 and 2.15 print + for -. On the
/// exact flow |F|^2 Q = |F(0)|^2 for Newton; the fixed-point flow starts with h = |F(0)|^2/2, not on h = 0,
/// and has |F|^2 Q - |x - x(0)|^2 = |F(0)|^2. Both flows agree for t -> infinity.
///
/// Cost and limits: a step evaluates F, B and the product B^T F once. A singular B is allowed as long as B^T
/// F is not zero. But w is the direction of steepest descent of |F|^2/2: near a root, Euler's method with
/// step size 1 is gradient descent with Polyak's step size, and the number of iterations grows like
/// cond(B)^2. In one variable a step dt is Newton's step times dt/2. For linear F, Euler's method with any
/// step size below 4 brings x closer to every root. The flow is not defined at a minimum of |F|, where B^T F
/// = 0 and F is not; Euler's method with a fixed step size mostly jumps over it, and does not converge if no
/// root is near.
///
/// Tests compare the flow with the exact one in one variable, check its invariant to first order (ratio of
/// errors within 0.1 of 2), and compare the first step with Newton's times dt/2 and the path with that in
/// rotated coordinates (1e-11).
struct ScalarHomotopy {
  /// Choice of h.
  enum class Function : std::uint8_t {
    fixed_point,  ///< Eqs 2.12 and 2.15
    newton        ///< Eqs 2.13 and 2.16
  };
  Function function = Function::fixed_point;  ///< which h
  double step = 1;                            ///< step size of Euler's method in fictitious time, positive
  double tolerance = 1e-10;      ///< converged when |F|, Euclidean, is at most this; not negative
  std::int64_t steps = 100'000;  ///< limit of steps; then `step_limit`
};

/// Runs the flow. Outcomes besides success: `singular_matrix` where w vanishes and F does not; `non_finite`
/// if F or B^T F is not finite; `step_limit`; `interrupted`.
/// @throws std::invalid_argument if an option is out of range, or x has another size than the equations
[[nodiscard]] Report find_root(const ScalarHomotopy& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

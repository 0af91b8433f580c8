/// @file
/// The first scalar homotopy, in t from 0 to 1.
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

}  // namespace nlmech::algebraic

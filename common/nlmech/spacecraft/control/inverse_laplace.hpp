/// @file
/// Numerical inversion of Laplace transforms on a fixed Talbot contour, with a check of its own result.
///
/// Finitely many values of F determine f only within a class of transforms. A success is proved, to the
/// requested agreement, if F is analytic except for singularities
///
/// - inside the contour, which two sums over different contours show to be resolved,
/// - to the left of the rays at 135 degrees to the real axis, which decay within the first periods, and
/// - simple poles between these rays, up to 1.7e10 times the contour's size, and double ones up to |s| t =
///   1000.
///   The check measures their residues, and more than the agreement allows is `not_converged`.
///
/// For that F is evaluated to the left of its singularities. Outside the class - a delay, F known on the
/// right only, more oscillations than the contour resolves - the status is `not_converged` or `non_finite`.
#pragma once

#include <complex>
#include <functional>

#include "nlmech/support/status.hpp"

namespace nlmech::spacecraft {

/// F(s), the transform of a real function of time: F(conj s) = conj F(s).
using Transform = std::function<std::complex<double>(std::complex<double>)>;

/// f(t) as the inversion gives it.
struct Inverted {
  double value = 0;  ///< f(t); of no use if the status is a failure
  /// Success if the value is verified; `not_converged` if not: it may be right or wrong; `non_finite` if F is
  /// NaN or infinite at a point of the contour.
  Status status;
};

/// Options of talbot().
struct TalbotOptions {
  int nodes = 24;           ///< M, 2 to 200: with the second sum and the check 1100 + 2.25 M evaluations of F
  double agreement = 1e-6;  ///< of two sums, and of what may be missed, relative to the value; positive
  double negligible = 0;    ///< differences below this do not count, for times at which f is about zero; >= 0
};

/// The fixed Talbot method of Abate and Valko (Int. J. Numer. Meth. Engng 60, 2004):
///
///     f(t) ~ r/M { F(r) e^(rt) / 2 + sum_{k=1}^{M-1} Re[e^(s_k t) F(s_k) (1 + i sigma_k)] },
///     r = 2M/(5t), s_k = r theta_k (cot theta_k + i), theta_k = k pi/M.
///
/// The contour opens to the left and leaves poles of large imaginary part outside: right for functions
/// without fast oscillations, 1e-9 of max |f| with 24 nodes for smooth ones; each node more loses 0.17 digits
/// to rounding, e^(2M/5) eps in all. It misses all modes of a flexible structure above about M/t, and the
/// status says so.
///
/// Tests hold smooth functions to 1e-9, and 1 - cos(wt) for any w to a right value or `not_converged`.
/// @param transform F(s), without singularities to the right of the contour
/// @param time t > 0
/// @throws std::invalid_argument for a time that is not positive and finite, or options out of range
[[nodiscard]] Inverted talbot(const Transform& transform, double time, const TalbotOptions& options = {});

/// The sum of talbot() alone, unverified: M values of F. For comparisons of methods.
[[nodiscard]] double talbot_sum(const Transform& transform, double time, int nodes = 24);

}  // namespace nlmech::spacecraft

/// @file
/// Numerical inversion of Laplace transforms: fixed Talbot contour, de Hoog's continued fraction, Durbin's
/// trapezoidal sum on a Bromwich line. Each verifies itself.
///
/// A number of values of F says nothing of f without knowing of what kind F is. The class for which a success
/// is a proof, to the agreement asked for: F is analytic but for singularities
///
/// - within the frequencies of the method, which two sums with different contours show to be resolved,
/// - to the left of the rays at 135 degrees to the real axis, which decay within the first periods, and
/// - simple poles between these rays, up to 1.7e10 times those frequencies, and double ones up to |s| t =
/// 1000.
///   Their residues are measured (missed_residues()), and more than the agreement allows is `not_converged`.
///
/// F is evaluated to the left of its singularities for that. Outside the class - a delay, F known on the
/// right only, more oscillations than the method resolves - the status is `not_converged` or `non_finite`.
#pragma once

#include <complex>
#include <functional>
#include <span>
#include <vector>

#include "nlmech/support/status.hpp"

namespace nlmech::spacecraft {

/// F(s), the transform of a real function of time: F(conj s) = conj F(s).
using Transform = std::function<std::complex<double>(std::complex<double>)>;

/// f(t) as one of the inversions gives it.
struct Inverted {
  double value = 0;  ///< f(t); of no use if the status is a failure
  /// Success if the value is verified; `not_converged` if not: it may be right or wrong; `non_finite` if F is
  /// NaN or infinite at a point of the contour.
  Status status;
};

/// What talbot() may be told.
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
/// to rounding, e^(2M/5) eps in all. A flexible structure's modes above about M/t are missed altogether,
/// which the status says.
///
/// Tests hold smooth functions to 1e-9, and 1 - cos(wt) for any w to a right value or `not_converged`.
/// @param transform F(s), without singularities to the right of the contour
/// @param time t > 0
/// @throws std::invalid_argument for a time that is not positive and finite, or options out of range
[[nodiscard]] Inverted talbot(const Transform& transform, double time, const TalbotOptions& options = {});

/// The sum of talbot() alone: M values of F, and nothing is known of its error. For comparisons of methods.
[[nodiscard]] double talbot_sum(const Transform& transform, double time, int nodes = 24);

/// What de_hoog() may be told.
struct DeHoogOptions {
  int degree = 40;          ///< M, 1 to 1000: with two more sums and the check 1100 + 6M evaluations of F
  double tolerance = 1e-9;  ///< aliasing e^(-2 (shift - abscissa) T) that is allowed; between 0 and 1
  double abscissa = 0;      ///< the largest real part of a singularity of F
  double scale = 2;         ///< T/t, above 1/2: half the period over the time
  double agreement = 1e-4;  ///< of two sums with different T, relative to the larger; positive
  double negligible = 0;    ///< differences below this do not count, for times at which f is about zero; >= 0
};

/// The quotient-difference algorithm of de Hoog, Knight and Stokes (SIAM J. Sci. Stat. Comput. 3, 1982): the
/// Fourier series of Durbin with half period T = scale t, summed as a continued fraction with its remainder
/// estimated. Good to about the tolerance where 2M + 1 frequencies k pi/T reach beyond the modes that
/// matter; not for late times of a lightly damped structure, whose many terms the continued fraction loses
/// to rounding.
///
/// Two more sums, with T longer by a tenth and by a quarter, show what is not resolved: their frequencies and
/// their rounding are others. Where they do not agree, or residues are left out beyond a quarter of the
/// highest frequency, the status is `not_converged`, the value that of the first. Right values may be
/// refused, above all those near a zero of f, as the agreement is relative.
///
/// Tests hold smooth functions to 1e-8, and sines and 1 - cos(wt) at degrees from 10 to 240, below the
/// frequencies of the sum and far beyond, to a right value or `not_converged`.
/// @throws std::invalid_argument for a time that is not positive and finite or options out of range
[[nodiscard]] Inverted de_hoog(const Transform& transform, double time, const DeHoogOptions& options = {});

/// The first sum of de_hoog() alone: 2M + 1 values of F, and nothing is known of its error. For comparisons
/// of methods.
[[nodiscard]] double de_hoog_sum(const Transform& transform, double time, const DeHoogOptions& options = {});

/// What bromwich() may be told. The defaults suit times up to 60 s of the spacecraft of Table 3.1.
struct BromwichOptions {
  double half_period = 60;   ///< T; times must be below 2 T
  double shift = 0.25;       ///< c > the largest real part of a singularity; aliasing is e^(-2 c T)
  double frequency = 1.2e4;  ///< W, the highest frequency that is summed; at least pi/T
  double agreement = 1e-4;   ///< of what is left out, relative to the largest of the values; positive
};

/// Durbin's sum: the trapezoidal rule on the Bromwich line Re s = c,
///
///     f(t) ~ e^(ct)/T { F(c)/2 + sum_{k pi/T <= W} Re[F(c + i k pi/T) e^(i k pi t/T)] },
///
/// for many times at once, F being evaluated once a frequency. Errors: aliasing, f(t + 2T) e^(-2cT); and the
/// sum's rest, at most |F(c + iW)| e^(ct) / (pi t) where F decays smoothly, c t <= 10 being wise. These, and
/// the residues beyond W, are compared with the largest value; above the agreement the status is
/// `not_converged`. Aliasing is judged by the sum of every second term, so that a time above T, where that
/// sum begins anew, is not verified.
/// @returns one value a time, with the status of its sum
/// @throws std::invalid_argument for a time outside (0, 2T), or options out of range
[[nodiscard]] std::vector<Inverted> bromwich(const Transform& transform, std::span<const double> times,
                                             const BromwichOptions& options = {});

}  // namespace nlmech::spacecraft

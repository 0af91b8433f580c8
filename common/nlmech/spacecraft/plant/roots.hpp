/// @file
/// All zeros of an analytic function in a rectangle: counted by the argument principle, separated by
/// bisection, refined by Newton's method. Clusters of zeros are computed from power sums on a circle, and
/// residues at clustered poles as sums of exponentials without cancellation.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::spacecraft {

/// Rectangle of the complex plane, boundary included.
struct Rectangle {
  double left;    ///< least real part
  double right;   ///< largest real part, above left
  double bottom;  ///< least imaginary part
  double top;     ///< largest imaginary part, above bottom

  /// Whether it contains @p s.
  [[nodiscard]] bool contains(Complex s) const {
    return s.real() >= left && s.real() <= right && s.imag() >= bottom && s.imag() <= top;
  }
};

/// Analytic function, without poles in the region of the search, with its derivative. Value and slope may
/// have a common positive factor that differs between points: only phase and logarithmic derivative are used.
using AnalyticFunction = std::function<Jet(Complex)>;

/// Number of zeros in a region.
struct RootCount {
  int count = 0;  ///< with multiplicity
  Status status;  ///< success, or not_converged: a zero lies on or too near the boundary
};

/// Counts the zeros inside @p region by the change of the phase of F along its boundary. The steps are
/// limited to 0.7 rad, by the phase and the logarithmic derivative.
/// @throws std::invalid_argument if the region is empty or not finite
[[nodiscard]] RootCount count_roots(const AnalyticFunction& f, const Rectangle& region);

/// Zeros of a region.
struct Roots {
  std::vector<Complex> roots;   ///< by imaginary part, then real part; repeated by multiplicity
  int count = 0;                ///< number of zeros by the argument principle
  std::size_t evaluations = 0;  ///< number of evaluations of F
  Status status;                ///< success: all counted zeros were found
};

/// All zeros inside @p region, to the rounding of F. Zeros so close that F vanishes between them to rounding
/// have the accuracy of zeros_in_circle().
/// @return not_converged if a zero lies on the boundary or zeros could not be separated; step_limit after 400
/// 000 evaluations of F
/// @throws std::invalid_argument if the region is empty or not finite
[[nodiscard]] Roots find_roots(const AnalyticFunction& f, const Rectangle& region);

/// Result of Newton's method for a zero.
struct Root {
  Complex s;      ///< the zero
  Status status;  ///< success, not_converged (no small step within 50), or non_finite
};

/// Newton's iteration from @p start until a step is below 4 eps |s|, or is small and no longer decreases. The
/// last step is applied.
[[nodiscard]] Root refine_root(const AnalyticFunction& f, Complex start);

/// Points of the trapezoidal rule on a circle. With all zeros within half the radius or beyond twice the
/// radius, its error is 2^-64.
inline constexpr std::size_t circle_points = 64;

/// Zeros of z^m + sum a_j z^j, a_0 first, as eigenvalues of the companion matrix; backward stable. Real
/// coefficients give conjugate pairs.
[[nodiscard]] std::vector<Complex> polynomial_zeros(const std::vector<Complex>& a);

/// Zeros of an analytic function in a circle.
struct ZeroCluster {
  Complex centre;                   ///< of the circle
  double radius = 0;                ///< of the circle
  std::vector<Complex> zeros;       ///< zeros relative to the centre, repeated by multiplicity
  std::vector<Complex> polynomial;  ///< coefficients of the monic polynomial with these zeros, from z^0 on,
                                    ///< without the leading 1
  Status status;                    ///< success; not_converged if zeros lie near the circle; non_finite
};

/// Zeros of @p f within half of @p radius about @p centre, at most eight, from (1/2 pi i) times the integrals
/// of z^j f'/f. No zero may lie between half and twice the radius. The symmetric functions of the zeros are
/// accurate to rounding relative to the radius, even if zeros coincide.
/// @param f value and slope, up to a common positive factor
/// @throws std::invalid_argument unless radius is positive and finite
[[nodiscard]] ZeroCluster zeros_in_circle(const std::function<Jet(Complex)>& f, Complex centre,
                                          double radius);

/// Exponentials e^((centre + node) t) whose sum replaces the residues at a cluster of poles.
struct ClusterNodes {
  std::vector<Complex> nodes;                 ///< nodes relative to the centre
  std::vector<std::vector<Complex>> weights;  ///< [signal][node]
};

/// Exponentials with the same sum as the residues of signals whose only poles in the circle are the zeros of
/// @p cluster. The nodes are the poles if these are spread over at least a tenth of @p decay, else 24 points
/// of a circle around them with a radius of a tenth to a third of @p decay; the relative error of these is
/// below 1e-13.
/// @param moments for each signal (1/2 pi i) times the integrals of z^j times its transform, j = 0, 1, ...,
/// one per zero
/// @param decay -Re of the centre; if not positive, the nodes are the poles
/// @param own whether the cluster is its own complex conjugate; then only nodes with Im >= 0 are returned,
/// and real nodes have half their weight
[[nodiscard]] ClusterNodes cluster_nodes(const ZeroCluster& cluster,
                                         const std::vector<std::vector<Complex>>& moments, double decay,
                                         bool own);

}  // namespace nlmech::spacecraft

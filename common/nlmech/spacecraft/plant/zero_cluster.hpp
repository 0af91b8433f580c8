/// @file
/// Zeros that lie close to each other, by their power sums along a circle; and functions with poles there, as
/// sums of exponentials that nothing cancels in.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::spacecraft {

/// Points of the trapezoidal rule on a circle. With zeros within half the radius, and others beyond twice the
/// radius, what it leaves out is 2^-64.
inline constexpr std::size_t circle_points = 64;

/// Zeros of z^m + sum a_j z^j, a_0 first, by the eigenvalues of its companion matrix: right for coefficients
/// that are off by rounding. Real coefficients give conjugate pairs.
[[nodiscard]] std::vector<Complex> polynomial_zeros(const std::vector<Complex>& a);

/// The zeros of an analytic function in a circle.
struct ZeroCluster {
  Complex centre;              ///< of the circle
  double radius = 0;           ///< of the circle
  std::vector<Complex> zeros;  ///< less the centre; a multiple one as often as it counts
  std::vector<Complex>
      polynomial;  ///< monic, with these zeros: its coefficients from z^0 on, without the last
  Status status;   ///< success; not_converged if zeros lie near the circle; non_finite
};

/// The zeros of @p f within half of @p radius about @p centre, at most eight, if none lies between that and
/// twice the radius, from (1/2 pi i) times the integrals of z^j f'/f. Their sums, products and so on are
/// right to rounding, times the radius, even where the zeros coincide.
/// @param f value and slope, up to a positive common factor
/// @throws std::invalid_argument unless radius is positive and finite
[[nodiscard]] ZeroCluster zeros_in_circle(const std::function<Jet(Complex)>& f, Complex centre,
                                          double radius);

/// Exponentials e^((centre + node) t) that stand for all the residues at a cluster of poles.
struct ClusterNodes {
  std::vector<Complex> nodes;                 ///< less the centre
  std::vector<std::vector<Complex>> weights;  ///< one a signal: one a node
};

/// For signals with poles at the zeros of @p cluster and nowhere else in its circle, exponentials with the
/// same sum: at the poles, where they are far enough from each other for their decay, and else at 24 points
/// of a circle round them, with a radius of a tenth to a third of @p decay, which leave out less than 1e-13
/// of it.
/// @param moments one a signal: (1/2 pi i) times the integrals of z^j times its transform, j = 0, 1, ..., as
/// many as zeros
/// @param decay -Re of the centre; if it is not positive the nodes are the poles
/// @param own is the cluster its own mirror image? Then the nodes are conjugate pairs or real
[[nodiscard]] ClusterNodes cluster_nodes(const ZeroCluster& cluster,
                                         const std::vector<std::vector<Complex>>& moments, double decay,
                                         bool own);

}  // namespace nlmech::spacecraft

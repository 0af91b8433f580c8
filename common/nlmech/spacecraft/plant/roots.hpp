/// @file
/// All zeros of an analytic function in a rectangle: counted by the argument principle, separated by halving,
/// refined by Newton's method. Zeros that lie close to each other, by their power sums along a circle; and
/// functions with poles there, as sums of exponentials that nothing cancels in.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "nlmech/spacecraft/plant/jet.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::spacecraft {

/// A part of the complex plane, boundary included.
struct Rectangle {
  double left;    ///< least real part
  double right;   ///< largest real part, above left
  double bottom;  ///< least imaginary part
  double top;     ///< largest imaginary part, above bottom

  /// Does it contain @p s?
  [[nodiscard]] bool contains(Complex s) const {
    return s.real() >= left && s.real() <= right && s.imag() >= bottom && s.imag() <= top;
  }
};

/// An analytic function without poles in the region looked at, with its derivative. A positive factor common
/// to value and slope may differ from point to point: only phase and logarithmic derivative are used.
using AnalyticFunction = std::function<Jet(Complex)>;

/// How many zeros a region holds.
struct RootCount {
  int count = 0;  ///< with multiplicity
  Status status;  ///< success, or not_converged: a zero lies on the boundary or too near to it
};

/// Counts the zeros inside @p region by the phase of F along its boundary, followed in steps of at most 0.7
/// rad by both phase and logarithmic derivative.
/// @throws std::invalid_argument if the region is empty or not finite
[[nodiscard]] RootCount count_roots(const AnalyticFunction& f, const Rectangle& region);

/// Zeros of a region.
struct Roots {
  std::vector<Complex> roots;   ///< by imaginary part, then real part; a multiple one as often as it counts
  int count = 0;                ///< by the argument principle
  std::size_t evaluations = 0;  ///< values of F that were taken
  Status status;                ///< success: as many were found as counted
};

/// All zeros inside @p region, each to the rounding of F; zeros so close to each other that F vanishes
/// between them to rounding, to what their power sums along a circle say (zeros_in_circle()).
/// @return not_converged if a zero lies on the boundary, or zeros could not be separated; step_limit after
/// 400 000 values of F
/// @throws std::invalid_argument if the region is empty or not finite
[[nodiscard]] Roots find_roots(const AnalyticFunction& f, const Rectangle& region);

/// A zero by Newton's method.
struct Root {
  Complex s;      ///< the zero
  Status status;  ///< success, not_converged (steps did not become small in 50), or non_finite
};

/// Newton's iteration from @p start until a step is below 4 eps |s|, or is small and no longer shrinks; a
/// last step is always made.
[[nodiscard]] Root refine_root(const AnalyticFunction& f, Complex start);

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

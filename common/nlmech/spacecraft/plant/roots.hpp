/// @file
/// All zeros of an analytic function in a rectangle: counted by the argument principle, separated by halving,
/// refined by Newton's method.
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

}  // namespace nlmech::spacecraft

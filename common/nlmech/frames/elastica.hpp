/// @file
/// The toggle as an exact elastica: what frames of more and more elements converge to.
#pragma once

#include <vector>

#include "nlmech/frames/toggle.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// An equilibrium of half the toggle: a rod from the clamped base to the apex, which moves down only.
struct ElasticaPoint {
  double drop = 0;        ///< of the apex
  double load = 0;        ///< W on the whole toggle
  double slope = 0;       ///< dW/ddrop; 0 at a limit point
  double horizontal = 0;  ///< horizontal force in the rod, tension positive
  double moment = 0;      ///< bending moment at the base
  /// `not_converged` if Newton's iteration fails, from which on the point is of no use
  Outcome outcome = Outcome::success;
};

/// An extensible rod that bends by M = EI dtheta/ds and stretches by N/EA, s being its length at rest:
///
///     x' = (1 + N/EA) cos theta, y' = (1 + N/EA) sin theta, theta' = M/EI, M' = H y' - V x',
///     N = H cos theta + V sin theta,
///
/// with H, V and M(0) such that x, y and theta are right at the apex, found by shooting: the classical rule
/// of fourth order, in long double with derivatives by dual numbers, and Newton's iteration. With 1000 steps
/// loads are right to 1e-11 of themselves (against 2000 steps).
class Elastica {
 public:
  /// @param toggle height, length, EA and EI; the rest is not looked at
  /// @param steps of the integration, at least 10
  /// @throws std::invalid_argument for a toggle that make_frame() would refuse, or too few steps
  explicit Elastica(const Toggle& toggle, int steps = 1000);

  /// The equilibrium at @p drop, from one that is near.
  [[nodiscard]] ElasticaPoint at(double drop, const ElasticaPoint& near) const;
  /// From rest to @p drop in @p points equal parts.
  /// @throws std::invalid_argument if @p points is below 1
  [[nodiscard]] std::vector<ElasticaPoint> curve(double drop, int points) const;
  /// The limit point between two points of a curve(), whose slopes have different signs. Drops are right to
  /// the root of a rounding, loads to rounding.
  [[nodiscard]] ElasticaPoint limit(const ElasticaPoint& low, const ElasticaPoint& high) const;

 private:
  Toggle toggle_;
  int steps_;
};

}  // namespace nlmech::frames

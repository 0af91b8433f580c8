/// @file
/// Cartesian to geodetic coordinates, for single points or batches, in full double precision.
#pragma once

#include <cstddef>
#include <span>

#include "nlmech/geodesy/closest_point.hpp"
#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/geodesy/kernels/kernel.hpp"
#include "nlmech/support/instruction_set.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::geodesy {

/// Outcome of a batch: numbers of points computed by ClosestPoint and of points without a finite result.
struct BatchReport {
  std::size_t points = 0;            ///< size of the batch
  std::size_t fallbacks = 0;         ///< points computed by ClosestPoint, including non-finite ones
  std::size_t non_finite = 0;        ///< points whose result is not finite
  std::size_t first_non_finite = 0;  ///< index of the first non-finite point, if any

  /// Success, or Outcome::non_finite with the number of such points and the index of the first.
  [[nodiscard]] Status status() const;
};

/// Reverse geodetic transformation: x, y, z to latitude, longitude, height.
///
/// Method: the perturbation solution for tan(phi - phi_0), phi_0 the geocentric latitude (Elgohary 2015, Sec.
/// 2.4), in the economised form of TangentFit, without iteration; the only trigonometric functions are two
/// arctangents. For flattenings up to about 1/287 (all ellipsoids in use for the Earth) the polynomial alone
/// is exact to rounding; up to about 1/7 one or two Newton corrections follow. Points below the range of the
/// polynomial (R < 0.9975 min(a, b), for the Earth h < -15.9 km at the poles), points farther than 1e150 m
/// and all points of flatter ellipsoids are computed by ClosestPoint, so every finite point has a result of
/// full accuracy. The conventions for signs of zeros, the axis and the disc around the centre are those of
/// ClosestPoint.
///
/// Accuracy for an ellipsoid of the Earth's size and flattening, the coordinates taken as exact, heights from
/// -10 km to 35000 km: latitude and longitude 4e-16 rad, the bound of the sum of all rounding errors (the
/// greatest errors of 1e6 random points are 2.5e-16 and 3.2e-16); height 2.5e-9 m below 100 km and 2.2e-8 m
/// up to 35000 km, where the spacing of doubles is 7e-9 m. Above 35000 km the height has a relative error of
/// 6e-16. Latitudes never exceed pi/2 in double precision; they are exact at the poles and on the equator.
///
/// Results do not depend on the size of a batch or the index of a point, and equal those of single points.
/// AVX2 and AVX-512 give the same bits; the baseline, without fused multiply-add, may differ in the last
/// digits. All members are thread-safe.
class ReverseTransform {
 public:
  /// Position and outcome.
  using Point = GeodeticPoint;

  /// @throws std::invalid_argument if this processor does not have @p set, or as the constructor of
  /// ClosestPoint
  explicit ReverseTransform(const Ellipsoid& ellipsoid, InstructionSet set = best_instruction_set());

  /// One point. Outcome::non_finite and NaNs if a coordinate is NaN or infinite.
  [[nodiscard]] Point operator()(const Cartesian& point) const noexcept {
    const kernels::Position p = one_(constants_, point.x, point.y, point.z);
    if (p.valid) [[likely]]
      return {{p.latitude, p.longitude, p.height}, Outcome::success};
    return exact_(point);
  }

  /// Many points, one array per coordinate; metres and radians. An output may be the same array as an input;
  /// otherwise arrays must not overlap. Allocates nothing. A point without a finite result gets the result of
  /// the one-point form and is counted.
  /// @throws std::invalid_argument with the sizes, if they are not all equal
  BatchReport operator()(std::span<const double> x, std::span<const double> y, std::span<const double> z,
                         std::span<double> latitude, std::span<double> longitude,
                         std::span<double> height) const;

  /// Instruction set of the kernels.
  [[nodiscard]] InstructionSet instruction_set() const noexcept { return set_; }
  /// Newton corrections after the polynomial (0, 1, 2), or -1 if every point is computed by ClosestPoint.
  [[nodiscard]] int corrections() const noexcept { return corrections_; }

 private:
  ClosestPoint exact_;
  InstructionSet set_;
  int corrections_ = -1;
  kernels::Constants constants_;
  kernels::OnePoint one_ = nullptr;
  kernels::ManyPoints many_ = nullptr;
};

}  // namespace nlmech::geodesy

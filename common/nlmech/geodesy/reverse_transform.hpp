/// @file
/// Cartesian to geodetic coordinates, one by one or in batches, at full double precision.
#pragma once

#include <cstddef>
#include <span>

#include "nlmech/geodesy/closest_point.hpp"
#include "nlmech/geodesy/ellipsoid.hpp"
#include "nlmech/geodesy/kernels/kernel.hpp"
#include "nlmech/support/instruction_set.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::geodesy {

/// Outcome of a batch: how many points took the slower path, and how many have no finite result.
struct BatchReport {
  std::size_t points = 0;            ///< size of the batch
  std::size_t fallbacks = 0;         ///< points done by ClosestPoint, non-finite ones among them
  std::size_t non_finite = 0;        ///< points whose result is not finite
  std::size_t first_non_finite = 0;  ///< index of the first of them, if there is one

  /// Success, or Outcome::non_finite with a sentence that counts the points and names the first.
  [[nodiscard]] Status status() const;
};

/// Reverse geodetic transformation: x, y, z to latitude, longitude, height.
///
/// Method: the perturbation solution for tan(phi - phi_0), phi_0 the geocentric latitude (Elgohary 2015,
/// Sec. 2.4), in the economised form of TangentFit, without iteration and without a trigonometric function
/// but the two arctangents. For flattenings up to about 1/287 (all ellipsoids in use for the Earth) the
/// polynomial alone is exact to rounding; up to about 1/7 one or two Newton corrections follow. Points below
/// the range of the polynomial (R < 0.9975 min(a, b), for the Earth h < -15.9 km at the poles), points
/// farther than 1e150 m and all points of flatter ellipsoids go to ClosestPoint, so that every finite point
/// has its full-accuracy result. Its conventions for signs of zeros, the axis and the disc around the centre
/// are those of this class.
///
/// Accuracy for an ellipsoid of the Earth's size and flattening, the coordinates taken as exact, heights from
/// -10 km to 35000 km: latitude and longitude 4e-16 rad, the sum of all roundings at their worst (the
/// greatest errors among 1e6 random points are 2.5e-16 and 3.2e-16); height 2.5e-9 m below 100 km and 2.2e-8
/// m up to 35000 km, where the spacing of doubles is 7e-9 m. Beyond, the height has a relative error of
/// 6e-16. Latitudes never exceed pi/2 in double precision; they are exact at the poles and on the equator.
///
/// Results do not depend on the size of a batch, on a point's place in it, or on whether the point is done
/// alone. AVX2 and AVX-512 give the same bits; the baseline, which has no fused multiply-add, may differ in
/// the last digits. All members are safe to call from several threads at once.
class ReverseTransform {
 public:
  /// Position and outcome.
  using Point = GeodeticPoint;

  /// @throws std::invalid_argument if this processor does not have @p set, or as ClosestPoint does
  explicit ReverseTransform(const Ellipsoid& ellipsoid, InstructionSet set = best_instruction_set());

  /// One point. Outcome::non_finite and NaNs if a coordinate is NaN or infinite.
  [[nodiscard]] Point operator()(const Cartesian& point) const noexcept {
    const kernels::Position p = one_(constants_, point.x, point.y, point.z);
    if (p.valid) [[likely]]
      return {{p.latitude, p.longitude, p.height}, Outcome::success};
    return exact_(point);
  }

  /// Many points, coordinate by coordinate; metres and radians. An output may be one of the inputs (the whole
  /// of it); otherwise the arrays must not overlap. Allocates nothing. A point without a finite result gets
  /// what the one-point form returns for it and is counted.
  /// @throws std::invalid_argument naming the sizes, if they are not all equal
  BatchReport operator()(std::span<const double> x, std::span<const double> y, std::span<const double> z,
                         std::span<double> latitude, std::span<double> longitude,
                         std::span<double> height) const;

  /// The set that the kernels use.
  [[nodiscard]] InstructionSet instruction_set() const noexcept { return set_; }
  /// Newton corrections after the polynomial (0, 1, 2), or -1 if every point goes to ClosestPoint.
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

/// @file
/// Rows of an orbit: printed states, and their accuracy from rounding of the data and errors of the steps.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::chapters::two_body_series {

/// Status of a row whose position or velocity has less than six digits.
inline constexpr std::string_view low_accuracy = "low_accuracy";

/// Method by which a state was computed.
struct ComputedBy {
  std::string_view method;          ///< "series", "rkn1210" or "kepler"
  std::optional<double> tolerance;  ///< tolerance of a step; nothing for kepler
};

/// Method with the tolerance @p tolerance if it has one.
[[nodiscard]] inline ComputedBy computed_by(std::string_view method, double tolerance) {
  return {method, method == "kepler" ? std::nullopt : std::optional(tolerance)};
}

/// Accuracy of one state.
struct Accuracy {
  /// Uncertainty of the position relative to the distance or of the velocity relative to the speed, the
  /// greater, if at least 1e-6; else 0.
  double off = 0;
  std::string sentence;  ///< message for standard error; empty if `off` is 0
  /// A failure if no digit is left (error of an eighth of the distance or speed), because of the condition of
  /// Kepler's problem or of the errors of the method.
  Status status;
};

/// Estimates the accuracy of @p state, computed at @p time from @p start. About a point mass the state is
/// compared with Kepler's solution, which is exact to rounding of the data and takes a microsecond. With
/// zonal terms only the effect of rounding of the data in the field of the point mass is estimated, and the
/// status is success.
[[nodiscard]] Accuracy accuracy_of(const orbit::State& state, const orbit::State& start, double time,
                                   const orbit::Gravity& gravity, const ComputedBy& by);

/// Status and worst accuracy of the rows of an orbit.
struct OrbitAccuracy {
  Status status;   ///< success, or the first failure
  Accuracy worst;  ///< of the row with the largest uncertainty

  /// Takes in the accuracy of a row. @returns the status of that row as text, or low_accuracy
  std::string_view add(Accuracy row);
};

/// Appends t,x,y,z,vx,vy,vz with 17 digits.
void append_state(std::string& text, double t, const orbit::State& state);

/// Error message if the whole orbit from @p start, in metres with the Earth's mu, lies deep inside the Earth
/// (wrong units); otherwise empty.
[[nodiscard]] std::string inside_the_earth(const orbit::State& start);

}  // namespace nlmech::chapters::two_body_series

/// @file
/// How exact a printed position is: what rounding of the data leaves of it, and what the steps leave of it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::chapters::two_body_series {

/// The status of a row with a position of less than six digits.
inline constexpr std::string_view low_accuracy = "low_accuracy";

/// How a state was computed.
struct ComputedBy {
  std::string_view method;          ///< "series", "rkn1210" or "kepler"
  std::optional<double> tolerance;  ///< of a step; nothing for kepler
};

/// What is known of one position.
struct Accuracy {
  double off = 0;        ///< its uncertainty as a share of the distance, where that is 1e-6 or more; else 0
  std::string sentence;  ///< about it, for standard error; empty if `off` is 0
  /// A failure if not one digit is left (an eighth of the distance): of the data, by the condition of
  /// Kepler's problem, or of the method.
  Status status;
};

/// The accuracy of @p state, found at @p time from @p start. About a point mass it is compared with Kepler's
/// solution, which is exact to rounding of the data and costs a microsecond. With zonal terms only what
/// rounding of the data does in the field of the point mass is looked at, and nothing is refused.
[[nodiscard]] Accuracy accuracy_of(const orbit::State& state, const orbit::State& start, double time,
                                   const orbit::Gravity& gravity, const ComputedBy& by);

/// Why @p start and mu in metres cannot be meant: the whole orbit lies deep inside the Earth. Empty if they
/// can.
[[nodiscard]] std::string inside_the_earth(const orbit::State& start);

}  // namespace nlmech::chapters::two_body_series

/// @file
/// An orbit of the user's own as rows of CSV.
#pragma once

#include <optional>
#include <string>

#include "nlmech/orbit/gravity.hpp"

namespace nlmech::chapters::two_body_series {

/// What a user asks for.
struct OrbitRequest {
  orbit::State start;           ///< at t = 0
  double time = 0;              ///< end, of either sign
  std::optional<double> every;  ///< distance of the rows in time, positive; nothing: first and last alone
  orbit::Gravity gravity;       ///< of the centre
  double tolerance = 1e-15;     ///< of a step; not for Kepler's solution
  double seconds = 60;          ///< wall time, at most
};

/// Rows `t,x,y,z,vx,vy,vz`: the first at 0, those at multiples of `every`, the last at the asked time
/// exactly; a single one if that is 0. Numbers with 17 digits. By Kepler's problem, solved anew for every
/// row. What is known of the accuracy of the rows goes to standard error where it is less than six digits.
/// @throws Failure with the method's own sentence, and if a row has not one digit; so for the following two
[[nodiscard]] std::string rows_of_kepler(const OrbitRequest& request);
/// The same by analytic continuation; rows between by its series.
[[nodiscard]] std::string rows_of_series(const OrbitRequest& request);
/// The same by RKN12(10), with the tolerance relative and, in units of the initial distance and its circular
/// speed, absolute; rows between by its dense output.
[[nodiscard]] std::string rows_of_rkn1210(const OrbitRequest& request);

}  // namespace nlmech::chapters::two_body_series

/// @file
/// Transition matrices and covariances beside the rows of `propagate`.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "chapters/two_body_series/series/trajectory.hpp"
#include "nlmech/orbit/transition.hpp"

namespace nlmech::chapters::two_body_series {

/// Square root of the covariance in a CSV file: six rows of six numbers, in the order x,y,z,vx,vy,vz, with or
/// without these names as a header. @throws InputError naming file, line, column and value
[[nodiscard]] Matrix<double, 6> read_covariance(const std::string& file);

/// Propagates by @p method ("series", "rkn1210" or "kepler") with the transition matrix; a point mass for
/// kepler, which leaves the matrix out if no column of @p request needs it.
/// @param times of rows between 0 and the final time, for @p sink, which may end the run
/// @throws Failure as rkn1210_units()
[[nodiscard]] orbit::TransitionSolution propagate_with_transition(const OrbitRequest& request,
                                                                  std::string_view method,
                                                                  std::span<const double> times,
                                                                  const orbit::TransitionSink& sink);

}  // namespace nlmech::chapters::two_body_series

/// @file
/// Transition matrices and covariances beside the rows of `propagate`.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chapters/two_body_series/series/trajectory.hpp"
#include "nlmech/orbit/transition.hpp"

namespace nlmech::chapters::two_body_series {

/// Further columns of rows.
struct Sensitivities {
  bool transition = false;                        ///< phi_11,phi_12,...,phi_66, row by row
  std::optional<Matrix<double, 6>> initial_root;  ///< of the initial covariance: p_11,p_12,...,p_66 too

  /// Is there a column?
  [[nodiscard]] bool any() const { return transition || initial_root; }
  /// Names of the columns, each after a comma.
  [[nodiscard]] std::string names() const;
  /// Cells of a row, each after a comma.
  [[nodiscard]] std::string cells(const orbit::TransitionMatrix& phi) const;
};

/// Square root of the covariance in a CSV file: six rows of six numbers, in the order x,y,z,vx,vy,vz, with or
/// without these names as a header. @throws InputError naming file, line, column and value
[[nodiscard]] Matrix<double, 6> read_covariance(const std::string& file);

/// Propagates by @p method ("series", "rkn1210" or "kepler") with the transition matrix; a point mass for
/// kepler. @p request gives start, time, gravity, tolerance and seconds.
/// @param times of rows between 0 and the final time, for @p sink, which may end the run
[[nodiscard]] orbit::TransitionSolution propagate_with_transition(const OrbitRequest& request,
                                                                  std::string_view method,
                                                                  std::span<const double> times,
                                                                  const orbit::TransitionSink& sink);

/// Times of rows between 0 and the final time @p until.
[[nodiscard]] std::vector<double> inner_times(double until, const std::optional<double>& every);

/// Rows `t,x,y,z,vx,vy,vz,...` of one orbit with the columns @p columns; messages and failures as of
/// rows_of_kepler().
[[nodiscard]] std::string rows_with(const Sensitivities& columns, const OrbitRequest& request,
                                    std::string_view method);

}  // namespace nlmech::chapters::two_body_series

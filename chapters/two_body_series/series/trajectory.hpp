/// @file
/// Propagation of one orbit to CSV rows, for the command `propagate`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/orbit/events.hpp"
#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::two_body_series {

/// An event of `--events`.
struct NamedEvent {
  std::string name;    ///< as typed: "nodes", "altitude=400e3"
  orbit::Event event;  ///< what it is
};

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

/// Input of a propagation.
struct OrbitRequest {
  orbit::State start;           ///< state at t = 0
  double time = 0;              ///< final time, of either sign
  std::optional<double> every;  ///< time between rows, positive; nothing: first and last row only
  /// Times of the rows in place of `every`, first and last row: of one sign, in order of |t|, each once; the
  /// last one is `time`.
  std::vector<double> at = {};
  std::vector<NamedEvent> events = {};  ///< events with a row, and a column `event` for their names
  orbit::Gravity gravity;               ///< gravity field of the centre
  double tolerance = 1e-15;             ///< tolerance of a step; not used by Kepler's solution
  double seconds = 60;                  ///< limit of wall time, s
  Sensitivities columns = {};           ///< further columns, in place of events
  Stopwatch watch = {};                 ///< measures the wall time

  /// Are there rows besides the first and the last one?
  [[nodiscard]] bool has_inner_rows() const { return every || at.size() > 1 || !events.empty(); }
  /// Times of rows between 0 and the final time, without those of events.
  [[nodiscard]] std::vector<double> inner_times() const;
};

/// Units near the initial distance and its circular speed, in which RKN12(10) integrates.
/// @throws Failure if they are beyond the range of doubles
[[nodiscard]] orbit::detail::PowerUnits rkn1210_units(const OrbitRequest& request);

/// Propagates by Kepler's solution, computed from the start for every row. Returns rows `t,x,y,z,vx,vy,vz`
/// with 17 digits: at 0, at multiples of `every` or times of `at`, at events, and exactly at the final time;
/// one row if that is 0. Prints the accuracy to standard error if a row has less than six digits, and the
/// times between which events are undetermined.
/// @throws Failure with the message of the method, and if a row has not one digit (also the following three)
[[nodiscard]] std::string rows_of_kepler(const OrbitRequest& request);
/// Propagates by analytic continuation; inner rows by the series of the step.
[[nodiscard]] std::string rows_of_series(const OrbitRequest& request);
/// Propagates by RKN12(10); inner rows by dense output, a shorter step. The tolerance is relative, and
/// absolute in units near the initial distance and its circular speed.
[[nodiscard]] std::string rows_of_rkn1210(const OrbitRequest& request);
/// Propagates by @p method ("series", "rkn1210" or "kepler") with the further columns of @p request.
[[nodiscard]] std::string rows_with_columns(const OrbitRequest& request, std::string_view method);

}  // namespace nlmech::chapters::two_body_series

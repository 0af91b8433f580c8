/// @file
/// Propagation and elements of all orbits of a catalogue, CSV to CSV.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "chapters/two_body_series/stm/sensitivities.hpp"
#include "nlmech/orbit/gravity.hpp"

namespace nlmech::chapters::two_body_series {

/// Input of the propagation of a catalogue.
struct CatalogueRequest {
  std::string file;               ///< CSV with columns x,y,z,vx,vy,vz; optional mu, until
  std::optional<double> until;    ///< final time, if there is no column until
  std::optional<double> mu;       ///< mu of the centre, if there is no column mu; nothing: the Earth's
  std::optional<double> every;    ///< time between rows, positive; nothing: final row only
  orbit::Gravity field;           ///< radius and zonal terms of the centre; its mu is not used
  std::string method = "series";  ///< series or kepler
  double tolerance = 1e-15;       ///< tolerance of a step of series
  int threads = 0;                ///< number of threads; 0: one per processor
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time, s; then orbits stop
  Sensitivities columns = {};                                ///< further columns of each row
};

/// Prints rows `row,t,x,y,z,vx,vy,vz,...,status` in the order of the file; `...` are further columns and
/// those of the file that are passed through. The row of a failed orbit has the time reached. A row of less
/// than six digits has the status low_accuracy (see accuracy_of()), with a message on standard error.
/// @returns exit code: 1, with a message on standard error, if an orbit failed
/// @throws InputError naming line and value, if the file is not valid
[[nodiscard]] int print_orbits(const CatalogueRequest& request);

/// Names of the elements that are printed.
inline constexpr std::string_view element_columns =
    "a,e,i,raan,argp,nu,period,p,q,eccentric_anomaly,mean_anomaly,time_since_periapsis";

/// The elements of @p state as cells in the order of element_columns, angles in degrees, with 17 digits.
/// @throws std::invalid_argument as orbit::elements_of(), and for a period beyond the range of doubles
[[nodiscard]] std::string element_cells(const orbit::State& state, double mu);

/// Prints rows `row,a,...,status` with the elements of the states of a file in its order; `...` are the other
/// elements and the other columns of the file. A state without elements has empty cells and the status
/// outside_validity.
/// @param file CSV with columns x,y,z,vx,vy,vz; optional mu
/// @param mu of the centre, if there is no column mu; nothing: the Earth's
/// @returns exit code: 1, with a message on standard error, if a state has no elements
/// @throws InputError naming line and value, if the file is not valid
[[nodiscard]] int print_elements(const std::string& file, const std::optional<double>& mu);

}  // namespace nlmech::chapters::two_body_series

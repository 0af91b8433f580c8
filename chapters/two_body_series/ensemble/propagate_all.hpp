/// @file
/// Orbits of a catalogue, propagated all: CSV to CSV.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "nlmech/orbit/gravity.hpp"

namespace nlmech::chapters::two_body_series {

/// What a user asks for.
struct CatalogueRequest {
  std::string file;               ///< CSV with columns x,y,z,vx,vy,vz, and mu and until if they differ
  std::optional<double> until;    ///< end of the orbits, if there is no such column
  std::optional<double> mu;       ///< of the centre, if there is no such column; nothing: the Earth's
  std::optional<double> every;    ///< distance of rows in time, positive; nothing: a row an orbit, its end
  orbit::Gravity field;           ///< radius and zonal terms of the centre; mu is of no meaning
  std::string method = "series";  ///< or kepler
  double tolerance = 1e-15;       ///< of a step, for series
  int threads = 0;                ///< 0: one a processor
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time; then orbits end as they are
};

/// Prints rows `row,t,x,y,z,vx,vy,vz,...,status` in the order of the file, `...` its other columns. A row of
/// an orbit that failed has the time that it reached; one of less than six digits the status low_accuracy
/// (see accuracy_of()), with a word on standard error.
/// @returns the exit code: 1, with a word on standard error, if an orbit failed
/// @throws InputError for whatever is wrong with the file, with line and value
[[nodiscard]] int print_orbits(const CatalogueRequest& request);

}  // namespace nlmech::chapters::two_body_series

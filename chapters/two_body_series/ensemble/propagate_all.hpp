/// @file
/// Propagation of all orbits of a catalogue, CSV to CSV.
#pragma once

#include <limits>
#include <optional>
#include <string>

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

}  // namespace nlmech::chapters::two_body_series

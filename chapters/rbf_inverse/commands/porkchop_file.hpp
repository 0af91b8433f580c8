/// @file
/// Files of `rbf_inverse porkchop`: two orbits as TOML, grids as CSV.
#pragma once

#include <string>

#include "nlmech/orbit/transfer/porkchop.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Reads a problem from TOML: `mu`; tables `from` and `to`, each an orbit as elements (a or p, e, and in
/// degrees i, raan, argp, nu) or as a state (position, velocity), with `epoch`; tables `departures` and
/// `arrivals` with `first` and `last`; and optionally `revolutions`. The counts of the windows are not set.
/// Every value is checked against its range (see porkchop_keys()).
/// @param name name of the text in messages
/// @throws InputError naming text, line and the invalid value
[[nodiscard]] orbit::PorkchopProblem read_porkchop(const std::string& text, const std::string& name);

/// Keys of the file with their ranges, for `--help`.
[[nodiscard]] std::string porkchop_keys();

/// Grid as CSV with the columns departure,arrival,v_departure,v_arrival,revolutions and a row for each pair
/// of times with a transfer.
[[nodiscard]] std::string porkchop_csv(const orbit::Porkchop& grid);

}  // namespace nlmech::chapters::rbf_inverse

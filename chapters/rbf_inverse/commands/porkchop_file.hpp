/// @file
/// Files of `rbf_inverse porkchop`: two orbits as TOML, grids as CSV.
#pragma once

#include <string>

#include "nlmech/orbit/transfer/porkchop.hpp"

namespace nlmech::chapters::rbf_inverse {

/// The problem in a TOML text: `mu`; tables `from` and `to`, each an orbit as elements (a or p, e, and in
/// degrees i, raan, argp, nu) or as a state (position, velocity), with `epoch`; tables `departures` and
/// `arrivals` with `first` and `last`; and `revolutions`, if there may be some. The counts of the windows are
/// left as they are. Every value is checked against its range (see porkchop_keys()). @param name what
/// complaints call the text
/// @throws InputError naming the text, line and value of what cannot be meant
[[nodiscard]] orbit::PorkchopProblem read_porkchop(const std::string& text, const std::string& name);

/// The keys of such a file with their ranges, for `--help`.
[[nodiscard]] std::string porkchop_keys();

/// departure,arrival,v_departure,v_arrival,revolutions: a row for each pair of times with a transfer.
[[nodiscard]] std::string porkchop_csv(const orbit::Porkchop& grid);

}  // namespace nlmech::chapters::rbf_inverse

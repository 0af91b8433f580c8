/// @file
/// Files of `rbf_inverse porkchop`: two orbits as TOML, grids as CSV, shards put together.
#pragma once

#include <string>
#include <vector>

#include "nlmech/orbit/porkchop.hpp"

namespace nlmech::chapters {

/// The problem in a TOML text: `mu`; tables `from` and `to`, each an orbit as elements (a or p, e, and in
/// degrees i, raan, argp, nu) or as a state (position, velocity), with `epoch`; tables `departures` and
/// `arrivals` with `first` and `last`; and `revolutions`, if there may be some. The counts of the windows are
/// left as they are. @param name what complaints call the text
/// @throws InputError naming the text, line and value of what cannot be meant
[[nodiscard]] orbit::PorkchopProblem read_porkchop(const std::string& text, const std::string& name);

/// departure,arrival,v_departure,v_arrival,revolutions: a row for each pair of times with a transfer.
[[nodiscard]] std::string porkchop_csv(const orbit::Porkchop& grid);

/// A shard as read back.
struct PorkchopPart {
  std::string text;  ///< the file's
  std::string name;  ///< the file's, for complaints
};

/// The rows of all parts by departure, then arrival: what one run without shards writes.
/// @throws InputError naming file and line for what is no number, or a pair of times that was there before
[[nodiscard]] std::string merged(const std::vector<PorkchopPart>& parts);

}  // namespace nlmech::chapters

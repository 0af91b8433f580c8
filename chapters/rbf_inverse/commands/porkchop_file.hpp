/// @file
/// Files of `rbf_inverse porkchop`: two orbits as TOML, grids as CSV, shards put together.
#pragma once

#include <string>
#include <vector>

#include "nlmech/orbit/transfer/porkchop.hpp"

namespace nlmech::chapters::rbf_inverse {

/// The problem in a TOML text: `mu`; tables `from` and `to`, each an orbit as elements (a or p, e, and in
/// degrees i, raan, argp, nu) or as a state (position, velocity), with `epoch`; tables `departures` and
/// `arrivals` with `first` and `last`; and `revolutions`, if there may be some. The counts of the windows are
/// left as they are. Every value is held to its range (see porkchop_keys()). @param name what complaints call
/// the text
/// @throws InputError naming the text, line and value of what cannot be meant
[[nodiscard]] orbit::PorkchopProblem read_porkchop(const std::string& text, const std::string& name);

/// The keys of such a file with their ranges, for `--help`.
[[nodiscard]] std::string porkchop_keys();

/// departure,arrival,v_departure,v_arrival,revolutions: a row for each pair of times with a transfer.
[[nodiscard]] std::string porkchop_csv(const orbit::Porkchop& grid);

/// The same of a part, and before it a line that says which: "# shard 2 / 4 grid 200 x 300 rows 17123 problem
/// 9f86d081884c7d65", the last a number that depends on everything in @p problem.
[[nodiscard]] std::string porkchop_part_csv(const orbit::PorkchopProblem& problem,
                                            const orbit::PorkchopWork& work, const orbit::Porkchop& grid);

/// A part as read back.
struct PorkchopPart {
  std::string text;  ///< the file's
  std::string name;  ///< the file's, for complaints
};

/// All parts of one grid, given in any order, joined: the bytes that one run without shards writes.
/// @throws InputError naming the file, and line and value where there is one, for what is no part or of
/// another grid, a part that was there before, one that is not whole, parts that are missing
[[nodiscard]] std::string merged(const std::vector<PorkchopPart>& parts);

}  // namespace nlmech::chapters::rbf_inverse

/// @file
/// Claims about speed: each a ratio of medians measured in one process, with its spread, and whether it is
/// held.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nlmech::scene {

/// Repeated timings of one piece of work.
struct BenchSeries {
  std::string name;                ///< "fast, batch avx512 / 4096"
  std::string unit;                ///< "ns a point"
  std::vector<double> repetition;  ///< in the order in which they were taken
};

/// "Ours takes at most 1/least of the time of theirs."
struct SpeedClaim {
  std::string text;    ///< the claim in words
  std::string ours;    ///< name of a series
  std::string theirs;  ///< name of a series
  double least = 1;    ///< promised ratio of their median to ours
};

/// What was measured for a claim.
struct SpeedResult {
  SpeedClaim claim;   ///< as promised
  double ratio = 0;   ///< of medians
  double low = 0;     ///< smallest ratio of two repetitions of the same number
  double high = 0;    ///< largest
  bool held = false;  ///< is the ratio of medians at least the promised one?
};

/// Compares the two series of a claim. @throws std::invalid_argument naming a series that is missing or empty
[[nodiscard]] SpeedResult judge_claim(const SpeedClaim& claim, const std::vector<BenchSeries>& series);

/// Writes `results/bench/<name>.json` with machine, build, all series and claims; `make bench` makes
/// `tables/BENCH.md` of the files of that folder. @throws Failure if the file cannot be written
void write_bench(const std::string& name, const std::vector<BenchSeries>& series,
                 const std::vector<SpeedResult>& results, const std::filesystem::path& out);

}  // namespace nlmech::scene

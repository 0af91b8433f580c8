/// @file
/// Claims about speed as ratios of medians measured in one process, and comparison of printed ratios of run
/// times with reproduced ones. Absolute times of an unknown machine cannot be compared, but ratios can.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"

namespace nlmech::scene {

/// Repeated timings of one piece of work.
struct BenchSeries {
  std::string name;                ///< "fast, batch avx512 / 4096"
  std::string unit;                ///< "ns a point"
  std::vector<double> repetition;  ///< times in the order of measurement
};

/// Claim that a method takes at most 1/least of the time of a peer.
struct SpeedClaim {
  std::string text;    ///< the claim in words
  std::string method;  ///< name of its series
  std::string peer;    ///< name of its series
  double least = 1;    ///< promised ratio of the medians: of the peer to that of the method
};

/// Measured ratios of a claim.
struct SpeedResult {
  SpeedClaim claim;   ///< the claim
  double ratio = 0;   ///< ratio of medians
  double low = 0;     ///< smallest ratio of two repetitions with the same index
  double high = 0;    ///< largest ratio of two repetitions with the same index
  bool held = false;  ///< is the ratio of medians at least the promised one?
};

/// Compares the two series of a claim. @throws std::invalid_argument naming a series that is missing or empty
[[nodiscard]] SpeedResult check_claim(const SpeedClaim& claim, const std::vector<BenchSeries>& series);

/// Writes `results/bench/<name>.json` with machine, build, all series and claims; `make bench` makes
/// `tables/BENCH.md` from the files of that folder. @throws Failure if the file cannot be written
void write_bench(const std::string& name, const std::vector<BenchSeries>& series,
                 const std::vector<SpeedResult>& results, const std::filesystem::path& out);

/// Permitted factor between a ratio and the printed one, in both directions.
///
/// Ratios of compiled programs varied by up to a half between the machines that we tried, and seconds printed
/// with one or two digits add a tenth or two: 3 covers both. A larger factor reflects two programs rather
/// than two methods, and MATLAB's interpreter, in which a step costs the same whatever it computes.
inline constexpr double allowed_factor = 3;

/// A measured number and its spread.
struct Spread {
  double middle = 0;  ///< median
  double low = 0;     ///< lower quartile
  double high = 0;    ///< upper quartile
};

/// Median and quartiles. @throws std::invalid_argument if there is no value
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// Ratio of two spreads. Each upper quartile is divided by the other's lower one, because the repetitions of
/// two series are not paired.
[[nodiscard]] Spread ratio_of(const Spread& over, const Spread& under);

/// A printed ratio of times and the reproduced one.
struct RatioVerdict {
  double printed = 0;        ///< printed ratio: time of the method over that of the reference
  Spread reproduced;         ///< reproduced ratio
  double apart = 0;          ///< the larger over the smaller of the two ratios
  bool same_faster = false;  ///< is the same method faster in print and here?
  bool holds = false;        ///< same_faster, and apart at most allowed_factor
  /// Is the reference, the source's own method, faster in print but not here?
  [[nodiscard]] bool lost() const { return printed > 1 && !same_faster; }
};

/// Compares the medians. @throws std::invalid_argument if a ratio is not positive and finite
[[nodiscard]] RatioVerdict compare_ratio(double printed, const Spread& reproduced);

/// A row of a table of seconds: ratio of its time to that of its reference.
struct TimeRatio {
  std::string place;           ///< "table-4.2"
  std::string row;             ///< row in the source's words: "Newmark-2 (P/500)"
  std::string reference;       ///< row of the reference method
  double printed_seconds = 0;  ///< printed time of the row, s
  double seconds = 0;          ///< median of the measured times
  RatioVerdict verdict;        ///< verdict on the ratio
  /// Is it the reference itself, whose ratio is 1?
  [[nodiscard]] bool is_reference() const { return row == reference; }
};

/// A ratio stated in the source's text: a mean over rows.
struct RatioClaim {
  std::string place;              ///< "claim-3.2.2"
  std::string row;                ///< "LEO"
  std::string quantity;           ///< "Analytic-Cont faster than RKN12(10) by"
  std::vector<std::string> over;  ///< rows of the mean
  RatioVerdict verdict;           ///< verdict on the mean
};

/// All ratios of one program.
struct TimeRatios {
  std::vector<TimeRatio> rows;     ///< rows of all tables
  std::vector<RatioClaim> claims;  ///< claims in prose
};

/// The printed seconds of a table in the order of its rows.
/// @throws std::invalid_argument if there are none, or one is not in seconds
[[nodiscard]] std::vector<PublishedValue> printed_seconds(const std::vector<PublishedValue>& published,
                                                          const std::string& place);

/// Ratios of all rows of a printed table.
/// @param reference_of reference of each row; a reference row refers to itself
/// @param series measured times in "us a run", with the names "<place>, <row>"
/// @throws std::invalid_argument naming a printed row that has no reference or was not measured
[[nodiscard]] std::vector<TimeRatio> compare_times(const std::vector<PublishedValue>& published,
                                                   const std::string& place,
                                                   const std::map<std::string, std::string>& reference_of,
                                                   const std::vector<BenchSeries>& series);

/// A claim in prose as the mean of the ratios of some rows. @param claim the published ratio
/// @throws std::invalid_argument if one of the rows is missing
[[nodiscard]] RatioClaim mean_claim(const PublishedValue& claim, const std::string& place,
                                    const std::vector<std::string>& over, const std::vector<TimeRatio>& rows);

/// Writes `results/ratios/<name>.json`; `make bench` makes `tables/RATIOS.md` and, for numbers on pages,
/// `tables/ratios.json` from the files of that folder. @throws Failure if the file cannot be written
void write_ratios(const std::string& name, const TimeRatios& ratios, const std::filesystem::path& out);

}  // namespace nlmech::scene

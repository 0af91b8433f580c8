/// @file
/// Claims about speed, each a ratio of medians measured in one process; and printed ratios of run times
/// beside ours. Seconds of an unknown machine cannot be compared; which of two methods was faster there, and
/// by how much, can be.
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

/// How far a ratio may be from the printed one, either way.
///
/// Ratios of compiled programs moved by up to a half between the machines that we tried, and seconds that are
/// printed with one or two digits leave a tenth or two more: 3 is ample room for both. What is further off
/// says more of two programs, and of MATLAB's interpreter, in which a step costs the same whatever it
/// computes, than of two methods.
inline constexpr double allowed_factor = 3;

/// A measured number and its spread.
struct Spread {
  double middle = 0;  ///< median
  double low = 0;     ///< lower quartile
  double high = 0;    ///< upper quartile
};

/// Median and quartiles. @throws std::invalid_argument if there is no value
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// Over another, each upper quartile with the other's lower one: the repetitions of two series are no pairs.
[[nodiscard]] Spread ratio_of(const Spread& over, const Spread& under);

/// A printed ratio and ours.
struct RatioVerdict {
  double printed = 0;        ///< how many times faster the reference was, in print
  Spread ours;               ///< the same here
  double apart = 0;          ///< the larger over the smaller of the two ratios
  bool same_faster = false;  ///< is the same of the two the faster one?
  bool holds = false;        ///< that, and not further apart than allowed_factor
  /// Is the reference, the source's own method, the faster one in print alone?
  [[nodiscard]] bool lost() const { return printed > 1 && !same_faster; }
};

/// Judges by the medians. @throws std::invalid_argument if a ratio is not positive and finite
[[nodiscard]] RatioVerdict judge_ratio(double printed, const Spread& ours);

/// A row of a table of seconds: how many times longer its method takes than the reference of the table.
struct TimeRatio {
  std::string place;           ///< "table-4.2"
  std::string row;             ///< in the source's words: "Newmark-2 (P/500)"
  std::string reference;       ///< the row whose method all are compared with
  double printed_seconds = 0;  ///< of the row
  double seconds = 0;          ///< median of ours
  RatioVerdict verdict;        ///< on the ratio
  /// Is it the reference itself, whose ratio is 1?
  [[nodiscard]] bool is_reference() const { return row == reference; }
};

/// A ratio that the source's text names: a mean over rows.
struct RatioClaim {
  std::string place;              ///< "claim-3.2.2"
  std::string row;                ///< "LEO"
  std::string quantity;           ///< "Analytic-Cont faster than RKN12(10) by"
  std::vector<std::string> over;  ///< rows whose mean it is
  RatioVerdict verdict;           ///< on the mean
};

/// All of one program.
struct TimeRatios {
  std::vector<TimeRatio> rows;     ///< of all tables
  std::vector<RatioClaim> claims;  ///< in prose
};

/// The printed seconds of a table, row by row in its order.
/// @throws std::invalid_argument if there are none, or one is not in seconds
[[nodiscard]] std::vector<PublishedValue> printed_seconds(const std::vector<PublishedValue>& published,
                                                          const std::string& place);

/// Each row of a printed table against its reference.
/// @param reference_of reference of each row; a reference is its own
/// @param series ours, in "us a run", by the name "<place>, <row>"
/// @throws std::invalid_argument naming a printed row that has no reference or was not measured
[[nodiscard]] std::vector<TimeRatio> compare_times(const std::vector<PublishedValue>& published,
                                                   const std::string& place,
                                                   const std::map<std::string, std::string>& reference_of,
                                                   const std::vector<BenchSeries>& series);

/// A claim in prose as the mean of the ratios of some rows. @param claim the published ratio
/// @throws std::invalid_argument if one of the rows is not there
[[nodiscard]] RatioClaim mean_claim(const PublishedValue& claim, const std::string& place,
                                    const std::vector<std::string>& over, const std::vector<TimeRatio>& rows);

/// Writes `results/ratios/<name>.json`; `make bench` makes `tables/RATIOS.md` and, for numbers on pages,
/// `tables/ratios.json` of the files of that folder. @throws Failure if the file cannot be written
void write_ratios(const std::string& name, const TimeRatios& ratios, const std::filesystem::path& out);

}  // namespace nlmech::scene

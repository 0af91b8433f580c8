/// @file
/// Work-precision diagrams: digits of many methods against what they cost, as a figure and a table. A few
/// curves are in colour and named at their ends, all others grey behind them; below stands who is fastest.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/scene/cost/lines.hpp"
#include "nlmech/scene/show.hpp"
#include "nlmech/support/status.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::scene {

/// The diagram. One problem has a panel over time and, if there is further work, one over its first column;
/// several problems have a panel each, over time. What is in colour, and who is fastest, follows from the
/// data: foreground(), rankings_of().
struct WorkPrecision {
  std::string heading = {};                                        ///< what to see
  std::string digits = "digits: -log_{10} of the relative error";  ///< label of the ordinate
  double least_digits = 0;                                         ///< low end of the ordinate
  double most_digits = 15;                                         ///< high end of the ordinate
  std::string error = {};                                          ///< heading of a column; empty: digits
  std::string time = "median run time (s)";                        ///< label of the abscissa
  std::string unit = "ms";                                         ///< of time in the table: ms, µs or ns
  std::vector<std::string> work = {};                              ///< further columns of the table
  std::string work_label = {};                                     ///< abscissa of the second panel
  std::vector<MethodGroup> groups = {};                            ///< kinds, foremost first
  double rounding = 0;                                            ///< the worst that one rounding of the data
                                                                  ///< makes of the end; 0: not known
  std::optional<std::pair<double, std::string>> least_time = {};  ///< s, and what takes it
};

/// Puts figure and table on @p show.
void show_work_precision(const WorkPrecision& what, const std::vector<ProblemLines>& problems, Show& show);

/// How a computation ended, and its error if it has one.
struct Ending {
  Status status;                ///< of the method
  std::optional<double> error;  ///< nothing if it failed
};

/// One setting, computed and timed. @param judge how what @p compute gives ended; not timed
template <class Compute, class Judge>
[[nodiscard]] Attempt attempt(std::string setting, const Compute& compute, const Judge& judge, bool quick) {
  const Stopwatch watch;
  const auto result = compute();
  const double first = watch.seconds();
  const Ending ending = judge(result);
  return {std::move(setting), std::string(to_string(ending.status.outcome())), ending.error,
          repeated_timing([&] { static_cast<void>(compute()); }, first, quick)};
}

}  // namespace nlmech::scene

/// @file
/// Work-precision diagrams: digits of many methods against their cost, as a figure and a table. A few curves
/// are coloured and named at their ends, the others are grey in the background; strips below show the fastest
/// methods.
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

/// Labels and ranges of a diagram. One problem has a panel against time and, if there is a work_label, one
/// against the first column of work; several problems have one panel each against time. foreground() selects
/// the coloured curves and rankings_of() the fastest methods.
struct WorkPrecision {
  std::string heading = {};                                        ///< quantity and finding
  std::string digits = "digits: -log_{10} of the relative error";  ///< label of the ordinate
  double least_digits = 0;                                         ///< low end of the ordinate
  double most_digits = 15;                                         ///< high end of the ordinate
  std::string error = {};                    ///< heading of the error column; empty: digits
  std::string time = "median run time (s)";  ///< label of the abscissa
  std::string unit = "ms";                   ///< unit of time in the table: ms, µs or ns
  std::vector<std::string> work = {};        ///< further cost columns of the table
  std::string work_label = {};               ///< abscissa of the second panel
  std::vector<MethodGroup> groups = {};      ///< groups of methods, foremost first
  double rounding = 0;                       ///< greatest effect of one rounding of the
                                             ///< data on the final state; 0: unknown
  std::optional<std::pair<double, std::string>> least_time = {};  ///< a lower limit in s and its label
};

/// Puts figure and table of a diagram on @p show.
void show_work_precision(const WorkPrecision& what, const std::vector<ProblemLines>& problems, Show& show);

/// Status of a computation, and its error if it has one.
struct Ending {
  Status status;                ///< status of the method
  std::optional<double> error;  ///< error; nothing if the method failed
};

/// Computes and times one setting. @param ending_of gives the Ending of the result of @p compute; not timed
template <class Compute, class EndingOf>
[[nodiscard]] Attempt attempt(std::string setting, const Compute& compute, const EndingOf& ending_of,
                              bool quick) {
  const Stopwatch watch;
  const auto result = compute();
  const double first = watch.seconds();
  const Ending ending = ending_of(result);
  return {std::move(setting), std::string(to_string(ending.status.outcome())), ending.error,
          repeated_timing([&] { static_cast<void>(compute()); }, first, quick)};
}

}  // namespace nlmech::scene

/// @file
/// Work-precision diagrams: digits of many methods against what they cost, as a figure and a table.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/scene/show.hpp"
#include "nlmech/support/status.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::scene {

/// What one setting of a method came to.
struct Attempt {
  std::string setting;          ///< "tolerance 1e-06"
  std::string status;           ///< "success"
  std::optional<double> error;  ///< nothing if it failed
  Timing time;                  ///< s
  std::vector<Cell> work = {};  ///< further columns: WorkPrecision::work
};

/// Methods that belong together, in one colour.
struct MethodGroup {
  std::string name;    ///< "Taylor series"
  std::string colour;  ///< "#D55E00"
  int symbol;          ///< gnuplot's point type
  double width = 1.4;  ///< of lines
};

/// A method with what its settings came to.
struct MethodLine {
  std::string method;             ///< "ode45"
  std::size_t group;              ///< index of WorkPrecision::groups
  std::vector<Attempt> attempts;  ///< cheapest first; empty: not in this build

  /// The smallest error; infinite if all failed.
  [[nodiscard]] double least_error() const;
};

/// The methods on one problem.
struct ProblemLines {
  std::string problem;            ///< above the panel; empty if it is the only one
  std::vector<MethodLine> lines;  ///< the same methods for each problem, in the same order

  /// The line of a method. @throws std::out_of_range naming the method, if there is none
  [[nodiscard]] const MethodLine& of(const std::string& method) const;
};

/// The diagram. One problem has a panel over time and, if there is further work, one over its first column;
/// several problems have a panel each, over time.
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
  std::vector<MethodGroup> groups = {};                            ///< foremost first
  double rounding = 0;                                             ///< error by rounding of the data; 0: none
  std::optional<std::pair<double, std::string>> least_time = {};   ///< s, and what takes it
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

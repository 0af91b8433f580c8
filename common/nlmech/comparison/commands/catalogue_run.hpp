/// @file
/// `integrate --states`: one run for each row of a CSV file.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/commands/own_problem.hpp"

namespace nlmech::comparison {

/// Runs over a catalogue, as they were asked for.
struct CatalogueRuns {
  /// Parameters with values of their own.
  using Values = std::vector<std::pair<std::string, double>>;

  std::string program;  ///< on standard error
  std::string file;     ///< CSV: columns are unknowns and parameters by name, and `until`, if none of these
                        ///< has that name; others are handed on
  std::string shard;    ///< "i/n", or empty
  std::string typed;    ///< what else the rows depend on, beside the method and its settings, for merge
  int threads = 0;      ///< 0: one a processor
  double seconds = std::numeric_limits<double>::infinity();  ///< wall time of all; each has its own limit
  std::optional<double> until;  ///< the end of all rows; else they have ends of their own
  /// The problem with these parameters. @throws InputError if they cannot be meant
  std::function<std::unique_ptr<OwnProblem>(const Values&)> problem;
  /// The initial state of a row without columns. @throws InputError if a component has none
  std::function<std::vector<double>(const OwnProblem&)> initial_state;
  bool is_initial_given = false;  ///< by the user; else it is not asked for if all unknowns have columns
  /// What is asked of it; initial state and end are those of a row without columns.
  std::function<Request(const OwnProblem&, std::vector<double>)> request;
  /// The method of all rows. The request is that of the first row, to the farthest end of all.
  std::function<ivp::MethodInfo(const OwnProblem&, const Request&)> method;
};

/// Prints `row,t,...,status` in the order of the file, `...` the unknowns, `event` if events were asked for,
/// and the other columns. A run that fails is a row with empty cells and its status.
/// @returns the exit code: 1, with a word on standard error, if one failed
/// @throws InputError for whatever is wrong with the file, with line and value
[[nodiscard]] int print_runs(const CatalogueRuns& runs);

}  // namespace nlmech::comparison

/// @file
/// Runs of problems as rows of CSV, each verified by integration.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/comparison/commands/run_figure.hpp"
#include "nlmech/comparison/commands/run_options.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// A run as it is printed.
struct Trajectory {
  std::string rows;      ///< CSV
  std::string remark;    ///< of its verification, for standard error; may be empty
  std::string small;     ///< the same of components without a determined digit
  bool is_open = false;  ///< was it to be verified, and could it not be?
  PlotSamples samples;   ///< for a picture, if RunOptions::draw
};

/// One of many runs, as it is asked for.
struct EnsembleMember {
  std::shared_ptr<const UserProblem> problem;  ///< may be the same for many
  RunOptions options;                          ///< of its run
};

/// One of many runs, as it has ended.
struct EnsembleResult {
  Status status;          ///< a failure, whose run has no rows, leaves the others alone
  Trajectory trajectory;  ///< of a success
};

/// Names of what rows have behind the time: components, then further columns.
[[nodiscard]] std::vector<std::string> printed_names(const UserProblem& problem, const RunOptions& options);

/// What a method is chosen for.
[[nodiscard]] ChoiceRequest choice_request(const UserProblem& problem, const RunOptions& options);

/// The method that is taken where none is named: what method_for() says for the tolerance, among those that
/// have the settings, and, for rows and events on the way, values there as exact as at the end. `series`
/// where the problem ends before its end, and for a step.
[[nodiscard]] const ivp::MethodInfo& usual_method(const UserProblem& problem, const RunOptions& options);

/// Rows `t,...`: the first, those at RunOptions::every, RunOptions::at and at events, and the last at t1
/// exactly, or at the event that ends the run. Behind the state are RunOptions::columns; with events a last
/// column, `event`, has the text of each.
/// @throws Failure if the method fails or is wrong, InputError naming `--method` for settings that cannot be
/// meant
[[nodiscard]] Trajectory trajectory(const UserProblem& problem, const RunOptions& options,
                                    const ivp::MethodInfo& method);

/// The same by the usual method or, where its run fails or is wrong, by the first of some others whose run is
/// verified: methods that suit other problems, as far as they have the settings, by steps that miss no short
/// pulse. They share the run's limit. Without RunOptions::verify nothing tells which run is right, and there
/// are no others.
/// @param usual of usual_method() @throws Failure of the usual method if no other arrives
[[nodiscard]] Trajectory usual_trajectory(const UserProblem& problem, const RunOptions& options,
                                          const ivp::MethodInfo& usual);

/// The same for many runs with the same settings, side by side where the method can; what trajectory() throws
/// as Failure is their status. @param is_usual was the method not named? Then others are tried where it
/// fails, as by usual_trajectory() @param threads how many; 0: one a processor
[[nodiscard]] std::vector<EnsembleResult> trajectories(std::span<const EnsembleMember> members,
                                                       const ivp::MethodInfo& method, bool is_usual,
                                                       int threads);

/// `integrate --states`, one run for each row of a CSV file: prints `row,t,...,status` in the order of the
/// file, `...` the unknowns, `event` if events were asked for, and the other columns. A run that fails is a
/// row with empty cells and its status. Columns of the file are unknowns and parameters by name, and `until`,
/// if none of these has that name; others are handed on. The method of all rows is that of the first one to
/// the farthest end of all.
/// @param program on standard error
/// @returns the exit code: 1, with a word on standard error, if one failed
/// @throws InputError for whatever is wrong with the options or the file, with line and value
[[nodiscard]] int print_runs(const TypedOptions& typed, const std::string& program);

}  // namespace nlmech::comparison

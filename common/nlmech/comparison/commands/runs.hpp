/// @file
/// Runs of problems as CSV rows, verified by integration.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/comparison/commands/run_figure.hpp"
#include "nlmech/comparison/commands/run_options.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// Printed result of a run.
struct Trajectory {
  std::string rows;         ///< CSV
  std::string remark;       ///< remark on verification and events, for standard error; may be empty
  std::string small;        ///< remark on components without a determined digit; may be empty
  bool is_open = false;     ///< true if the verification was requested and impossible
  std::string_view method;  ///< name of the method that computed the run
  PlotSamples samples;      ///< samples for a figure, if RunOptions::draw
};

/// Failure of a run, with the rows that it computed.
class RunFailure : public Failure {
 public:
  /// @param why the failure @param rows see rows() @param size see size()
  RunFailure(const Failure& why, std::string rows, double size)
      : Failure(why), rows_(std::move(rows)), size_(size) {}
  /// CSV as Trajectory::rows: up to the last good step, or all rows of a run whose verification failed.
  [[nodiscard]] const std::string& rows() const noexcept { return rows_; }
  /// Largest absolute value of the last good state.
  [[nodiscard]] double size() const noexcept { return size_; }

 private:
  std::string rows_;
  double size_;
};

/// Input of one of many runs.
struct EnsembleMember {
  std::shared_ptr<const UserProblem> problem;  ///< problem, which runs may share
  RunOptions options;                          ///< options of the run
};

/// Result of one of many runs.
struct EnsembleResult {
  Status status;          ///< status of the run; a failure does not affect the others
  Trajectory trajectory;  ///< result of a successful run
};

/// Names of the columns after the time: components, then further columns.
[[nodiscard]] std::vector<std::string> printed_names(const UserProblem& problem, const RunOptions& options);

/// Request of a choice of methods for a run.
[[nodiscard]] ChoiceRequest choice_request(const UserProblem& problem, const RunOptions& options);

/// The method without `--method`: method_for() the tolerance among the adaptive methods that have the
/// settings; with rows or events before the end only methods whose dense output is as accurate as their
/// steps. `series` for a fixed step, and if method_for() finds none.
[[nodiscard]] const ivp::MethodInfo& default_method(const UserProblem& problem, const RunOptions& options);

/// Integrates and prints rows `t,...`: the initial state, rows at RunOptions::every, RunOptions::at and
/// events, and the last one exactly at t1 or at the event that ends the run. The state is followed by
/// RunOptions::columns and, if there are events, by a column `event` with their names.
/// @throws RunFailure if the run fails or its verification finds it wrong; InputError naming `--method` for
/// invalid settings
[[nodiscard]] Trajectory trajectory(const UserProblem& problem, const RunOptions& options,
                                    const ivp::MethodInfo& method);

/// trajectory() by @p first_method or, if its run fails or is wrong, by the first of five other
/// methods whose run is verified. These need the settings, their steps are at most reference_step_limit(),
/// and they share the time limit of the run. Without RunOptions::verify no other method is tried, because no
/// run could be confirmed.
/// @param first_method result of default_method() @throws Failure of @p first_method if no other run
/// is verified
[[nodiscard]] Trajectory default_trajectory(const UserProblem& problem, const RunOptions& options,
                                            const ivp::MethodInfo& first_method);

/// trajectory() of many runs with the same settings, in SIMD lanes if the method can; a Failure becomes the
/// status of its run. @param is_default true without `--method`: other methods are tried after a failure, as
/// by default_trajectory() @param threads number of threads; 0: one per processor
[[nodiscard]] std::vector<EnsembleResult> trajectories(std::span<const EnsembleMember> members,
                                                       const ivp::MethodInfo& method, bool is_default,
                                                       int threads);

/// `integrate --states`, one run for each row of a CSV file. Prints `row,t,...,status` in the order of the
/// file;
/// `...` stands for the unknowns, `event` if there are events, and the other columns. A failed run is a row
/// with empty cells and its status. Columns of the file are unknowns and parameters by name, and `until`,
/// unless one of these has that name; other columns are passed through. All runs use one method, chosen for
/// the first row and the end of the longest run.
/// @param program prefix of messages on standard error
/// @returns the exit code: 1, with a message on standard error, if a run failed
/// @throws InputError for invalid options or an invalid file, with line and value
[[nodiscard]] int print_runs(const TypedOptions& typed, const std::string& program);

}  // namespace nlmech::comparison

/// @file
/// Tolerance sweep of every method on every problem of the set, shared by the scenes that compare methods.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "chapters/integrators/problem_set.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::integrators {

/// A run with one tolerance or one fixed step size.
struct Trial {
  double tolerance;                  ///< relative; 0 for fixed steps
  std::string status;                ///< outcome, such as "success"; "refused": the method does not apply
  std::optional<double> error = {};  ///< median over the judged times; nothing if the run failed
  Statistics work = {};              ///< of the run from t0 to t1
  Timing time = {};                  ///< of the run from t0 to t1
  double processor = 0;              ///< processor time of the first run, s
  double step = 0;                   ///< fixed step size; 0: adaptive

  /// Did the run report success?
  [[nodiscard]] bool success() const { return status == "success"; }
  /// Correct digits: -log10 of the error, clamped to [0, 16]; 0 without an error.
  [[nodiscard]] double digits() const;
  /// The setting as text: "1e-05" for a tolerance, "h = 0.01" for a step size.
  [[nodiscard]] std::string setting() const;
};

/// A method on one problem.
struct MethodTrials {
  std::string method;         ///< name, such as "series"
  bool peer;                  ///< is it a method of a peer library?
  bool chooses;               ///< adaptive step size? Otherwise fixed
  std::vector<Trial> trials;  ///< loosest first; up to the first run that took too long

  /// Time for @p digits, s: of the fastest run that achieves them, or interpolated between two successive
  /// runs below and above. Nothing if no run achieves them, and for fixed steps.
  [[nodiscard]] std::optional<double> seconds_for(double digits) const;
};

/// All methods on one problem.
struct ProblemTrials {
  std::string problem;                ///< name, such as "kepler-0.99"
  Kind kind;                          ///< kind of difficulty
  bool has_solution;                  ///< does a solution reach t1? Otherwise success is wrong
  double condition;                   ///< condition number for relative errors
  double tolerance_condition;         ///< condition number for errors of one tolerance, absolute + |x|
  std::vector<MethodTrials> methods;  ///< in the order of names
  double length = 1;                  ///< number of accumulated errors relative to other problems

  /// Achievable digits at @p tolerance: one error of that size and 16 roundings, multiplied by their
  /// condition numbers and by the length.
  [[nodiscard]] double digits_to_expect(double tolerance) const;
  /// Did the run report success with fewer than half of the expected digits, when at least two are expected?
  /// Without a solution at t1 every success is a silent failure; otherwise a run with fixed steps is none.
  [[nodiscard]] bool silent_failure(const Trial& trial) const;
};

/// Extent of a sweep: tolerances, step limit of a run, and the work after which the sweep of a method ends.
struct WorkLimit {
  int loosest;             ///< -log10 of the first tolerance
  int tightest;            ///< -log10 of the last tolerance
  int by;                  ///< increment of -log10
  std::int64_t steps;      ///< step limit of a run; lower for fixed steps of many nodes
  std::int64_t most_work;  ///< work_of() of a run above which the sweep ends
};

/// Sweep of every method on one problem.
[[nodiscard]] scene::Result<ProblemTrials> sweep_of(const std::string& problem);
/// Sweeps of all problems.
[[nodiscard]] scene::Result<std::vector<ProblemTrials>> sweep();

/// The problems whose solution reaches t1.
[[nodiscard]] std::vector<const ProblemTrials*> with_solution(const std::vector<ProblemTrials>& all);

}  // namespace nlmech::chapters::integrators

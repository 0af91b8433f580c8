/// @file
/// Every method on every problem of the set over a sweep of tolerances: the results behind the scenes that
/// tell which method suits which problem.
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

/// A run at one tolerance, or with one step.
struct Trial {
  double tolerance;                  ///< relative; 0: with equal steps, of which nothing is promised
  std::string status;                ///< "success"; "refused" by the method before it began
  std::optional<double> error = {};  ///< median over the judged times; nothing if a run failed
  Statistics work = {};              ///< of the run from begin to end
  Timing time = {};                  ///< of the same
  double processor = 0;              ///< s of the processor, of the first run
  double step = 0;                   ///< length of equal ones; 0: the method chose them

  /// Did it say so?
  [[nodiscard]] bool success() const { return status == "success"; }
  /// -log10 of the error, from 0 to 16; 0 without one.
  [[nodiscard]] double digits() const;
  /// "1e-05" of a tolerance, "h = 0.01" of a step.
  [[nodiscard]] std::string setting() const;
};

/// A method on one problem.
struct MethodTrials {
  std::string method;         ///< "series"
  bool peer;                  ///< another author's
  bool chooses;               ///< its steps itself; else they are equal
  std::vector<Trial> trials;  ///< loose first; ends where a run took too long

  /// Seconds that @p digits take: of the runs that deliver them the fastest, interpolated between tolerances
  /// where the runs on both sides delivered less and more; nothing if none does, and with equal steps, which
  /// no number of digits determines.
  [[nodiscard]] std::optional<double> seconds_for(double digits) const;
};

/// All methods on one problem.
struct ProblemTrials {
  std::string problem;                ///< "kepler-0.99"
  Kind kind;                          ///< what makes it hard
  bool has_solution;                  ///< else success is wrong
  double condition;                   ///< for relative errors
  double tolerance_condition;         ///< for tolerances
  std::vector<MethodTrials> methods;  ///< in the order of names
  double length = 1;                  ///< how many times as many errors add up as on other problems

  /// Digits that @p tolerance can give: an error of one tolerance, and 16 roundings, made once and multiplied
  /// by the condition and the length.
  [[nodiscard]] double digits_to_expect(double tolerance) const;
  /// Did a run say success and give fewer than half of the digits to expect, where these are two or more?
  /// Where there is no solution any success is one; else equal steps promise nothing.
  [[nodiscard]] bool silent_failure(const Trial& trial) const;
};

/// How much of it: of each run, and after which run a method's sweep ends.
struct WorkLimit {
  int loosest;          ///< power of ten of the first tolerance
  int tightest;         ///< of the last
  int by;               ///< from one to the next
  std::int64_t steps;   ///< of a run, fewer with many nodes
  std::int64_t enough;  ///< right-hand sides of the last run, and Jacobians times components
};

/// Every method on one problem, shared by name.
[[nodiscard]] scene::Result<ProblemTrials> sweep_of(const std::string& problem);
/// Those of all problems.
[[nodiscard]] scene::Result<std::vector<ProblemTrials>> sweep();

/// Of all problems that have a solution.
[[nodiscard]] std::vector<const ProblemTrials*> with_solution(const std::vector<ProblemTrials>& all);

}  // namespace nlmech::chapters::integrators

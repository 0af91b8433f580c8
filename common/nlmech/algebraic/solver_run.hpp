/// @file
/// What all solvers of this component have in common: counting, watching, ending.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Throws std::invalid_argument, naming the method, the option, its value and the range, unless @p good.
void require_option(std::string_view method, bool good, std::string_view option, double value,
                    std::string_view range);

/// |F| sinks by 1 - cos^2/2 at the most for an angle between F and what a step can change. Below this cos^2
/// it cannot be made shorter but for rounding.
inline constexpr double least_cosine_squared = 1e-15;

/// One solve under way: the iterate, a trial point, and the report. A solver calls begin(), then makes steps
/// while go_on(), and ends with finish(). Nothing is allocated between.
class SolverRun {
 public:
  /// @param name of the method, for sentences
  /// @param equations to solve
  /// @param x start
  /// @param observer of accepted iterates
  /// @param tolerance done when |F| is no greater
  /// @param limit of accepted and rejected steps together
  /// @throws std::invalid_argument if x has another size, the tolerance is negative or the limit is
  SolverRun(std::string_view name, Equations& equations, const Eigen::VectorXd& x, const Observer& observer,
            double tolerance, std::int64_t limit);

  Eigen::VectorXd x;        ///< the latest accepted iterate
  Eigen::VectorXd f;        ///< F there
  double norm = 0;          ///< |F| there
  Eigen::VectorXd trial;    ///< where evaluate_trial() looks
  Eigen::VectorXd trial_f;  ///< F there
  double trial_norm = 0;    ///< |F| there; infinite if F is not finite
  Report report;            ///< filled as the solver goes

  /// The equations.
  [[nodiscard]] Equations& equations() const { return equations_; }
  /// The counters.
  [[nodiscard]] Statistics& statistics() { return report.statistics; }

  /// F at x, counted. @return |F|, infinite if F is not finite
  double evaluate(const Eigen::VectorXd& at, Eigen::VectorXd& out);
  /// F at the trial point.
  void evaluate_trial() { trial_norm = evaluate(trial, trial_f); }
  /// B at @p at, counted.
  void linearise(const Eigen::VectorXd& at) {
    equations_.linearise(at);
    ++statistics().jacobians;
  }

  /// F at the start, shown to the observer. @return success, `non_finite` or `interrupted`
  [[nodiscard]] Outcome begin();
  /// Is there something left to do, and has it neither failed nor used up its steps?
  [[nodiscard]] bool go_on(Outcome& outcome) const;
  /// Is |F| small enough?
  [[nodiscard]] bool is_done() const { return norm <= tolerance_; }
  /// Are the steps used up?
  [[nodiscard]] bool is_spent() const {
    return report.statistics.steps + report.statistics.rejected >= limit_;
  }
  /// The trial point becomes the iterate, and is shown at @p time (empty: the index of the iterate).
  /// @return success or `interrupted`
  [[nodiscard]] Outcome accept(std::optional<double> time = {});
  /// Counts a rejected step.
  void reject() { ++statistics().rejected; }

  /// The report, with a sentence of method, iteration, |F|, what happened and what to change.
  /// @param outcome how it ended
  /// @param start is overwritten by the last iterate
  /// @param advice replaces the common end of the sentence, if not empty
  [[nodiscard]] Report finish(Outcome outcome, Eigen::VectorXd& start, std::string_view advice = {});

 private:
  [[nodiscard]] Outcome show(std::optional<double> time);

  std::string name_;
  Equations& equations_;
  const Observer& observer_;
  double tolerance_;
  std::int64_t limit_;
};

/// Calls step(), which accepts a point or counts a rejected one and returns an Outcome, until F is small or a
/// step fails.
template <class Step>
[[nodiscard]] Outcome make_steps(SolverRun& run, Step&& step) {
  Outcome outcome = run.begin();
  while (run.go_on(outcome)) outcome = step();
  return outcome;
}

/// What to tell of one outcome in place of the common end of the sentence.
struct Advice {
  Outcome of = Outcome::success;  ///< which outcome
  std::string_view text;          ///< what it means for this method, and what to change
};

/// Where only |F|^2 is stationary.
inline constexpr Advice stationary{Outcome::singular_matrix,
                                   "B^T F is 0: |F| is stationary and not zero; start elsewhere"};

/// A whole solve: an Iteration of @p method on a run, whose step() make_steps() calls, and the report.
template <class Iteration, class Method>
[[nodiscard]] Report iterate(std::string_view name, const Method& method, Equations& equations,
                             Eigen::VectorXd& x, const Observer& observer, const Advice& advice = {}) {
  SolverRun run(name, equations, x, observer, method.tolerance, method.iterations);
  Iteration iteration(method, run);
  const Outcome outcome = make_steps(run, [&] { return iteration.step(); });
  return run.finish(outcome, x, outcome == advice.of ? advice.text : "");
}

}  // namespace nlmech::algebraic

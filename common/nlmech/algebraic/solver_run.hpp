/// @file
/// Common parts of the solvers: counters, observer, stopping criteria, report.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Throws std::invalid_argument with method, option, value and range unless @p good.
void require_option(std::string_view method, bool good, std::string_view option, double value,
                    std::string_view range);

/// Lower limit of cos^2 of the angle between F and the changes of F that a step can make. A step reduces |F|
/// by the factor 1 - cos^2/2 at most; below this limit the reduction is lost in rounding.
inline constexpr double least_cosine_squared = 1e-15;

/// State of one solve: iterate, trial point and report. A solver calls begin(), takes steps while go_on(),
/// and ends with finish(). Nothing is allocated in between.
class SolverRun {
 public:
  /// @param name name of the method, for messages
  /// @param equations the equations to solve
  /// @param x start
  /// @param observer called for accepted iterates
  /// @param tolerance converged when |F| is at most this
  /// @param limit of accepted plus rejected steps
  /// @throws std::invalid_argument if x has another size than the equations, or the tolerance or the limit is
  /// negative
  SolverRun(std::string_view name, Equations& equations, const Eigen::VectorXd& x, const Observer& observer,
            double tolerance, std::int64_t limit);

  Eigen::VectorXd x;        ///< the latest accepted iterate
  Eigen::VectorXd f;        ///< F there
  double norm = 0;          ///< |F| there
  Eigen::VectorXd trial;    ///< trial point of evaluate_trial()
  Eigen::VectorXd trial_f;  ///< F there
  double trial_norm = 0;    ///< |F| there; infinite if F is not finite
  Report report;            ///< updated during the solve

  /// The equations.
  [[nodiscard]] Equations& equations() const { return equations_; }
  /// The counters.
  [[nodiscard]] Statistics& statistics() { return report.statistics; }

  /// Evaluates F at @p at and counts it. @return |F|, infinite if F is not finite
  double evaluate(const Eigen::VectorXd& at, Eigen::VectorXd& out);
  /// Evaluates F at the trial point.
  void evaluate_trial() { trial_norm = evaluate(trial, trial_f); }
  /// Linearises at @p at and counts it.
  void linearise(const Eigen::VectorXd& at) {
    equations_.linearise(at);
    ++statistics().jacobians;
  }

  /// Evaluates F at the start and calls the observer. @return success, `non_finite` or `interrupted`
  [[nodiscard]] Outcome begin();
  /// Is another step needed and allowed? Sets @p outcome to `step_limit` if the limit is reached.
  [[nodiscard]] bool go_on(Outcome& outcome) const;
  /// Is |F| at most the tolerance?
  [[nodiscard]] bool is_done() const { return norm <= tolerance_; }
  /// Is the step limit reached?
  [[nodiscard]] bool is_spent() const {
    return report.statistics.steps + report.statistics.rejected >= limit_;
  }
  /// Makes the trial point the iterate and calls the observer with @p time (empty: the index of the iterate).
  /// @return success or `interrupted`
  [[nodiscard]] Outcome accept(std::optional<double> time = {});
  /// Counts a rejected step.
  void reject() { ++statistics().rejected; }

  /// Completes the report; a failure gets a message with method, iteration, |F|, cause and remedy.
  /// @param outcome outcome of the solve
  /// @param start receives the last iterate
  /// @param advice replaces the default cause and remedy, if not empty
  [[nodiscard]] Report finish(Outcome outcome, Eigen::VectorXd& start, std::string_view advice = {});

 private:
  [[nodiscard]] Outcome show(std::optional<double> time);

  std::string name_;
  Equations& equations_;
  const Observer& observer_;
  double tolerance_;
  std::int64_t limit_;
};

/// Calls step() until |F| meets the tolerance or a step fails. step() accepts a point or counts a rejected
/// one, and returns an Outcome.
template <class Step>
[[nodiscard]] Outcome make_steps(SolverRun& run, Step&& step) {
  Outcome outcome = run.begin();
  while (run.go_on(outcome)) outcome = step();
  return outcome;
}

/// Method-specific message for one outcome.
struct Advice {
  Outcome of = Outcome::success;  ///< outcome to which the text applies
  std::string_view text;          ///< cause and remedy for this method
};

/// Message for a stationary point of |F|^2 that is no root.
inline constexpr Advice stationary{Outcome::singular_matrix,
                                   "B^T F is 0: |F| is stationary and not zero; start elsewhere"};

/// One complete solve: calls step() of an Iteration(method, run) by make_steps() and returns the report.
template <class Iteration, class Method>
[[nodiscard]] Report iterate(std::string_view name, const Method& method, Equations& equations,
                             Eigen::VectorXd& x, const Observer& observer, const Advice& advice = {}) {
  SolverRun run(name, equations, x, observer, method.tolerance, method.iterations);
  Iteration iteration(method, run);
  const Outcome outcome = make_steps(run, [&] { return iteration.step(); });
  return run.finish(outcome, x, outcome == advice.of ? advice.text : "");
}

}  // namespace nlmech::algebraic

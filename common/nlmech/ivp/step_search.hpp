/// @file
/// A tolerance for methods of fixed step: the step is halved until two runs agree.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {

/// What is asked of search_step().
struct StepSearch {
  std::string name;                         ///< the method's, for messages
  std::optional<int> order = std::nullopt;  ///< of convergence in the step; nothing if it is not known
  double tolerance = 1e-9;                  ///< absolute and relative, positive and finite
  /// No run takes more steps than this: a search ends within seconds, whatever is asked of it.
  std::int64_t most_steps = std::int64_t{1} << 24;
};

/// A method with its step left open: integrates from the same begin to the same end at every call.
template <int n>
using FixedStepRun = std::function<Solution<n>(double step, const Observer<n>&, const Limits&)>;

namespace detail {

/// The states of a run at so many equidistant times, the end among them.
inline constexpr int search_samples = 16;

/// Keeps the account of a search: what to do after each run.
class SearchAccount {
 public:
  /// @throws std::invalid_argument for a tolerance that is not positive and finite
  explicit SearchAccount(StepSearch search);

  /// A run came to its end. @param difference from the run before: max |e_i| / (1 + |x_i|); NaN if that one
  /// failed. True if the search is over: status() says how.
  bool succeeded(double step, std::int64_t steps, double difference);
  /// A run failed. The same.
  bool failed(double t0, double t, std::int64_t steps, const Status& why);
  /// Success, or why no step was found.
  [[nodiscard]] const Status& status() const noexcept { return status_; }

 private:
  bool give_up(const std::string& reason);

  StepSearch search_;
  Status status_, failure_;
  double smallest_ = HUGE_VAL, failed_at_ = NAN;
  int since_smallest_ = 0, stuck_ = 0, failures_ = 0;
  bool has_succeeded_ = false;
};

/// Failure of a search whose limits are used up.
[[nodiscard]] Status search_limit(const StepSearch& search, Outcome outcome, double t0, const Limits& limits);

/// The runs of a search, and the difference between the two latest.
template <int n>
class SearchRuns {
 public:
  /// As for search_step().
  SearchRuns(const FixedStepRun<n>& run, double t0, double t1, const Limits& limits)
      : run_(run), t0_(t0), t1_(t1), limits_(limits) {}

  /// A run with the samples of its states.
  Solution<n> sample(double step) {
    std::swap(now_, before_);
    int next = 1;
    const Observer<n> keep = [&](const Step<n>& s) {
      for (; next <= samples && !later(sample_time(next), s.t1); ++next) {
        const double t = sample_time(next);
        if (t == s.t1) {
          state(next) = s.x1;
        } else {
          s.dense.at(t, state(next));
        }
      }
      return true;
    };
    Solution<n> solution = count(run_(step, keep, left()));
    complete_ = {complete_[1], solution.status.ok()};
    if (solution.status.ok()) now_.back() = solution.x;
    return solution;
  }

  /// A run for the observer.
  Solution<n> show(double step, const Observer<n>& observer) { return count(run_(step, observer, left())); }

  /// max |e_i| / (1 + |x_i|) between the two latest runs; NaN if one of them did not come to its end.
  [[nodiscard]] double difference() const {
    if (!complete_[0] || !complete_[1]) return NAN;
    double most = 0;
    for (int k = 0; k < samples; ++k) {
      const auto& a = now_[static_cast<std::size_t>(k)];
      const auto& b = before_[static_cast<std::size_t>(k)];
      for (Eigen::Index i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(a[i] - b[i]) / (1 + std::abs(a[i])));
    }
    return most;
  }

  /// Are the limits used up?
  [[nodiscard]] bool spent() const {
    const Limits rest = left();
    return rest.steps <= 0 || rest.seconds <= 0;
  }
  /// Work of all runs so far.
  [[nodiscard]] const Statistics& work() const { return work_; }

 private:
  static constexpr int samples = search_samples;

  [[nodiscard]] double sample_time(int k) const {
    return k == samples ? t1_ : t0_ + (t1_ - t0_) * k / samples;
  }
  [[nodiscard]] State<n>& state(int k) { return now_[static_cast<std::size_t>(k - 1)]; }
  [[nodiscard]] bool later(double a, double b) const { return t1_ > t0_ ? a > b : a < b; }
  [[nodiscard]] Limits left() const {
    return {limits_.steps - work_.steps - work_.rejected, limits_.seconds - watch_.seconds()};
  }
  Solution<n> count(Solution<n> solution) {
    work_ += solution.statistics;
    return solution;
  }

  const FixedStepRun<n>& run_;
  double t0_, t1_;
  Limits limits_;
  Stopwatch watch_;
  Statistics work_;
  std::array<State<n>, samples> now_, before_;
  std::array<bool, 2> complete_ = {false, false};
};

}  // namespace detail

/// Integrates by a method of fixed step to a tolerance. The first step is a sixteenth of the interval; it is
/// halved until two runs in a row differ at sixteen equidistant times, the end among them, by no more than
/// |e_i| <= tolerance (1 + |x_i|) in each component. Given back is the finer run, whose error is smaller than
/// the difference by the factor 2^order - 1, if the step is small enough for the order to show and the method
/// is consistent (radial functions whose shape follows the step are not: see named_integrator()); it is run
/// once more for the observer, if there is one. The statistics count the work of all runs.
///
/// Ends with `not_converged` if the tolerance would take more steps than allowed (foreseen by the order,
/// where it is known), or if four halvings in a row bring the runs no closer; with a run's own failure if
/// six in a row fail at the same time, four after one that did not, or forty before; with `step_limit` or
/// `time_limit` if
/// @p limits, which hold for all runs together, are used up.
/// @param search name, order and tolerance of the method
/// @param run the method
/// @param t0 begin
/// @param x0 state at the begin
/// @param t1 end, other than @p t0
/// @param observer sees the accepted run only; may be empty
/// @param limits bounds on all runs together
template <int n>
[[nodiscard]] Solution<n> search_step(const StepSearch& search, const FixedStepRun<n>& run, double t0,
                                      const State<n>& x0, double t1, const Observer<n>& observer,
                                      const Limits& limits) {
  detail::SearchAccount account(search);
  detail::SearchRuns<n> runs(run, t0, t1, limits);
  const auto end = [&](double t, const State<n>& x, Status status) {
    return Solution<n>{t, x, std::move(status), runs.work()};
  };
  for (double step = std::abs(t1 - t0) / detail::search_samples;; step /= 2) {
    Solution<n> solution = runs.sample(step);
    const Outcome outcome = solution.status.outcome();
    if (outcome == Outcome::step_limit || outcome == Outcome::time_limit || runs.spent())
      return end(t0, x0, detail::search_limit(search, outcome, t0, limits));
    if (solution.status.ok()) {
      if (!account.succeeded(step, solution.statistics.steps, runs.difference())) continue;
      if (!account.status().ok()) return end(t0, x0, account.status());
      if (observer) solution = runs.show(step, observer);
      return end(solution.t, solution.x, solution.status);
    }
    if (account.failed(t0, solution.t, solution.statistics.steps, solution.status))
      return end(solution.t, solution.x, account.status());
  }
}

}  // namespace nlmech::ivp

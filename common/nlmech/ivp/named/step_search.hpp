/// @file
/// A tolerance for methods of fixed step: the step is shortened until two runs agree, along the whole way,
/// with each other and with an integration by another method.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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
  /// The highest frequency that the problem is known to have, rad/time: the first run has steps of a radian,
  /// if it takes no more than a 4096th of most_steps, and a search that gets nowhere says so. 0: not known.
  double frequency = 0;
  std::vector<double> jumps = {};  ///< discontinuities between begin and end, in the direction of travel
};

/// A method with its step left open: integrates from the same begin to the same end at every call.
using FixedStepRun = std::function<Solution(double step, const Observer&, const Limits&)>;

/// What a run is held to beside other runs of its method.
struct Evidence {
  /// The same integration by other methods, which choose their steps and whose errors are far below the
  /// tolerance: the first that comes to the end counts. Empty: there is none.
  std::vector<std::function<Solution(const Observer&, const Limits&)>> references;
  /// By how many tolerances a state at a time breaks what the problem knows of its solutions: invariants,
  /// bounds. Empty: it knows nothing.
  std::function<double(double t, const State& x)> violation;
};

namespace detail {

/// Times at which runs are compared, in the direction of travel, @p t1 last: 48 spread by the golden ratio,
/// which no period of a load meets twice in the same phase; and t0 + (t1 - t0)/2^j, down to 2^-16 of the way
/// and 2^-8 after a jump (up to 16 of them), where motions die out or begin.
[[nodiscard]] std::vector<double> search_times(double t0, double t1, const std::vector<double>& jumps);

/// A run as a search has seen it.
struct Finding {
  std::int64_t count;         ///< steps of the run, as asked for
  std::int64_t before;        ///< of the run before
  double difference;          ///< between the two: max |e_i| / (1 + |x_i|); NaN if that one failed
  double doubt = 0;           ///< in the same measure, half of what other evidence objects
  std::string evidence = {};  ///< what objects
};

/// Keeps the account of a search: what to do after each run.
class SearchAccount {
 public:
  /// @param interval from begin to end, positive
  /// @throws std::invalid_argument for a tolerance that is not positive and finite
  SearchAccount(StepSearch search, double interval);

  /// Steps of the first run.
  [[nodiscard]] std::int64_t first_count() const;
  /// Steps of the next run: about twice as many, one count odd and the other even, no common factor; an
  /// alternating error does not look the same in both, and what one meets at the same phase of a load in each
  /// of its steps, the other does not.
  [[nodiscard]] static std::int64_t next_count(std::int64_t count) {
    return 2 * count + (count % 2 == 0 ? 1 : 2);
  }

  /// Are two runs close enough to look for other evidence?
  [[nodiscard]] bool agrees(double difference) const { return difference <= search_.tolerance; }
  /// A run came to its end. True if the search is over: status() says how.
  bool succeeded(const Finding& found);
  /// A run failed. The same.
  bool failed(double t0, double t, std::int64_t steps, const Status& why);
  /// Is it time to ask another method whether the solution has an end?
  [[nodiscard]] static bool wonders(const Finding& found);
  /// Another method did not come to the end, and runs do not agree. True if it found that there is none.
  bool ended(const Status& why);
  /// No other method came to the end within @p steps steps.
  void unconfirmed(const Finding& found, std::int64_t steps, const Status& why);
  /// Success, or why no step was found.
  [[nodiscard]] const Status& status() const noexcept { return status_; }

 private:
  bool give_up(const std::string& reason);
  [[nodiscard]] std::string compared(const Finding& found) const;
  [[nodiscard]] std::string about_frequency() const;

  StepSearch search_;
  double radians_;
  Status status_, failure_;
  double smallest_ = HUGE_VAL, failed_at_ = NAN;
  int since_smallest_ = 0, stuck_ = 0, failures_ = 0;
  bool has_succeeded_ = false;
};

/// Failure of a search whose limits are used up.
[[nodiscard]] Status search_limit(const StepSearch& search, Outcome outcome, double t0, const Limits& limits);

/// The states of a run at the times of a search.
class Trace {
 public:
  /// @param times outlive the trace
  explicit Trace(const std::vector<double>& times) : times_(&times), states_(times.size()) {}

  /// Forgets, and collects from a run from here on.
  [[nodiscard]] Observer collect(double t0) {
    next_ = 0;
    const bool forwards = times_->back() > t0;
    return [this, forwards](const Step& s) {
      for (; next_ < times_->size(); ++next_) {
        const double t = (*times_)[next_];
        if (forwards ? t > s.t1 : t < s.t1) break;
        if (t == s.t1) {
          states_[next_] = s.x1;
        } else {
          states_[next_].resize(s.x1.size());
          s.dense.at(t, states_[next_]);
        }
      }
      return true;
    };
  }
  /// The run is over: its end.
  void end(const Solution& solution) {
    complete_ = solution.status.ok();
    if (complete_) states_.back() = solution.x;
  }
  /// Greatest max |e_i| / (1 + |x_i|) of both; NaN if one of them is not complete or not finite.
  [[nodiscard]] double difference(const Trace& other) const {
    if (!complete_ || !other.complete_) return NAN;
    double most = 0;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const State &a = states_[k], &b = other.states_[k];
      for (Eigen::Index i = 0; i < a.size(); ++i) {
        const double part = std::abs(a[i] - b[i]) / (1 + std::abs(a[i]));
        if (!(part <= most)) most = part;
        if (std::isnan(part)) return NAN;
      }
    }
    return most;
  }
  /// Greatest of a measure of time and state.
  template <class Measure>
  [[nodiscard]] double greatest(const Measure& measure) const {
    double most = 0;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const double part = measure((*times_)[k], states_[k]);
      if (!(part <= most)) most = part;
    }
    return most;
  }

 private:
  const std::vector<double>* times_;
  std::vector<State> states_;
  std::size_t next_ = 0;
  bool complete_ = false;
};

/// The runs of a search, and the difference between the two latest.
class SearchRuns {
 public:
  /// As for search_step(). @param size components of the state
  SearchRuns(const StepSearch& search, const FixedStepRun& run, double t0, double t1, Eigen::Index size,
             const Limits& limits)
      : run_(run),
        t0_(t0),
        t1_(t1),
        limits_(limits),
        size_(size),
        times_(search_times(t0, t1, search.jumps)),
        now_(times_),
        before_(times_),
        reference_(times_) {}

  /// A run with the samples of its states.
  Solution sample(std::int64_t count) {
    std::swap(now_, before_);
    Solution solution = add(run_(step(count), now_.collect(t0_), left()));
    now_.end(solution);
    return solution;
  }
  /// A run for the observer.
  Solution show(std::int64_t count, const Observer& observer) {
    return add(run_(step(count), observer, left()));
  }
  /// Between the two latest runs, as Finding says.
  [[nodiscard]] double difference() const { return now_.difference(before_); }

  /// The integration by another method, made once. @return its end; a success if there is none
  const Solution& refer(const Evidence& evidence) {
    if (referred_ || evidence.references.empty()) return referred_end_;
    referred_ = true;
    const std::int64_t most = reference_steps();
    for (const auto& reference : evidence.references) {
      Limits limits = left();
      limits.steps = std::min(limits.steps, most);
      referred_end_ = add(reference(reference_.collect(t0_), limits));
      reference_.end(referred_end_);
      if (referred_end_.status.ok() || spent()) break;
    }
    return referred_end_;
  }
  /// Bound on the steps of that: no small multiple of those of all runs.
  [[nodiscard]] std::int64_t reference_steps() const {
    return std::max((std::int64_t{1} << 19) / size_, work_.steps);
  }
  /// Half the difference from that integration: what two runs leave of their tolerance to the finer of them.
  [[nodiscard]] double reference_doubt() const { return referred_ ? now_.difference(reference_) / 2 : 0; }
  /// A fourth of what the finer run breaks of the problem's own laws: errors of several components add up.
  [[nodiscard]] double law_doubt(const Evidence& evidence, double tolerance) const {
    return evidence.violation ? now_.greatest(evidence.violation) * tolerance / 4 : 0;
  }

  /// Are the limits used up?
  [[nodiscard]] bool spent() const { return left().steps <= 0 || left().seconds <= 0; }
  /// Which of them.
  [[nodiscard]] Outcome spent_limit() const {
    return left().steps <= 0 ? Outcome::step_limit : Outcome::time_limit;
  }
  /// Work of all runs so far.
  [[nodiscard]] const Statistics& work() const { return work_; }

 private:
  [[nodiscard]] double step(std::int64_t count) const {
    return std::abs(t1_ - t0_) / static_cast<double>(count);
  }
  [[nodiscard]] Limits left() const {
    return {limits_.steps - work_.steps - work_.rejected, limits_.seconds - watch_.seconds(),
            limits_.largest_step};
  }
  Solution add(Solution solution) {
    work_ += solution.statistics;
    return solution;
  }

  const FixedStepRun& run_;
  double t0_, t1_;
  Limits limits_;
  std::int64_t size_;
  Stopwatch watch_;
  Statistics work_;
  std::vector<double> times_;
  Trace now_, before_, reference_;
  Solution referred_end_;
  bool referred_ = false;
};

}  // namespace detail

/// Integrates by a method of fixed step to a tolerance. Runs take 16 steps or, if the problem's frequency is
/// known, steps of a radian; then about twice as many, in counts that share no factor, until two runs in a
/// row differ by no more than |e_i| <= tolerance (1 + |x_i|) in each component at some seventy times along
/// the way.
///
/// That two runs agree does not prove that they are right: both may have died out, have met a load in the
/// same phase at each of their steps, or have stood still in a motion that they do not resolve. So the finer
/// one is held to what another method finds for the same begin and end (@p evidence; named_integrator() takes
/// the Taylor series, which sees every frequency of a problem in its coefficients, or adaptive-collocation
/// where the problem cannot be expanded or is stiff), to two tolerances at the same times, and to the
/// problem's own invariants and bounds. If they do not agree the search goes on. This costs one integration
/// of high order, as a rule a small part of the runs, and makes success a statement on the whole way, dense
/// output included, up to errors that the two methods have in common.
///
/// Given back is the finer run, run once more for the observer, if there is one. The statistics count the
/// work of all runs and of the reference.
///
/// Ends with `not_converged` if the tolerance would take more steps than allowed (foreseen by the order,
/// where it is known, and by the frequency), if four runs in a row come no closer, or if the reference does
/// not come to the end; with the reference's failure if that meets a pole where runs only disagree; with a
/// run's own failure if six in a row fail at the same time, four after one that did not, or forty before;
/// with `step_limit` or `time_limit` if @p limits, which hold for all runs together, are used up.
/// @param search name, order and tolerance of the method
/// @param run the method
/// @param evidence beside the runs; each part may be empty
/// @param t0 begin
/// @param x0 state at the begin
/// @param t1 end, other than @p t0
/// @param observer sees the accepted run only; may be empty
/// @param limits bounds on all runs together
[[nodiscard]] inline Solution search_step(const StepSearch& search, const FixedStepRun& run,
                                          const Evidence& evidence, double t0, const State& x0, double t1,
                                          const Observer& observer, const Limits& limits) {
  detail::SearchAccount account(search, std::abs(t1 - t0));
  detail::SearchRuns runs(search, run, t0, t1, x0.size(), limits);
  const auto end = [&](double t, const State& x, Status status) {
    return Solution{t, x, std::move(status), runs.work()};
  };
  const auto limited = [&](Outcome outcome) {
    return end(t0, x0, detail::search_limit(search, outcome, t0, limits));
  };
  std::int64_t before = 0;
  for (std::int64_t count = account.first_count();; count = detail::SearchAccount::next_count(count)) {
    Solution solution = runs.sample(count);
    const Outcome outcome = solution.status.outcome();
    if (outcome == Outcome::step_limit || outcome == Outcome::time_limit) return limited(outcome);
    if (runs.spent()) return limited(runs.spent_limit());
    if (!solution.status.ok()) {
      if (account.failed(t0, solution.t, solution.statistics.steps, solution.status))
        return end(solution.t, solution.x, account.status());
      continue;
    }
    detail::Finding found{count, std::exchange(before, count), runs.difference()};
    if (account.agrees(found.difference)) {
      const std::int64_t most = runs.reference_steps();
      if (const Status& why = runs.refer(evidence).status; !why.ok()) {
        if (runs.spent()) return limited(runs.spent_limit());
        account.unconfirmed(found, most, why);
        return end(t0, x0, account.status());
      }
      found.doubt = runs.reference_doubt();
      found.evidence = "an integration by another method";
      if (const double law = runs.law_doubt(evidence, search.tolerance); !(law <= found.doubt)) {
        found.doubt = law;
        found.evidence = "the problem's invariants or bounds";
      }
    } else if (account.wonders(found)) {
      const Solution& other = runs.refer(evidence);
      if (runs.spent()) return limited(runs.spent_limit());
      if (account.ended(other.status)) return end(other.t, other.x, account.status());
    }
    if (!account.succeeded(found)) continue;
    if (!account.status().ok()) return end(t0, x0, account.status());
    if (observer) solution = runs.show(count, observer);
    return end(solution.t, solution.x, solution.status);
  }
}

}  // namespace nlmech::ivp

/// @file
/// Reference solutions: Taylor series of high order in any precision, with dense output. They exist to judge
/// the methods of this library, which share nothing with them, and are not made for speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "nlmech/ivp/state.hpp"
#include "nlmech/problems/problem.hpp"
#include "nlmech/problems/taylor_step.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::problems {

/// A state of a problem, made of its components in braces.
template <class Real, class Problem>
using StateOf = std::conditional_t<Problem::dimension == Eigen::Dynamic, ivp::BasicState<Real>,
                                   Vector<Real, Problem::dimension>>;

/// How a reference is computed.
struct ReferenceOptions {
  int order = 0;         ///< of the Taylor series, 4 or more; 0: chosen for the tolerance
  double tolerance = 0;  ///< last kept terms of a step relative to the state; 0: an eighth of Real's epsilon
  std::size_t most_steps = 10'000'000;                            ///< after which it gives up
  double largest_step = std::numeric_limits<double>::infinity();  ///< no step is longer; positive

  /// The same with the zeros replaced by what they stand for in the precision of @p Real.
  /// @throws std::invalid_argument naming the value that is out of range
  template <class Real>
  [[nodiscard]] ReferenceOptions completed() const {
    ReferenceOptions all = *this;
    if (tolerance == 0) all.tolerance = static_cast<double>(std::numeric_limits<Real>::epsilon()) / 8;
    if (!(all.tolerance > 0 && all.tolerance < 1)) {
      throw std::invalid_argument("reference: tolerance must lie in (0, 1), is " + std::to_string(tolerance));
    }
    // Cost goes with order^3 (order^2/2 for each of `order` products) over the step, step with
    // tolerance^(1/order): least near -ln(tolerance)/3, and flat to both sides, while longer steps round
    // less.
    if (order == 0) all.order = std::max(8, static_cast<int>(-std::log(all.tolerance) / 2));
    if (all.order < 4) {
      throw std::invalid_argument("reference: order must be 4 or more, is " + std::to_string(order));
    }
    return all;
  }
};

/// Walks along a solution from @p t0 to @p t1 and shows every step with the state at its end:
/// visit(const TaylorStep<Real, n>&, const Vector<Real, n>&). Steps end exactly at the problem's
/// discontinuities and at t1. The state is summed with its rounding error carried along (compensated), and
/// step lengths are short binary numbers, so that time is exact.
/// @returns step_underflow or non_finite where a solution ends before t1, step_limit
/// @throws std::invalid_argument if t1 < t0 or a number is not finite
template <class Real, class Problem, class Visit>
Status walk_reference(const Problem& problem, const Vector<Real, Problem::dimension>& x0, const Real& t0,
                      const Real& t1, const ReferenceOptions& options, Visit&& visit);

/// The states of a solution at given times, without keeping the way there.
/// @param problem of Problem::dimension
/// @param x0 state at time @p t0
/// @param t0 start
/// @param times in ascending order, from t0 on
/// @param states gets one for each time; fewer if the solution ends before
/// @param options order, tolerance
/// @returns as walk_reference()
template <class Real, class Problem>
[[nodiscard]] Status reference_states(const Problem& problem, const Vector<Real, Problem::dimension>& x0,
                                      const Real& t0, std::span<const Real> times,
                                      std::vector<Vector<Real, Problem::dimension>>& states,
                                      const ReferenceOptions& options = {}) {
  if (!std::is_sorted(times.begin(), times.end()) || (!times.empty() && times.front() < t0)) {
    throw std::invalid_argument("reference_states: times must ascend from t0 on");
  }
  states.clear();
  const auto visit = [&](const auto& step, const auto&) {
    const Real end = step.start + step.length;
    while (states.size() < times.size() && times[states.size()] <= end) {
      states.push_back(step.at(times[states.size()] - step.start));
    }
  };
  while (states.size() < times.size() && times[states.size()] == t0) states.push_back(x0);
  return times.empty() ? Status() : walk_reference(problem, x0, t0, times.back(), options, visit);
}

/// A solution that can be asked for its state at any time: the Taylor coefficients of all its steps.
///
/// With Real = long double the free and the impact Duffing oscillator to t = 500 and the three masses to
/// t = 200 take a few hundredths of a second, 0.8 to 3 kB a step, and end within 2.6e-16 of the state in 60
/// digits (tests/problems). A stiff problem needs many steps (about |lambda| (t1 - t0)/8): take
/// reference_states().
template <class Real, class Problem>
class ReferenceTrajectory {
 public:
  /// Number of components of the state.
  static constexpr int dimension = Problem::dimension;
  /// A state.
  using State = StateOf<Real, Problem>;

  /// Computes the solution from @p x0 at @p t0 to @p t1.
  /// @throws std::invalid_argument if t1 < t0, a number is not finite, or an option out of range
  ReferenceTrajectory(const Problem& problem, const State& x0, const Real& t0, const Real& t1,
                      const ReferenceOptions& options = {})
      : start_(t0), end_(t0), first_(x0), last_(x0) {
    const Vector<Real, dimension>& start = x0;
    status_ =
        walk_reference(problem, start, t0, t1, options,
                       [this](const TaylorStep<Real, dimension>& step, const Vector<Real, dimension>& after) {
                         steps_.push_back(step);
                         end_ = step.start + step.length;
                         last_ = after;
                       });
  }

  /// Success, or why the solution ends before t1.
  [[nodiscard]] const Status& status() const { return status_; }
  /// The time t0.
  [[nodiscard]] const Real& start() const { return start_; }
  /// The time t1; where the computation ended if the status is a failure.
  [[nodiscard]] const Real& end() const { return end_; }
  /// Number of Taylor series from start() to end().
  [[nodiscard]] std::size_t steps() const { return steps_.size(); }

  /// The state at time @p t.
  /// @throws std::invalid_argument unless start() <= t <= end()
  [[nodiscard]] State operator()(const Real& t) const {
    if (!(t >= start_ && t <= end_)) {
      throw std::invalid_argument("reference trajectory: t = " + std::to_string(static_cast<double>(t)) +
                                  " lies outside [" + std::to_string(static_cast<double>(start_)) + ", " +
                                  std::to_string(static_cast<double>(end_)) + "]");
    }
    if (t == end_) return last_;
    if (t == start_) return first_;
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), t,
                                        [](const Real& time, const auto& step) { return time < step.start; });
    const auto& step = *std::prev(after);
    return step.at(t - step.start);
  }

 private:
  Status status_;
  Real start_, end_;
  State first_, last_;
  std::vector<TaylorStep<Real, dimension>> steps_;
};

namespace detail {

/// Where a reference cannot go on.
[[nodiscard]] Status reference_failure(Outcome outcome, double t, double step, std::size_t steps);

/// Adds to a sum and keeps what rounding cuts off (Knuth, The Art of Computer Programming, 4.2.2, Theorem B).
template <class Real, int n>
void add_compensated(Vector<Real, n>& sum, Vector<Real, n>& carry, const Vector<Real, n>& increment) {
  for (Eigen::Index i = 0; i < sum.size(); ++i) {
    const Real term = carry[i] + increment[i], next = sum[i] + term, taken = next - sum[i];
    carry[i] = (sum[i] - (next - taken)) + (term - taken);
    sum[i] = next;
  }
}

/// The times at which the walk must stop: announced discontinuities, then the end.
template <class Real, class Problem>
[[nodiscard]] std::vector<Real> stops(const Problem& problem, const Real& t0, const Real& t1) {
  std::vector<Real> times;
  if constexpr (HasDiscontinuities<Problem>) {
    for (const double t : problem.discontinuities(static_cast<double>(t0), static_cast<double>(t1))) {
      if (t > t0 && t < t1) times.push_back(t);
    }
  }
  times.push_back(t1);
  return times;
}

template <class Real, int n>
[[nodiscard]] bool all_finite(const Vector<Real, n>& x) {
  using std::isfinite;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (!isfinite(x[i])) return false;
  }
  return true;
}

}  // namespace detail

template <class Real, class Problem, class Visit>
Status walk_reference(const Problem& problem, const Vector<Real, Problem::dimension>& x0, const Real& t0,
                      const Real& t1, const ReferenceOptions& options, Visit&& visit) {
  using std::isfinite;
  constexpr int n = Problem::dimension;
  const ReferenceOptions chosen = options.completed<Real>();
  if (!isfinite(t0) || !isfinite(t1) || t1 < t0 || !detail::all_finite(x0)) {
    throw std::invalid_argument("reference: from t0 = " + std::to_string(static_cast<double>(t0)) +
                                " to t1 = " + std::to_string(static_cast<double>(t1)) +
                                ": times and state must be finite, and t1 not before t0");
  }
  TaylorStep<Real, n> step;
  SeriesMemory<Real> memory;
  std::vector<double> scale(static_cast<std::size_t>(x0.size()), -detail::polynomial);
  Vector<Real, n> x = x0, carry = Vector<Real, n>::Zero(x0.size());
  Real t = t0;
  std::size_t count = 0;
  const auto failure = [&](Outcome outcome) {
    return detail::reference_failure(outcome, static_cast<double>(t), static_cast<double>(step.length),
                                     count);
  };
  for (const Real& stop : detail::stops(problem, t0, t1)) {
    while (t < stop) {
      if (count == chosen.most_steps) return failure(Outcome::step_limit);
      taylor_coefficients(problem, t, x, chosen.order, step.coefficient, memory);
      if (!detail::all_finite(step.coefficient.back())) return failure(Outcome::non_finite);
      const double most = std::min(detail::log2_of(Real(stop - t)), std::log2(chosen.largest_step));
      double log2_step = std::min(detail::log2_step(step.coefficient, chosen.tolerance, scale, most), most);
      bool last = false;
      step.start = t;
      do {
        last = log2_step >= detail::log2_of(Real(stop - t));
        step.length = last ? Real(stop - t) : detail::short_step<Real>(log2_step);
        if (!(t + step.length > t)) return failure(Outcome::step_underflow);
        log2_step = detail::log2_of(step.length) - 1;
      } while (!detail::is_solution(problem, step, chosen.tolerance, scale));
      detail::add_compensated(x, carry, step.increment(step.length));
      if (!detail::all_finite(x)) return failure(Outcome::non_finite);
      t = last ? stop : Real(t + step.length);
      ++count;
      visit(std::as_const(step), std::as_const(x));
    }
  }
  return {};
}

}  // namespace nlmech::problems

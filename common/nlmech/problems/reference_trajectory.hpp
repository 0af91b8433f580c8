/// @file
/// Reference solutions by Taylor series of high order in any precision, with dense output. They verify the
/// methods of this library and share no code with them.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "nlmech/ivp/state.hpp"
#include "nlmech/problems/problem.hpp"
#include "nlmech/program/growing_series.hpp"
#include "nlmech/program/vector.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::problems {

/// A step of a Taylor series: the state at start + s is the sum of column k of `coefficient` times s^k.
template <class Real, int n>
struct TaylorStep {
  Real start{};                                          ///< time at the start of the step
  Real length{};                                         ///< step size
  Eigen::Matrix<Real, n, Eigen::Dynamic> coefficient{};  ///< coefficients, a column for each power

  /// Highest power.
  [[nodiscard]] Eigen::Index order() const { return coefficient.cols() - 1; }
  /// The sum of the series at start + @p s without its first term. This term is by far the greatest; added
  /// last, it is rounded once.
  [[nodiscard]] Vector<Real, n> increment(const Real& s) const {
    Vector<Real, n> all = coefficient.col(order());
    for (Eigen::Index i = 0; i < all.size(); ++i) {
      Real sum = all[i];
      for (Eigen::Index k = order() - 1; k > 0; --k) sum = sum * s + coefficient(i, k);
      all[i] = sum * s;
    }
    return all;
  }
  /// The derivative of the sum at start + @p s.
  [[nodiscard]] Vector<Real, n> rate(const Real& s) const {
    Vector<Real, n> all = coefficient.col(0);
    for (Eigen::Index i = 0; i < all.size(); ++i) {
      Real sum(0);
      for (Eigen::Index k = order(); k > 0; --k)
        sum = sum * s + coefficient(i, k) * Real(static_cast<int>(k));
      all[i] = sum;
    }
    return all;
  }
  /// The state at start + @p s.
  [[nodiscard]] Vector<Real, n> at(const Real& s) const { return coefficient.col(0) + increment(s); }
};

/// Taylor coefficients of the solution through @p x at time @p t. Coefficient k + 1 is coefficient k of the
/// right-hand side over k + 1, which depends on the coefficients of the state up to k.
/// @param memory scratch memory; reuse it from step to step to avoid allocations
template <class Real, class Problem>
void taylor_coefficients(const Problem& problem, const Real& t, const Vector<Real, Problem::dimension>& x,
                         int order, TaylorStep<Real, Problem::dimension>& step, SeriesMemory<Real>& memory) {
  const auto size = static_cast<int>(x.size());
  using Series = GrowingSeries<Real>;
  memory.start(static_cast<std::size_t>(order));
  Series time = Series::variable(memory);
  Vector<Series, Problem::dimension> state(size), slope(size);
  for (int i = 0; i < size; ++i) state[i] = Series::variable(memory);
  time.set(0, t);
  time.set(1, Real(1));
  step.coefficient.resize(size, order + 1);
  step.coefficient.col(0) = x;
  for (int i = 0; i < size; ++i) state[i].set(0, x[i]);
  for (int k = 0; k < order; ++k) {
    memory.begin_pass(static_cast<std::size_t>(k));
    problem(time, state, slope);
    for (int i = 0; i < size; ++i) {
      Real& next = step.coefficient(i, k + 1);
      next = slope[i][static_cast<std::size_t>(k)] / (k + 1);
      state[i].set(static_cast<std::size_t>(k) + 1, next);
    }
  }
}

namespace detail {

/// Greater than every logarithm: log2 of the step size for a solution that is a polynomial.
inline constexpr double polynomial = 1e9;

/// An integer that is not below log2 |x|, and at most by a little more than 1 above; any number for x = 0.
template <class Real>
[[nodiscard]] int exponent_of(const Real& x) {
  using std::frexp;
  // Read off the bits of a normal double, which takes a tenth of the time of frexp.
  const auto bits = static_cast<int>(std::bit_cast<std::uint64_t>(static_cast<double>(x)) >> 52 & 0x7ff);
  if (bits > 0 && bits < 0x7ff) return bits - 1022;
  int exponent = 0;
  static_cast<void>(frexp(x, &exponent));
  return exponent;
}

/// log2 |x|; -polynomial for 0.
template <class Real>
[[nodiscard]] double log2_of(const Real& x) {
  using std::abs;
  using std::frexp;
  int exponent = 0;
  const double mantissa = static_cast<double>(frexp(Real(abs(x)), &exponent));
  return mantissa > 0 ? std::log2(mantissa) + exponent : -polynomial;
}

/// log2 of the step size at which the last two terms of the series equal the tolerance times the scale of the
/// state, after Jorba and Zou, A software package for the numerical integration of ODEs by means of
/// high-order Taylor methods, Experimental Mathematics 14 (2005) 99-117. The scale of a component is its
/// greatest value so far. Logarithms avoid overflow, because the coefficients of a stiff problem leave the
/// range of double.
/// @param most log2 of the greatest step size, which bounds the radius used for the scales
template <class Real, int n>
[[nodiscard]] double log2_step(const TaylorStep<Real, n>& all, double tolerance,
                               std::vector<double>& log2_scale, double most) {
  const auto& c = all.coefficient;
  const auto order = static_cast<int>(all.order());
  const auto size = static_cast<int>(c.rows());
  const auto root = [&](int i, double log2_size) {
    const double last = (log2_size - log2_of(Real(c(i, order)))) / order;
    const double before = (log2_size - log2_of(Real(c(i, order - 1)))) / (order - 1);
    return std::min(last, before);
  };
  double radius = polynomial, step = polynomial;
  for (int i = 0; i < size; ++i) radius = std::min(radius, root(i, 0));
  if (radius > polynomial / (2 * order)) return polynomial;
  radius = std::min(radius, most);
  for (int i = 0; i < size; ++i) {
    // The scale of a component that starts at 0 is the size of its terms well within the disc of convergence.
    double& scale = log2_scale[static_cast<std::size_t>(i)];
    for (int k = 0; k < order; ++k) {
      const double gain = k * (radius - 3);
      if (exponent_of(Real(c(i, k))) + gain > scale) scale = std::max(scale, log2_of(Real(c(i, k))) + gain);
    }
    step = std::min(step, root(i, scale + std::log2(tolerance)));
  }
  return step;
}

/// Does the sum of a series satisfy the equations within its step? Coefficients alone do not show it: those
/// of tanh(100 (t - 5)) at t = 0 vanish except for the first, in any precision. The defect is checked at
/// 0.618 and 0.999 of the step, because the equations may change at its end. The bound, relative to the
/// state, is 2^-20 or 2^20 tolerances, whichever is greater.
/// @param tolerance, log2_scale as in log2_step()
template <class Real, int n, class Problem>
[[nodiscard]] bool is_solution(const Problem& problem, const TaylorStep<Real, n>& step, double tolerance,
                               const std::vector<double>& log2_scale) {
  using std::isfinite;
  const double log2_share = std::max(-20.0, std::log2(tolerance) + 20);
  Vector<Real, n> slope(step.coefficient.rows());
  for (const double part : {0.618, 0.999}) {
    const Real s = step.length * part;
    problem(Real(step.start + s), step.at(s), slope);
    const Vector<Real, n> rate = step.rate(s);
    for (Eigen::Index i = 0; i < slope.size(); ++i) {
      const double most =
          std::max({log2_of(Real(step.length * slope[i])), log2_of(Real(step.length * rate[i])),
                    log2_scale[static_cast<std::size_t>(i)]});
      const Real defect = step.length * (slope[i] - rate[i]);
      const bool is_small = defect == 0 || log2_of(defect) <= most + log2_share;
      if (!is_small || !isfinite(defect)) return false;
    }
  }
  return true;
}

/// 2^x rounded down to eight binary digits, so that sums of such steps are exact and time has no rounding
/// error.
template <class Real>
[[nodiscard]] Real short_step(double log2) {
  using std::ldexp;
  const double whole = std::floor(log2);
  return ldexp(Real(std::floor(256 * std::exp2(log2 - whole))), static_cast<int>(whole) - 8);
}

}  // namespace detail

/// State of a problem; initialised with its components in braces.
template <class Real, class Problem>
using StateOf = std::conditional_t<Problem::dimension == Eigen::Dynamic, ivp::BasicState<Real>,
                                   Vector<Real, Problem::dimension>>;

/// Options of a reference.
struct ReferenceOptions {
  int order = 0;         ///< order of the Taylor series, 4 or more; 0: chosen for the tolerance
  double tolerance = 0;  ///< last terms of a step relative to the state; 0: an eighth of Real's epsilon
  std::size_t most_steps = 10'000'000;                            ///< limit of the number of steps
  double largest_step = std::numeric_limits<double>::infinity();  ///< greatest step size; positive

  /// The options with zeros replaced by the defaults for the precision of @p Real.
  /// @throws std::invalid_argument naming the value that is out of range
  template <class Real>
  [[nodiscard]] ReferenceOptions completed() const {
    ReferenceOptions all = *this;
    if (tolerance == 0) all.tolerance = static_cast<double>(std::numeric_limits<Real>::epsilon()) / 8;
    if (!(all.tolerance > 0 && all.tolerance < 1)) {
      throw std::invalid_argument("reference: tolerance must lie in (0, 1), is " + std::to_string(tolerance));
    }
    // The cost per time is proportional to order^3 (order^2/2 for each of `order` products) over the step
    // size, which is proportional to tolerance^(1/order). The minimum near -ln(tolerance)/3 is flat; a higher
    // order takes longer steps with less rounding.
    if (order == 0) all.order = std::max(8, static_cast<int>(-std::log(all.tolerance) / 2));
    if (all.order < 4) {
      throw std::invalid_argument("reference: order must be 4 or more, is " + std::to_string(order));
    }
    return all;
  }
};

/// Integrates from @p t0 to @p t1 and calls visit(const TaylorStep<Real, n>&, const Vector<Real, n>&) with
/// every step and the state at its end. Steps end exactly at the problem's discontinuities and at t1. The
/// state uses compensated summation, and step sizes are short binary numbers, so that the time is exact.
/// @returns step_underflow or non_finite if the solution ends before t1, or step_limit
/// @throws std::invalid_argument if t1 < t0 or a number is not finite
template <class Real, class Problem, class Visit>
Status integrate_reference(const Problem& problem, const Vector<Real, Problem::dimension>& x0, const Real& t0,
                           const Real& t1, const ReferenceOptions& options, Visit&& visit);

/// States of a solution at given times, without storing its steps.
/// @param problem problem, see problem.hpp
/// @param x0 state at time @p t0
/// @param t0 start
/// @param times output times in ascending order, from t0 on
/// @param states receives one state per time, fewer if the solution ends earlier
/// @param options order, tolerance
/// @returns status as of integrate_reference()
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
  return times.empty() ? Status() : integrate_reference(problem, x0, t0, times.back(), options, visit);
}

/// A solution with its state at any time, stored as Taylor coefficients of all steps.
///
/// With Real = long double the free and the impact Duffing oscillator to t = 500 and the three masses to t =
/// 200 take a few hundredths of a second and 0.8 to 3 kB per step; the final state is within 2.6e-16 of the
/// one in 60 digits (tests/problems). For a stiff problem, which needs about |lambda| (t1 - t0)/8 steps, use
/// reference_states().
template <class Real, class Problem>
class ReferenceTrajectory {
 public:
  /// Number of components of the state.
  static constexpr int dimension = Problem::dimension;
  /// Type of the state.
  using State = StateOf<Real, Problem>;

  /// Computes the solution from @p x0 at @p t0 to @p t1.
  /// @throws std::invalid_argument if t1 < t0, a number is not finite, or an option out of range
  ReferenceTrajectory(const Problem& problem, const State& x0, const Real& t0, const Real& t1,
                      const ReferenceOptions& options = {})
      : start_(t0), end_(t0), first_(x0), last_(x0) {
    const Vector<Real, dimension>& start = x0;
    status_ = integrate_reference(
        problem, start, t0, t1, options,
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
  /// The time t1; after a failure the time reached.
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

/// Failure status at the time where a reference ends early.
[[nodiscard]] Status reference_failure(Outcome outcome, double t, double step, std::size_t steps);

/// Compensated summation: keeps the rounding error in @p carry (Knuth, The Art of Computer
/// Programming, 4.2.2, Theorem B).
template <class Real, int n>
void add_compensated(Vector<Real, n>& sum, Vector<Real, n>& carry, const Vector<Real, n>& increment) {
  for (Eigen::Index i = 0; i < sum.size(); ++i) {
    const Real term = carry[i] + increment[i], next = sum[i] + term, taken = next - sum[i];
    carry[i] = (sum[i] - (next - taken)) + (term - taken);
    sum[i] = next;
  }
}

/// Times at which steps must end: discontinuities, then t1.
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
Status integrate_reference(const Problem& problem, const Vector<Real, Problem::dimension>& x0, const Real& t0,
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
      taylor_coefficients(problem, t, x, chosen.order, step, memory);
      if (!detail::all_finite<Real, n>(step.coefficient.col(chosen.order)))
        return failure(Outcome::non_finite);
      const double most = std::min(detail::log2_of(Real(stop - t)), std::log2(chosen.largest_step));
      double log2_step = std::min(detail::log2_step(step, chosen.tolerance, scale, most), most);
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

/// @file
/// Integration by Taylor series of the solution: the paper's fixed step and order, or both by the radius of
/// convergence.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/state.hpp"
#include "nlmech/ivp/step_control.hpp"

namespace nlmech::ivp {

namespace taylor_series {

/// Logarithm to the base 2 to 0.01, which is good enough for a step: of 0 below -1000.
[[nodiscard]] inline double rough_log2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const double exponent = static_cast<double>(static_cast<std::int64_t>(bits >> 52U)) - 1023;
  const double mantissa =
      std::bit_cast<double>((bits & 0xfffffffffffffU) | std::bit_cast<std::uint64_t>(1.0)) - 1;
  return exponent + mantissa * (1.3465 - 0.3465 * mantissa);
}

/// 2^x to 0.3 %, x held between -1000 and 1000.
[[nodiscard]] inline double rough_exp2(double x) {
  const double held = std::clamp(x, -1000.0, 1000.0), whole = std::floor(held), part = held - whole;
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023) << 52U;
  return std::bit_cast<double>(exponent) * (1 + part * (0.6565 + 0.3435 * part));
}

/// The power of two next to a length, by the same measure.
[[nodiscard]] inline double power_of_two(double length) {
  return rough_exp2(std::floor(rough_log2(length) + 0.5));
}

/// The sum of c_k s^k for k = 1, ..., order: even and odd powers apart, the two halves side by side.
[[nodiscard]] inline double increment(const double* c, int order, double s) {
  const double square = s * s;
  int k = order;
  double high = c[k], low = c[k - 1];
  for (k -= 2; k >= 2; k -= 2) {
    high = high * square + c[k];
    low = low * square + c[k - 1];
  }
  // high belongs to the power k + 2 or, by now, 2 or 1; low to the one below it.
  if (k == 1) return (high * square + c[1]) * s + low * square;
  return high * square + low * s;
}

/// The derivative of the series with respect to s.
[[nodiscard]] inline double slope(const double* c, int order, double s) {
  double sum = order * c[order];
  for (int k = order - 1; k >= 1; --k) sum = sum * s + k * c[k];
  return sum;
}

/// The last two terms in the norm max_i |e_i| / (atol + rtol |x_i|), and what tells whether all are finite.
struct Tail {
  double last = 0;    ///< of the order N
  double before = 0;  ///< of the order N - 1
  double sum = 0;     ///< of the absolute values of the first and the last coefficients

  /// Takes in a component by its coefficients 0, 1, N - 1 and N.
  void add(double x, double first, double previous, double end, double atol, double rtol) {
    const double unit = 1 / (atol + rtol * std::abs(x));
    last = std::max(last, unit * std::abs(end));
    before = std::max(before, unit * std::abs(previous));
    sum += std::abs(end) + std::abs(first);
  }
  /// Are all coefficients finite? The last ones tell: they are made of the others.
  [[nodiscard]] bool is_finite() const { return sum <= std::numeric_limits<double>::max(); }
  /// The length at which the last two terms are 1, times @p log2_safety as a power of two; positive.
  [[nodiscard]] double length(int order, double scale, double log2_safety) const {
    const double log2 = std::max(rough_log2(last) / order, rough_log2(before) / (order - 1));
    return scale * rough_exp2(log2_safety - log2);
  }
};

/// x1 = x0 + carry + @p increment of one component, and what rounding cuts off.
inline void add_increment(double x0, double carry, double increment, double& x1, double& next_carry) {
  const double term = carry + increment;
  x1 = x0 + term;
  const double taken = x1 - x0;
  next_carry = (x0 - (x1 - taken)) + (term - taken);
}

/// The series of a step: coefficients in powers of tau = (t - t0)/T with a power of two for T.
template <class S>
class Expansion : public DenseOutputOf<S> {
 public:
  using State = typename S::State;  ///< all components

  /// @param system outlives the expansion
  Expansion(const S& system, int order)
      : taylor_(system.taylor(order)), size_(system.size()), order_(order), carry_(State::Zero(size_)) {}

  /// Starts a stretch on which the right-hand side is smooth.
  void begin_segment(double begin, double end, const State& x) {
    segment_ = SmoothSegment(begin, end);
    taylor_.begin_segment(segment_(begin), x);
  }
  /// Computes the coefficients at (t, x) with T = @p scale.
  void expand(double t, const State& x, double scale) {
    t0_ = t;
    scale_ = scale;
    taylor_.expand(segment_(t), x, scale);
  }
  /// Its last terms. @param x the state at its start
  [[nodiscard]] Tail tail(const State& x, double atol, double rtol) const {
    Tail tail;
    for (int i = 0; i < size_; ++i) {
      const double* const c = taylor_.coefficients(i);
      tail.add(x[i], c[1], c[order_ - 1], c[order_], atol, rtol);
    }
    return tail;
  }
  /// Coefficient @p k of component @p i, times T^k.
  [[nodiscard]] double coefficient(int i, int k) const { return taylor_.coefficients(i)[k]; }
  /// Where f is asked for when @p t is meant.
  [[nodiscard]] double inside(double t) const { return segment_(t); }

  /// The state @p x1 at t0 + @p h. What rounding cuts off goes to a place that accept() takes over.
  void advance(double h, const State& x0, State& x1) {
    const double s = h / scale_;
    if constexpr (S::dimension == Eigen::Dynamic) next_carry_.resize(size_);
    for (int i = 0; i < size_; ++i) {
      add_increment(x0[i], carry_[i], increment(taylor_.coefficients(i), order_, s), x1[i], next_carry_[i]);
    }
  }
  /// Goes on from the end of the latest advance().
  void accept() { carry_ = next_carry_; }
  /// dx/dt of the series at t0 + @p h, component @p i.
  [[nodiscard]] double slope_at(double h, int i) const {
    return slope(taylor_.coefficients(i), order_, h / scale_) / scale_;
  }

  /// Within the latest step.
  void at(double t, State& x) const override {
    x.resize(size_);
    const double s = (t - t0_) / scale_;
    for (int i = 0; i < size_; ++i) {
      const double* const c = taylor_.coefficients(i);
      x[i] = c[0] + increment(c, order_, s);
    }
  }

 private:
  decltype(std::declval<const S&>().taylor(1)) taylor_;
  int size_, order_;
  SmoothSegment segment_;
  State carry_, next_carry_;
  double t0_ = 0, scale_ = 1;
};

/// Tolerances and order, and the formulas with them; see Series.
struct Rule {
  double relative_tolerance;  ///< of the last terms
  double absolute_tolerance;  ///< of the last terms
  double largest_step;        ///< 0: no bound
  int order;                  ///< of all steps

  /// Of the lengths of steps.
  static constexpr StepRule steps = {.shortest = 0, .stretch = 1, .measured = true};
  /// So often the unit of time is made smaller where coefficients are not finite.
  static constexpr int attempts = 24;

  /// exp(-0.7/(N - 1)), as a power of two.
  [[nodiscard]] double log2_safety() const { return -0.7 / (order - 1) * 1.4426950408889634; }

  /// The unit of time of the first step over @p interval: in which the state would change by its own size.
  template <class X>
  [[nodiscard]] double first_scale(const X& x, const X& f, double interval) const {
    const double size = x.template lpNorm<Eigen::Infinity>() + absolute_tolerance;
    const double rate = f.template lpNorm<Eigen::Infinity>();
    return power_of_two(rate * interval > size ? size / rate : interval);
  }
  /// That of the next attempt. Coefficients that leave the range of double with T leave it no more with a
  /// small part of T.
  [[nodiscard]] static double smaller(double scale) { return std::ldexp(scale, -16); }
  /// That of the step after one of length @p taken.
  [[nodiscard]] static double next_scale(double scale, double taken) {
    const double ratio = taken / scale;
    return ratio < 0.25 || ratio > 4 ? power_of_two(taken) : scale;
  }
  /// How long a step is to be.
  [[nodiscard]] double length(const Tail& tail, double scale, double log2_safety) const {
    const double h = tail.length(order, scale, log2_safety);
    return largest_step > 0 ? std::min(h, largest_step) : h;
  }

  /// Is the slope of the series at the end @p x1 of a step of length @p h that of the equation, @p f? The
  /// term after the last one is some tenth of the tolerance and its slope N + 1 times that; the bound leaves
  /// room for a stiff equation. @param slope_at of component i
  template <class X, class Slope>
  [[nodiscard]] bool slope_agrees(const X& x1, const X& f, double h, const Slope& slope_at) const {
    const double room = 100.0 * (order + 1), size = x1.template lpNorm<Eigen::Infinity>();
    for (int i = 0; i < static_cast<int>(x1.size()); ++i) {
      const double tolerance = absolute_tolerance + relative_tolerance * std::abs(x1[i]);
      const double rounding = 1000 * std::numeric_limits<double>::epsilon() * (size + std::abs(h * f[i]));
      const double difference = std::abs(h * (f[i] - slope_at(i)));
      if (!(difference <= room * tolerance + rounding)) return false;
    }
    return true;
  }
};

}  // namespace taylor_series

/// Each step sums the Taylor series of the solution about its start.
///
/// With a `step` T and an order N this is the scheme of C. P. Filipich and M. B. Rosales, A straightforward
/// approach to solve ordinary nonlinear differential systems, section 3.2: steps of equal length, N terms
/// beyond the first, whatever they are worth. It converges where T is below the radius of convergence of
/// every step, and is wrong without notice where it is not.
///
/// Without a step, steps are chosen after A. Jorba and M. Zou, A software package for the numerical
/// integration of ODEs by means of high-order Taylor methods, Experimental Mathematics 14 (2005) 99-117: the
/// length at which the last two terms, in the norm max_i |e_i| / (atol + rtol |x_i|), are 1, times
/// exp(-0.7/(N - 1)); the order from the tolerance. A first step, or one more than twice as long as the step
/// before, is tested: if the slope of the series at its end is not that of the equation, it is halved (a
/// series with gaps can look like a polynomial). No step is longer than the series converges.
///
/// Steps end on announced discontinuities. Their lengths are the differences of the doubles at their ends, so
/// that no error of time adds up, and the state is summed with the part that rounding cuts off.
///
/// Dense output: the series of the step, as accurate as its end. Statistics::right_hand_sides counts orders:
/// N a step, each as much work as an evaluation with all its products replaced by sums.
///
/// Tests hold fixed steps to the order N (observed within 0.25); with chosen steps the error of a damped
/// motion over ten units of time to 20 tolerances and 40 eps, and Lorenz's equations at t = 20 to 1e-8 of a
/// computation in 70 digits.
struct Series {
  static constexpr std::string_view name = "series";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                   ///< rtol of the last terms, from 1e-18 to 0.1
  double absolute_tolerance = 1e-9;                   ///< atol of the last terms, positive
  int order = 0;                                      ///< N, from 2 to 100; 0: series_order() of rtol
  double step = 0;                                    ///< T, the same for all steps; 0: chosen
  double largest_step = 0;                            ///< no step is longer; 0: no bound
};

/// The order that series takes for a relative tolerance: least work for problems of a few products, where the
/// cost of a step goes with the order rather than with its square.
[[nodiscard]] int series_order(double relative_tolerance);

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const Series& method);

/// With the order that is taken.
[[nodiscard]] inline taylor_series::Rule rule_of(const Series& method) {
  return {method.relative_tolerance, method.absolute_tolerance, method.largest_step,
          method.order > 0 ? method.order : series_order(method.relative_tolerance)};
}

namespace taylor_series {

/// Steps of fixed length and order.
template <class S>
class FixedStepper : public StepperOf<S> {
 public:
  using State = typename S::State;  ///< all components

  /// @param problem outlives the stepper
  FixedStepper(const InitialValueProblemOf<S>& problem, int order)
      : StepperOf<S>(problem.system.size()), expansion_(problem.system, order), order_(order) {}

  /// On the command line.
  [[nodiscard]] std::string_view name() const { return Series::name; }
  /// See Stepper.
  void begin_segment(double begin, double end) {
    begin_ = begin;
    end_ = end;
    is_new_ = true;
  }
  /// From t to t + h.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
    if (std::exchange(is_new_, false)) expansion_.begin_segment(begin_, end_, x0);
    expansion_.expand(t, x0, power_of_two(std::abs(h)));
    statistics.right_hand_sides += order_;
    if (!expansion_.tail(x0, 1, 0).is_finite()) return non_finite_coefficients(Series::name, t, order_);
    expansion_.advance(h, x0, x1);
    expansion_.accept();
    return {};
  }
  /// Within the latest step.
  void at(double t, State& x) const override { expansion_.at(t, x); }

 private:
  Expansion<S> expansion_;
  int order_;
  double begin_ = 0, end_ = 0;
  bool is_new_ = true;
};

/// Steps of chosen length: one integration from begin to end.
template <class S>
class Run : public AdaptiveStepLoop<S, Run<S>> {
 public:
  /// @param problem outlives the run
  Run(const InitialValueProblemOf<S>& problem, const Rule& rule)
      : Base(problem, Series::name, Rule::steps),
        rule_(rule),
        log2_safety_(rule.log2_safety()),
        expansion_(problem.system, rule.order),
        next_(problem.x0),
        f_(problem.x0) {}

 private:
  using Base = AdaptiveStepLoop<S, Run>;
  friend Base;
  using Base::control_;
  using Base::now_;
  using Base::problem_;

  Status begin(double end) {
    expansion_.begin_segment(now_.t, end, now_.x);
    problem_.system.rhs(expansion_.inside(now_.t), now_.x, f_);
    ++now_.statistics.right_hand_sides;
    if (!f_.allFinite()) return non_finite_rhs(Series::name, now_.t);
    scale_ = rule_.first_scale(now_.x, f_, std::abs(end - now_.t));
    before_ = 0;
    return {};
  }

  [[nodiscard]] bool expand(Tail& tail) {
    for (int attempt = 0; attempt < Rule::attempts; ++attempt) {
      expansion_.expand(now_.t, now_.x, scale_);
      now_.statistics.right_hand_sides += rule_.order;
      tail = expansion_.tail(now_.x, rule_.absolute_tolerance, rule_.relative_tolerance);
      if (tail.is_finite()) return true;
      scale_ = Rule::smaller(scale_);
    }
    return false;
  }
  // The coefficients say how long the step is, whatever the one before was.
  Status prepare() {
    Tail tail;
    if (!expand(tail)) return non_finite_coefficients(Series::name, now_.t, rule_.order);
    const double length = rule_.length(tail, scale_, log2_safety_);
    is_tested_ = length > 2 * before_;
    control_.start(length);
    return {};
  }

  double attempt(double t1) {
    const double h = t1 - now_.t;
    expansion_.advance(h, now_.x, next_);
    return !is_tested_ || slope_agrees(t1, h) ? 0 : HUGE_VAL;
  }
  [[nodiscard]] double shorter(double /*error*/) const { return control_.taken() / 2; }
  [[nodiscard]] Status missed(double /*t1*/, double /*error*/) const {
    return step_underflow(Series::name, now_.t, control_.length());
  }

  [[nodiscard]] bool slope_agrees(double t1, double h) {
    if (!next_.allFinite()) return false;
    problem_.system.rhs(expansion_.inside(t1), next_, f_);
    ++now_.statistics.right_hand_sides;
    return rule_.slope_agrees(next_, f_, h, [&](int i) { return expansion_.slope_at(h, i); });
  }
  Status accept(double t1, double /*error*/) {
    if (!next_.allFinite()) return non_finite_state(Series::name, now_.t, t1 - now_.t);
    expansion_.accept();
    before_ = control_.taken();
    scale_ = Rule::next_scale(scale_, before_);
    return this->take(t1, next_, expansion_);
  }

  Rule rule_;
  double log2_safety_, scale_ = 1, before_ = 0;
  bool is_tested_ = true;
  Expansion<S> expansion_;
  typename S::State next_, f_;
};

}  // namespace taylor_series

/// See integrate(). @throws std::invalid_argument also for a problem that cannot be expanded: written for
/// double alone, or with a branch that it has not announced
template <SystemLike S>
[[nodiscard]] SolutionOf<S> run(const InitialValueProblemOf<S>& problem, const Series& method) {
  check_options(method);
  const taylor_series::Rule rule = rule_of(method);
  if (method.step > 0) {
    taylor_series::FixedStepper<S> stepper(problem, rule.order);
    return integrate_fixed_steps(problem, method.step, stepper);
  }
  return taylor_series::Run<S>(problem, rule).run();
}

/// The library's, for every System.
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Series& method);

}  // namespace nlmech::ivp

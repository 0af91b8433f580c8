/// @file
/// Integration by Taylor series of the solution: the paper's fixed step and order, or both by the radius of
/// convergence.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/series/series_rule.hpp"

namespace nlmech::ivp {

/// Each step sums the Taylor series of the solution about its begin.
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

/// @file
/// The Runge-Kutta pair of Dormand and Prince under the step control of MATLAB's ode45.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/runge_kutta/weighted.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::ivp {

/// Orders 5 and 4 in 7 stages, the last of which is the first of the next step (J. R. Dormand, P. J. Prince,
/// A family of embedded Runge-Kutta formulae, J. Comput. Appl. Math. 6 (1980) 19-26), goes on with the
/// fifth-order value; steps are chosen as by MATLAB's ode45 (L. F. Shampine, M. W. Reichelt, The MATLAB ODE
/// suite, SIAM J. Sci. Comput. 18 (1997) 1-22):
///  - a step is accepted if max_i |e_i| / max(|x0_i|, |x1_i|, atol/rtol) <= rtol, e the difference of both
///    orders;
///  - after a rejection the step shrinks by max(0.1, 0.8 (rtol/err)^(1/5)), after further ones it halves; if
///    accepted at once, the next step is shorter or longer by (rtol/err)^(1/5)/1.25, at most 5 times;
///  - the last step is stretched by up to 10 %; none is shorter than 16 spacings of doubles at t.
/// A trial whose values are not finite is rejected. At each discontinuity the method starts anew.
///
/// Dense output: the quartic of order 4 (Dormand, Prince, Runge-Kutta triples, Comput. Math. Appl. 12 A
/// (1986) 1007-1017), continuously differentiable. Each step gives `refine` equally spaced values of it to
/// observers.
///
/// Tests hold the coefficients to the order conditions of the pair and its dense output (some ten eps), the
/// error of one step to h^6 at its end and h^5 inside (exponents within 0.3), and the errors of Table 4.2 to
/// 1.175e-4 and 1.142e-6.
struct Ode45 {
  static constexpr std::string_view name = "ode45";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                  ///< rtol, from 100 eps = 2.22e-14 to 0.1
  double absolute_tolerance = 1e-9;                  ///< atol, positive
  double initial_step = 0;                           ///< of each segment; 0: chosen from f(t0, x0)
  double largest_step = 0;                           ///< 0: a tenth of the interval
  int refine = 4;                                    ///< values a step for observers, from 1 to 1000
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const Ode45& method);

namespace dormand_prince {

inline constexpr int stages = 7;  ///< the last is the first of the next step

/// Abscissae.
inline constexpr std::array<double, stages> c = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};

/// Row i: weights of the stages before i. The last row is the fifth-order formula itself.
inline constexpr std::array<std::array<double, stages - 1>, stages> a = {
    {{},
     {1. / 5},
     {3. / 40, 9. / 40},
     {44. / 45, -56. / 15, 32. / 9},
     {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
     {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
     {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}}};

/// The rows, each an object of its own, as add_stages() wants them.
template <std::size_t i>
inline constexpr auto row = a[i];

/// Fifth-order minus fourth-order weights.
inline constexpr std::array<double, stages> difference = {
    71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};

/// Row i: coefficients of s, s^2, s^3, s^4 in the weight of stage i at the fraction s of the step.
inline constexpr std::array<std::array<double, 4>, stages> dense = {
    {{1, -183. / 64, 37. / 12, -145. / 128},
     {},
     {0, 1500. / 371, -1000. / 159, 1000. / 371},
     {0, -125. / 32, 125. / 12, -375. / 64},
     {0, 9477. / 3392, -729. / 106, 25515. / 6784},
     {0, -11. / 7, 11. / 3, -55. / 28},
     {0, 3. / 2, -4, 5. / 2}}};

/// Trial steps of the pair, and the dense output of the latest.
template <SystemLike S>
class Pair : public DenseOutputOf<S> {
 public:
  using State = typename S::State;  ///< all components
  /// @param system outlives the pair
  explicit Pair(const S& system) : system_(system), x0_(State::Zero(system.size())), x1_(x0_) {
    for (State& k : k_) k.resize(system.size());
  }

  /// Starts a segment at (t, x): f there is the first stage.
  void begin_segment(double t, double end, const State& x) {
    segment_ = SmoothSegment(t, end);
    x0_ = x;
    system_.rhs(segment_(t), x0_, k_[0]);
  }
  /// Goes from the begin, t, to t1; end_state() and error_of() tell where to.
  void attempt(double t, double t1) {
    t0_ = t;
    h_ = t1 - t;
    [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
      (stage<i + 1>(t, t1), ...);
    }
    (std::make_index_sequence<stages - 1>());
  }
  /// Takes the trial for the begin of the next.
  void accept() {
    std::swap(x0_, x1_);
    std::swap(k_.front(), k_.back());
  }

  /// State at the begin of the trial.
  [[nodiscard]] const State& begin_state() const { return x0_; }
  /// State at the end of the trial.
  [[nodiscard]] const State& end_state() const { return x1_; }
  /// f at the begin.
  [[nodiscard]] const State& begin_derivative() const { return k_.front(); }
  /// Are state and f at the end of the trial finite?
  [[nodiscard]] bool end_is_finite() const { return x1_.allFinite() && k_.back().allFinite(); }

  /// max_i |e_i| / max(|x0_i|, |x1_i|, threshold); NaN if a component is.
  [[nodiscard]] double error_of(double threshold) const {
    double largest = 0;
    for (int i = 0; i < system_.size(); ++i) {
      const double e = weighted<difference, stages>(k_, i);
      const double part = std::abs(h_ * e) / std::max({std::abs(x0_[i]), std::abs(x1_[i]), threshold});
      if (part > largest || std::isnan(part)) largest = part;  // a NaN stays
    }
    return largest;
  }

  /// The quartic; order 4.
  void at(double t, State& x) const override {
    const double s = (t - t0_) / h_;
    x = x0_;
    for (std::size_t i = 0; i < stages; ++i) {
      const auto& w = dense[i];
      x += (h_ * (s * (w[0] + s * (w[1] + s * (w[2] + s * w[3]))))) * k_[i];
    }
  }

 private:
  // The last stage is at the end of the step itself.
  template <std::size_t i>
  [[gnu::always_inline]] void stage(double t, double t1) {
    add_stages<row<i>, i>(x0_, h_, k_, x1_);
    system_.rhs(segment_(c[i] == 1 ? t1 : t + c[i] * h_), x1_, k_[i]);
  }

  const S& system_;
  SmoothSegment segment_;
  std::array<State, stages> k_;
  State x0_, x1_;
  double t0_ = 0, h_ = 1;
};

/// How lengths follow each other on the way from @p t0 to @p t1.
[[nodiscard]] inline StepRule step_rule(double t0, double t1, const Ode45& method) {
  const double interval = std::abs(t1 - t0);
  // A tenth of a very short interval may be less than the shortest step.
  const double largest = method.largest_step > 0
                             ? std::min(interval, method.largest_step)
                             : std::max(interval / 10, 16 * spacing(std::max(std::abs(t0), std::abs(t1))));
  return {.largest = largest, .stretch = 1.1, .again = 0.5, .least_change = 1, .measured = true};
}
/// Of the first step of a stretch that is @p left long, from the state @p x with the slope @p f.
template <class X>
[[nodiscard]] double first_length(const Ode45& method, double largest, double left, const X& x, const X& f) {
  const double length = std::min(largest, left);
  if (method.initial_step > 0) return std::min(length, method.initial_step);
  const double threshold = method.absolute_tolerance / method.relative_tolerance;
  double rate = 0;  // of relative change
  for (int i = 0; i < static_cast<int>(x.size()); ++i)
    rate = std::max(rate, std::abs(f[i]) / std::max(std::abs(x[i]), threshold));
  rate /= 0.8 * std::pow(method.relative_tolerance, 0.2);
  return length * rate > 1 ? 1 / rate : length;
}
/// After a step of length @p taken with the error @p error, in tolerances.
[[nodiscard]] inline double next_length(double taken, double error) {
  return taken / std::max(0.2, 1.25 * std::pow(error, 0.2));
}
/// After the first rejection; a tenth for an error that is NaN.
[[nodiscard]] inline double shorter_length(double taken, double error) {
  return taken * std::max(0.1, 0.8 * std::pow(error, -0.2));
}

/// One integration from begin to end.
template <SystemLike S>
class Run : public AdaptiveStepLoop<S, Run<S>> {
 public:
  /// @param problem outlives the run
  Run(const InitialValueProblemOf<S>& problem, const Ode45& method)
      : Base(problem, Ode45::name, step_rule(problem.t0, problem.t1, method), method.refine),
        method_(method),
        threshold_(method.absolute_tolerance / method.relative_tolerance),
        pair_(problem.system) {}

 private:
  using Base = AdaptiveStepLoop<S, Run>;
  friend Base;
  using Base::control_;
  using Base::now_;

  Status begin(double end) {
    pair_.begin_segment(now_.t, end, now_.x);
    ++now_.statistics.right_hand_sides;
    if (!pair_.begin_derivative().allFinite()) return non_finite_rhs(Ode45::name, now_.t);
    control_.start(first_length(method_, control_.rule().largest, std::abs(end - now_.t), now_.x,
                                pair_.begin_derivative()));
    return {};
  }

  double attempt(double t1) {
    pair_.attempt(now_.t, t1);
    now_.statistics.right_hand_sides += stages - 1;
    return pair_.end_is_finite() ? pair_.error_of(threshold_) / method_.relative_tolerance : nan;
  }
  [[nodiscard]] double shorter(double error) const { return shorter_length(control_.taken(), error); }
  Status accept(double t1, double error) {
    control_.accepted(next_length(control_.taken(), error));
    Status status = this->take(t1, pair_.end_state(), pair_);
    pair_.accept();
    return status;
  }

  const Ode45& method_;
  double threshold_;
  Pair<S> pair_;
};

}  // namespace dormand_prince

/// See integrate().
template <SystemLike S>
[[nodiscard]] SolutionOf<S> run(const InitialValueProblemOf<S>& problem, const Ode45& method) {
  check_options(method);
  return dormand_prince::Run<S>(problem, method).run();
}

/// The library's, for every System.
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Ode45& method);

}  // namespace nlmech::ivp

/// @file
/// The Runge-Kutta method of order 8(5,3) of Dormand and Prince, Hairer and Wanner.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/runge_kutta/dop853_coefficients.hpp"
#include "nlmech/ivp/runge_kutta/weighted.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::ivp {

/// Order 8 in 12 stages, with estimates of orders 5 and 3 (J. R. Dormand, P. J. Prince; E. Hairer, S. P.
/// Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd edition, 1993, sections II.5 and II.10;
/// their code is DOP853).
///  - e5 and e3, the differences of the new state from the formulas of orders 5 and 3, have the norms E =
///    max_i |e_i|/(atol + rtol max(|x0_i|, |x1_i|)); a step is accepted if err = E5 E5/sqrt(E5^2 + E3^2/100)
///    <= 1. It goes with h^8. Largest components, where Hairer's code has means of squares, so that a
///    tolerance means each component, as in the other methods here, however many others are at rest;
///  - the next one is 0.8 err^(-1/8) times as long, or less if the error of the step before says that it
///    grows (StepControl::change()), at least a fifth and at most ten times: over thirteen smooth problems
///    and tolerances from 1e-3 to 1e-13 these take 4 % fewer evaluations than the usual 0.9 and 6, and half
///    as many rejections;
///  - the first one would change the state by (atol + rtol)^(1/8) of its size, and is at most a tenth of the
///    way.
/// A trial is 11 evaluations, an accepted one another, of f at its end, which is the first of the next step.
/// A trial whose values are not finite is rejected. At each discontinuity the method starts anew.
///
/// Dense output: the polynomial of degree 7 (section II.6), of order 7, continuously differentiable. It takes
/// three more evaluations, made when the solution within a step is first asked for, and not otherwise.
///
/// Tests hold the 26 to 30 digits of the coefficients to all 200 order conditions of the formula, to those of
/// both estimates and of the dense output, the error of one step to h^9 at its end and h^8 inside (exponents
/// within 0.3), and errors at tolerances from 1e-6 to 1e-13 to ten tolerances for an oscillator.
struct Dop853 {
  static constexpr std::string_view name = "dop853";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                   ///< rtol, from 0 to 0.1
  double absolute_tolerance = 1e-9;                   ///< atol, positive
  double initial_step = 0;                            ///< of each segment; 0: chosen from f(t0, x0)
  double largest_step = 0;                            ///< 0: the interval
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const Dop853& method);

namespace dop853 {

/// The rows of a, each an object of its own, as weighted() wants them.
template <std::size_t i>
inline constexpr auto row = a[i];
/// The rows of the dense output, likewise.
template <std::size_t i>
inline constexpr auto dense_row = dense[i];

/// Trial steps, and the dense output of the latest.
template <SystemLike S>
class Stepper : public DenseOutputOf<S> {
 public:
  using State = typename S::State;  ///< all components
  /// @param system outlives the stepper
  explicit Stepper(const S& system) : system_(system), x0_(State::Zero(system.size())), x1_(x0_), y_(x0_) {
    for (State& k : k_) k.resize(system.size());
    for (State& r : r_) r.resize(system.size());
  }

  /// Starts a segment at (t, x): f there is the first stage.
  void begin_segment(double t, double end, const State& x) {
    segment_ = SmoothSegment(t, end);
    x0_ = x;
    system_.rhs(segment_(t), x0_, k_[0]);
  }
  /// Goes from the begin, t, to t1; end_state() tells where to. @return the error over the tolerance: NaN if
  /// a component is
  [[nodiscard]] double attempt(double t, double t1, double absolute, double relative) {
    t0_ = t;
    h_ = t1 - t;
    has_dense_ = false;
    const auto all = [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
      (stage<i + 1>(segment_(c[i + 1] == 1 ? t1 : t + c[i + 1] * h_), y_), ...);
    };
    all(std::make_index_sequence<stages - 1>());
    double fifth_norm = 0, third_norm = 0;
    const auto add = [](double& largest, double e) __attribute__((always_inline)) {
      if (e > largest || std::isnan(e)) largest = e;  // a NaN stays
    };
    weighted<row<stages>, stages>(k_, y_);
    weighted<fifth, stages>(k_, r_[0]);
    weighted<third, stages>(k_, r_[1]);
    const Eigen::Index size = x0_.size();
    for (Eigen::Index d = 0; d < size; ++d) {
      const double slope = y_.data()[d], before = x0_.data()[d], after = before + h_ * slope;
      x1_.data()[d] = after;
      const double unit = 1 / (absolute + relative * std::max(std::abs(before), std::abs(after)));
      add(fifth_norm, std::abs(unit * r_[0].data()[d]));
      add(third_norm, std::abs(unit * (slope - r_[1].data()[d])));
    }
    const double square = fifth_norm * fifth_norm + 0.01 * (third_norm * third_norm);
    if (!std::isfinite(square)) return square;
    return square > 0 ? std::abs(h_) * (fifth_norm * fifth_norm) / std::sqrt(square) : 0;
  }
  /// f at the end of the trial, @p t1: the first stage of the next step. @return is it finite?
  [[nodiscard]] bool close(double t1) {
    system_.rhs(segment_(t1), x1_, k_[stages]);
    return k_[stages].allFinite();
  }
  /// Takes the trial for the begin of the next.
  void accept() {
    std::swap(x0_, x1_);
    std::swap(k_[0], k_[stages]);
  }

  /// State at the end of the trial.
  [[nodiscard]] const State& end_state() const { return x1_; }
  /// f at the begin.
  [[nodiscard]] const State& begin_derivative() const { return k_.front(); }
  /// Is the state at the end of the trial finite?
  [[nodiscard]] bool end_is_finite() const { return x1_.allFinite(); }
  /// Has the solution within the trial been asked for?
  [[nodiscard]] bool has_dense() const { return has_dense_; }

  /// The polynomial of degree 7; order 7. The first call after a trial evaluates f three times.
  void at(double t, State& x) const override {
    if (!has_dense_) expand();
    x.resize(x0_.size());
    const double s = (t - t0_) / h_, u = 1 - s;
    for (Eigen::Index d = 0; d < x0_.size(); ++d) {
      const auto r = [&](std::size_t i) { return r_[i].data()[d]; };
      const double inner = r(3) + s * (r(4) + u * (r(5) + s * r(6)));
      x.data()[d] = x0_.data()[d] + s * (r(0) + u * (r(1) + s * (r(2) + u * inner)));
    }
  }

 private:
  template <std::size_t i>
  [[gnu::always_inline]] void stage(double t, State& y) const {
    advance<row<i>, i>(x0_, h_, k_, y);
    system_.rhs(t, y, k_[i]);
  }
  // Coefficients of the dense output.
  void expand() const {
    stage<stages + 1>(segment_(t0_ + c[stages + 1] * h_), y_);
    stage<stages + 2>(segment_(t0_ + c[stages + 2] * h_), y_);
    stage<stages + 3>(segment_(t0_ + c[stages + 3] * h_), y_);
    for (Eigen::Index d = 0; d < x0_.size(); ++d) {
      const double way = x1_[d] - x0_[d], begin = h_ * k_[0][d] - way;
      r_[0][d] = way;
      r_[1][d] = begin;
      r_[2][d] = way - h_ * k_[stages][d] - begin;
      r_[3][d] = h_ * weighted<dense_row<0>, all_stages>(k_, d);
      r_[4][d] = h_ * weighted<dense_row<1>, all_stages>(k_, d);
      r_[5][d] = h_ * weighted<dense_row<2>, all_stages>(k_, d);
      r_[6][d] = h_ * weighted<dense_row<3>, all_stages>(k_, d);
    }
    has_dense_ = true;
  }

  const S& system_;
  SmoothSegment segment_;
  State x0_, x1_;
  double t0_ = 0, h_ = 1;
  // The last three stages and the coefficients r are made by at(), when it is first called.
  mutable std::array<State, all_stages> k_;
  mutable std::array<State, 7> r_;
  mutable State y_;
  mutable bool has_dense_ = false;
};

/// One integration from begin to end.
template <SystemLike S>
class Run : public AdaptiveStepLoop<S, Run<S>> {
 public:
  /// @param problem outlives the run
  Run(const InitialValueProblemOf<S>& problem, const Dop853& method)
      : Base(problem, Dop853::name,
             {.largest = method.largest_step > 0 ? method.largest_step : std::abs(problem.t1 - problem.t0)}),
        method_(method),
        stepper_(problem.system) {}

 private:
  using Base = AdaptiveStepLoop<S, Run>;
  friend Base;
  using Base::control_;
  using Base::now_;

  Status begin(double end) {
    stepper_.begin_segment(now_.t, end, now_.x);
    ++now_.statistics.right_hand_sides;
    if (!stepper_.begin_derivative().allFinite()) return non_finite_rhs(Dop853::name, now_.t);
    control_.start(first_length(std::abs(end - now_.t)));
    return {};
  }

  // The state should not change by more than a share of itself that shrinks with the tolerance as steps do,
  // and where f is 0 the first step should not be all there is.
  [[nodiscard]] double first_length(double left) const {
    const double length = std::min(control_.rule().largest, left);
    if (method_.initial_step > 0) return std::min(length, method_.initial_step);
    const double tolerance = method_.absolute_tolerance + method_.relative_tolerance;
    const double least = method_.absolute_tolerance / tolerance;
    double rate = 0;
    for (Eigen::Index i = 0; i < now_.x.size(); ++i)
      rate = std::max(rate, std::abs(stepper_.begin_derivative()[i]) / std::max(std::abs(now_.x[i]), least));
    rate /= root(std::min(1.0, tolerance));
    return length * rate > 10 ? 1 / rate : length / 10;
  }

  double attempt(double t1) {
    const double error = stepper_.attempt(now_.t, t1, method_.absolute_tolerance, method_.relative_tolerance);
    now_.statistics.right_hand_sides += static_cast<std::int64_t>(stages) - 1;
    if (!stepper_.end_is_finite()) return nan;
    if (!(error <= 1)) return error;
    ++now_.statistics.right_hand_sides;
    return stepper_.close(t1) ? error : nan;
  }
  [[nodiscard]] static double root(double error) { return std::sqrt(std::sqrt(std::sqrt(error))); }
  [[nodiscard]] double shorter(double error) const {
    // A fifth for a NaN.
    return control_.taken() * std::min(0.9, std::max(0.2, 0.9 / root(error)));
  }
  Status accept(double t1, double error) {
    const double now = root(std::max(error, 1e-30));
    control_.accepted(control_.taken() * std::clamp(control_.change(0.8, now, now), 0.2, 10.));
    Status status = this->take(t1, stepper_.end_state(), stepper_);
    if (stepper_.has_dense()) now_.statistics.right_hand_sides += 3;
    stepper_.accept();
    return status;
  }

  const Dop853& method_;
  Stepper<S> stepper_;
};

}  // namespace dop853

/// See integrate().
template <SystemLike S>
[[nodiscard]] SolutionOf<S> run(const InitialValueProblemOf<S>& problem, const Dop853& method) {
  check_options(method);
  return dop853::Run<S>(problem, method).run();
}

/// The library's, for every System.
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Dop853& method);

}  // namespace nlmech::ivp

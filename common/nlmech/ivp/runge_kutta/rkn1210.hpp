/// @file
/// The Runge-Kutta-Nystroem pair of orders 12 and 10 for accelerations that do not depend on velocities.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210_coefficients.hpp"
#include "nlmech/ivp/runge_kutta/weighted.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::ivp {

/// Orders 12 and 10 in 17 stages for q'' = a(t, q) (J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince,
/// High-order embedded Runge-Kutta-Nystroem formulae, IMA J. Numer. Anal. 7 (1987) 423-430), the RKN12(10) of
/// the dissertation; goes on with the values of order 12. A step is accepted if max_i |e_i|/(atol + rtol
/// max(|x0_i|, |x1_i|)) <= 1, e the difference of both orders in positions and velocities; the next one is
/// 0.9 err^(-1/11) times as long, or less if the error of the step before says that it grows, by the factor
/// (h/h') (err'/err)^(1/11) (K. Gustafsson, Control-theoretic techniques for stepsize selection in implicit
/// Runge-Kutta methods, ACM Trans. Math. Software 20 (1994) 496-517), at least 0.2 and at most 4 times. A
/// trial whose values are not finite is rejected. At each discontinuity the method starts anew.
///
/// Accelerations that depend on velocities are refused: before the first step, where the problem is asked
/// with other velocities, by std::invalid_argument; after it, where they show only then, by
/// `outside_validity`.
///
/// Dense output of the same order: a shorter step.
///
/// Tests hold the 30 digits of the coefficients to the quadrature conditions of both orders, and the observed
/// orders to 12 and 10 within 0.6.
struct Rkn1210 {
  static constexpr std::string_view name = "rkn1210";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                    ///< rtol, from 0 to 0.1
  double absolute_tolerance = 1e-9;                    ///< atol, positive
  double initial_step = 0;                             ///< of each segment; 0: chosen from q, v and a
  double largest_step = 0;                             ///< 0: the interval
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const Rkn1210& method);

/// @throws std::invalid_argument saying that the accelerations depend on velocities
[[noreturn]] void refuse_velocities(std::string_view method);

/// The failure `outside_validity` of the same content.
[[nodiscard]] Status depends_on_velocities(std::string_view method, double t);

namespace rkn1210 {

/// The rows of a, each an object of its own, as weighted() wants them.
template <std::size_t i>
inline constexpr auto row = a[i];

/// High less low order.
[[nodiscard]] constexpr Column difference(const Column& high, const Column& low) {
  Column d = {};
  for (std::size_t i = 0; i < stages; ++i) d[i] = high[i] - low[i];
  return d;
}
inline constexpr Column position_error = difference(position, low_position);  ///< of the position's weights
inline constexpr Column velocity_error = difference(velocity, low_velocity);  ///< of the velocity's weights

/// Trial steps of the pair, and the dense output of the latest.
template <SystemLike S>
class Pair : public DenseOutputOf<S> {
 public:
  using State = typename S::State;  ///< all components
  using Half = typename S::Half;    ///< positions or velocities
  /// @param system outlives the pair
  explicit Pair(const S& system)
      : system_(system),
        x0_(State::Zero(system.size())),
        x1_(x0_),
        q0_(Half::Zero(system.size() / 2)),
        v0_(q0_),
        q_(q0_),
        v_(q0_) {
    for (Half& k : k_) k.resize(system.size() / 2);
  }

  /// Starts a segment at (t, x): the acceleration there is the first stage.
  void begin_segment(double t, double end, const State& x) {
    segment_ = SmoothSegment(t, end);
    x0_ = x;
    start(t);
  }
  /// Goes from the begin, t, to t1; end_state() and error_of() tell where to.
  void attempt(double t, double t1) {
    t0_ = t;
    h_ = t1 - t;
    run(t, t1);
    positions(x1_) = q_;
    velocities(x1_) = v_;
  }
  /// Takes the trial, which ended at t1, for the begin of the next.
  void accept(double t1) {
    std::swap(x0_, x1_);
    start(t1);
  }

  /// State at the begin of the trial.
  [[nodiscard]] const State& begin_state() const { return x0_; }
  /// State at the end of the trial.
  [[nodiscard]] const State& end_state() const { return x1_; }
  /// Acceleration at the begin.
  [[nodiscard]] const Half& begin_acceleration() const { return k_.front(); }
  /// Is the state at the end of the trial finite?
  [[nodiscard]] bool end_is_finite() const { return x1_.allFinite(); }
  /// Does the acceleration at the begin, @p t, change with the velocities? Costs two evaluations.
  [[nodiscard]] bool feels_velocities(double t) {
    bool feels = false;
    for (const double factor : {0.0, -1.0}) {
      for (int i = 0; i < v_.size(); ++i) v_[i] = factor * v0_[i] - i - 1;
      system_.acceleration(segment_(t), q0_, v_, k_[1]);
      feels = feels || (k_[1].allFinite() && k_[0].allFinite() && k_[1] != k_[0]);
    }
    return feels;
  }

  /// max_i |e_i|/(atol + rtol max(|x0_i|, |x1_i|)); NaN if a component is.
  [[nodiscard]] double error_of(double absolute, double relative) const {
    double largest = 0;
    const auto add = [&](double e, double before, double after) {
      const double part = std::abs(e) / (absolute + relative * std::max(std::abs(before), std::abs(after)));
      if (part > largest || std::isnan(part)) largest = part;  // a NaN stays
    };
    const Eigen::Index m = q_.size();
    for (Eigen::Index d = 0; d < m; ++d) {
      add(h_ * h_ * weighted<position_error, stages>(k_, d), x0_[d], x1_[d]);
      add(h_ * weighted<velocity_error, stages>(k_, d), x0_[m + d], x1_[m + d]);
    }
    return largest;
  }

  /// A step of the length t - t0 from the begin of the latest step; order 12.
  void at(double t, State& x) const override {
    Pair shorter(*this);
    shorter.run(t0_, t);
    x.resize(x0_.size());
    positions(x) = shorter.q_;
    velocities(x) = shorter.v_;
  }

 private:
  void start(double t) {
    q0_ = positions(x0_);
    v0_ = velocities(x0_);
    system_.acceleration(segment_(t), q0_, v0_, k_[0]);
  }
  // The last stage before is the last to be known: what does not need it is added up first.
  template <std::size_t i>
  [[gnu::always_inline]] void stage(double t, double t1, double h) {
    const double square = h * h;
    const Eigen::Index m = q_.size();
    for (Eigen::Index d = 0; d < m; ++d) {
      double q = q0_.data()[d] + c[i] * h * v0_.data()[d];
      if constexpr (i > 1) q += square * weighted<row<i>, i - 1>(k_, d);
      q_.data()[d] = q + square * a[i][i - 1] * k_[i - 1].data()[d];
    }
    system_.acceleration(segment_(c[i] == 1 ? t1 : t + c[i] * h), q_, v0_, k_[i]);
  }
  // Leads to q_ and v_.
  void run(double t, double t1) {
    const double h = t1 - t;
    const auto all = [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
      (stage<i + 1>(t, t1, h), ...);
    };
    all(std::make_index_sequence<stages - 1>());
    const Eigen::Index m = q_.size();
    for (Eigen::Index d = 0; d < m; ++d) {
      q_.data()[d] = q0_.data()[d] + h * v0_.data()[d] + h * h * weighted<position, stages>(k_, d);
      v_.data()[d] = v0_.data()[d] + h * weighted<velocity, stages>(k_, d);
    }
  }

  const S& system_;
  SmoothSegment segment_;
  std::array<Half, stages> k_;
  State x0_, x1_;
  Half q0_, v0_, q_, v_;
  double t0_ = 0, h_ = 1;
};

/// One integration from begin to end.
template <SystemLike S>
class Run : public AdaptiveStepLoop<S, Run<S>> {
 public:
  /// @param problem outlives the run
  Run(const InitialValueProblemOf<S>& problem, const Rkn1210& method)
      : Base(problem, Rkn1210::name,
             {.largest = method.largest_step > 0 ? method.largest_step : std::abs(problem.t1 - problem.t0)}),
        method_(method),
        pair_(problem.system) {}

 private:
  using Base = AdaptiveStepLoop<S, Run>;
  friend Base;
  using Base::control_;
  using Base::now_;

  Status begin(double end) {
    pair_.begin_segment(now_.t, end, now_.x);
    ++now_.statistics.right_hand_sides;
    if (!pair_.begin_acceleration().allFinite()) return non_finite_rhs(Rkn1210::name, now_.t);
    if (now_.statistics.steps == 0) {
      now_.statistics.right_hand_sides += 2;
      if (pair_.feels_velocities(now_.t)) refuse_velocities(Rkn1210::name);
    }
    control_.start(first_length(std::abs(end - now_.t)));
    return {};
  }

  // The state should not change by more than a share of itself that shrinks with the tolerance as steps do.
  [[nodiscard]] double first_length(double left) const {
    const double length = std::min(control_.rule().largest, left);
    if (method_.initial_step > 0) return std::min(length, method_.initial_step);
    const double tolerance = method_.absolute_tolerance + method_.relative_tolerance;
    const double least = method_.absolute_tolerance / tolerance;
    const auto m = now_.x.size() / 2;
    double rate = 0;
    for (Eigen::Index i = 0; i < m; ++i) {
      const double q = std::max(std::abs(now_.x[i]), least), v = std::max(std::abs(now_.x[m + i]), least);
      rate = std::max({rate, std::abs(now_.x[m + i]) / q, std::abs(pair_.begin_acceleration()[i]) / v});
    }
    rate /= 2 * std::pow(std::min(1.0, tolerance), 1. / 12);
    return length * rate > 1 ? 1 / rate : length;
  }

  double attempt(double t1) {
    pair_.attempt(now_.t, t1);
    now_.statistics.right_hand_sides += static_cast<std::int64_t>(stages) - 1;
    if (!pair_.end_is_finite()) return nan;
    return pair_.error_of(method_.absolute_tolerance, method_.relative_tolerance);
  }
  [[nodiscard]] double shorter(double error) const {
    // 0.2 for a NaN.
    return control_.taken() * std::min(0.9, std::max(0.2, 0.9 * std::pow(error, -1. / 11)));
  }
  Status accept(double t1, double error) {
    const double root = std::pow(std::max(error, 1e-30), 1. / 11);
    control_.accepted(control_.taken() * std::clamp(control_.change(0.9, root, root), 0.2, 4.));
    Status status = this->take(t1, pair_.end_state(), pair_);
    pair_.accept(t1);
    ++now_.statistics.right_hand_sides;
    if (status.ok() && now_.statistics.steps == 1 && t1 != this->problem_.t1) {
      now_.statistics.right_hand_sides += 2;
      if (pair_.feels_velocities(t1)) status = depends_on_velocities(Rkn1210::name, t1);
    }
    return status;
  }

  const Rkn1210& method_;
  Pair<S> pair_;
};

}  // namespace rkn1210

/// See integrate().
template <SystemLike S>
[[nodiscard]] SolutionOf<S> run(const InitialValueProblemOf<S>& problem, const Rkn1210& method) {
  check_options(method);
  require_accelerations(method.name, problem.system);
  return rkn1210::Run<S>(problem, method).run();
}

/// The library's, for every System.
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Rkn1210& method);

}  // namespace nlmech::ivp

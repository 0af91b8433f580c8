/// @file
/// Embedded explicit Runge-Kutta methods: one integrator for all; a method is a tableau.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/runge_kutta/weighted.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/program/interval.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::ivp {

/// Rule for the first step of a smooth segment: no component changes by more than `change` times its size,
/// and the step size is at most 1/`parts` of the segment.
struct FirstStep {
  double floor = 0;   ///< smallest size of a component
  double change = 0;  ///< relative change
  double parts = 1;   ///< 1 or more
};

/// A trial step of the pair @p P for the system @p S.
template <class S, class P>
struct TrialStep {
  using State = typename S::State;                                           ///< all components
  using Slope = std::conditional_t<P::is_nystrom, typename S::Half, State>;  ///< f, or the acceleration
  static constexpr std::size_t end = P::a.size() - 1 - P::dense_stages;  ///< index of the stage at the end

  /// For states of @p size components.
  explicit TrialStep(int size) : x0(State::Zero(size)), x1(x0) {
    for (Slope& each : k) each.resize(P::is_nystrom ? size / 2 : size);
    for (State& each : r) each.resize(size);
  }
  State x0;                          ///< state at the start
  State x1;                          ///< state at the end
  std::array<Slope, P::a.size()> k;  ///< slopes at the stages
  std::array<State, P::coefficients>
      r;          ///< coefficients of expand() for at(); before that, workspace of finish()
  double t0 = 0;  ///< time of the start
  double h = 1;   ///< step size, signed
};

/// Bounds on c + s x for all s from 0 to 1 and all x of @p x: a step of Horner's rule for all times of a
/// step.
[[nodiscard]] inline program::Interval plus_part(double c, const program::Interval& x) {
  return {c + std::min(0., x.low), c + std::max(0., x.high)};
}

/// Sets @p largest to the larger of both; NaN if one is NaN.
[[gnu::always_inline]] inline void enlarge(double& largest, double value) {
  if (value > largest || std::isnan(value)) largest = value;
}

/// Row @p i of the tableau of the pair @p P, as an object for weighted().
template <class P, std::size_t i>
inline constexpr auto stage_weights = P::a[i];

/// A pair of explicit Runge-Kutta formulas, the second of which estimates the error of the first. A pair @p P
/// derives from this and has
///  - `c`: the abscissae of the stages; the last stage is at the end of the step, 1;
///  - `a`: row i has the weights of the stages before stage i; the last row is the first formula;
///  - `error_weights`: weights of the first formula minus those of the second; without that of the last stage
///    if it is 0: f at the end is then evaluated for accepted steps only;
///  - `order`: the error estimate is proportional to h^order.
///
/// A pair may replace the defaults below by members of the same name.
///
/// Tests with two pairs without other members, of orders 3 and 2, assert errors of one step and of its dense
/// output of h^4 (exponents within 0.3) and of a run of h^3 (within 0.1), and for an oscillator after 10
/// units of time, at tolerances from 1e-4 to 1e-8, an error below the tolerance times the number of steps.
template <class P>
struct EmbeddedPair {
  /// The trial step.
  template <class S>
  using Trial = TrialStep<S, P>;
  static constexpr bool is_nystrom = false;  ///< true for NystromPair
  /// Argument of a stage: x + (h a0) k0 + (h a1) k1 + ... if true, otherwise x + h (a0 k0 + a1 k1 + ...).
  /// Both differ by rounding.
  static constexpr bool step_times_weights = false;
  static constexpr std::size_t dense_stages = 0;  ///< number of last rows of a and c for dense output only
  static constexpr std::size_t coefficients = 0;  ///< number of vectors for dense output
  static constexpr double least_relative_tolerance = 0;  ///< smallest rtol
  static constexpr double safety = 0.9;                  ///< safety factor of the step size
  static constexpr double most_growth = 5;               ///< largest factor on the step size

  /// Constants of the step control from @p t0 to @p t1.
  [[nodiscard]] static StepRule step_rule(const auto& method, double t0, double t1) {
    return {.largest = method.largest_step > 0 ? method.largest_step : std::abs(t1 - t0)};
  }
  /// The state changes by (atol + rtol)^(1/order) of its size in the first step, which is at most a tenth of
  /// the segment, also for f = 0 at the start.
  [[nodiscard]] static FirstStep first_step(const auto& method) {
    const double tolerance = method.absolute_tolerance + method.relative_tolerance;
    return {method.absolute_tolerance / tolerance, P::root(std::min(1.0, tolerance)), 10};
  }
  /// error^(1/order).
  [[nodiscard]] static double root(double error) { return std::pow(error, 1. / P::order); }
  /// Step size after an accepted step with @p error in tolerances: by StepControl::change(), at least a fifth
  /// of the accepted step size.
  [[nodiscard]] static double next_length(StepControl& control, double error) {
    const double now = P::root(std::max(error, 1e-30));
    return control.taken() * std::clamp(control.change(P::safety, now, now), 0.2, P::most_growth);
  }
  /// Step size of the trial after a rejected one of size @p taken; a fifth of it if the error is NaN.
  [[nodiscard]] static double shorter_length(double taken, double error) {
    return taken * std::min(0.9, std::max(0.2, 0.9 / P::root(error)));
  }

  /// Evaluates the first stage, at the start.
  template <class S>
  static void start(const S& system, double time, TrialStep<S, P>& step) {
    system.rhs(time, step.x0, step.k[0]);
  }
  /// Evaluates stage @p i.
  template <std::size_t i, class S>
  [[gnu::always_inline]] static void stage(const S& system, double time, TrialStep<S, P>& step) {
    auto& x = i > step.end ? step.r[0] : step.x1;
    if constexpr (P::step_times_weights)
      add_stages<stage_weights<P, i>, i>(step.x0, step.h, step.k, x);
    else
      advance<stage_weights<P, i>, i>(step.x0, step.h, step.k, x);
    system.rhs(time, x, step.k[i]);
  }
  /// max_i |f_i|/max(|x_i|, floor) at the start.
  template <class S>
  [[nodiscard]] static double rate(const TrialStep<S, P>& step, double floor) {
    double rate = 0;
    for (Eigen::Index i = 0; i < step.x0.size(); ++i)
      rate = std::max(rate, std::abs(step.k[0][i]) / std::max(std::abs(step.x0[i]), floor));
    return rate;
  }
  /// Writes the state at the end of the trial unless the last stage has done so.
  /// @return the error in tolerances, max_i |e_i|/(atol + rtol max(|x0_i|, |x1_i|)); NaN if a component is
  /// NaN
  template <class S>
  [[nodiscard]] static double finish(TrialStep<S, P>& step, const auto& method) {
    constexpr std::size_t stages = P::error_weights.size(), end = TrialStep<S, P>::end;
    if constexpr (stages == end) advance<stage_weights<P, end>, end>(step.x0, step.h, step.k, step.x1);
    const double absolute = method.absolute_tolerance, relative = method.relative_tolerance;
    double largest = 0;
    for (Eigen::Index i = 0; i < step.x0.size(); ++i) {
      const double size = std::max(std::abs(step.x0[i]), std::abs(step.x1[i]));
      enlarge(largest, std::abs(step.h * weighted<P::error_weights, stages>(step.k, i)) /
                           (absolute + relative * size));
    }
    return largest;
  }
  /// Bounds on x - x0 of the dense output within the step, component @p i.
  template <class S>
  [[nodiscard]] static program::Interval change(const TrialStep<S, P>& step, Eigen::Index i) {
    const double change = step.x1[i] - step.x0[i], quarter = step.h / 4;
    const double a = quarter * step.k[0][i], b = -quarter * step.k[step.end][i];
    return {std::min(0., change) + std::min({0., a, b}), std::max(0., change) + std::max({0., a, b})};
  }
  /// Dense output: cubic Hermite interpolation, of order 3.
  template <class S>
  static void at(const TrialStep<S, P>& step, double t, typename S::State& x) {
    const double h = step.h, s = (t - step.t0) / h, u = 1 - s;
    x = (u * u * (1 + 2 * s)) * step.x0 + (s * s * (3 - 2 * s)) * step.x1 + (h * s * u * u) * step.k[0] -
        (h * s * s * u) * step.k[step.end];
  }
};

/// Options of a method: an aggregate with a name, a pair, tolerances, `initial_step` (of each segment; 0: by
/// FirstStep) and `largest_step` (0: by the pair). A member `refine` is the number of equally spaced output
/// points per step for observers.
template <class M>
concept EmbeddedMethod = requires {
  M::Pair::order;
};

/// @throws std::invalid_argument naming an option out of range and its value
/// @{
void check_embedded_options(std::string_view name, double least_relative_tolerance, double relative_tolerance,
                            double absolute_tolerance, double initial_step, double largest_step);
template <EmbeddedMethod M>
void check_options(const M& m) {
  check_embedded_options(M::name, M::Pair::least_relative_tolerance, m.relative_tolerance,
                         m.absolute_tolerance, m.initial_step, m.largest_step);
  if constexpr (requires { m.refine; }) require_within(M::name, "refine", m.refine, 1, 1000);
}
/// @}

/// One integration by a pair, and the dense output of its latest step.
template <SystemLike S, EmbeddedMethod M>
class EmbeddedRungeKutta : public AdaptiveStepLoop<S, EmbeddedRungeKutta<S, M>>, public DenseOutputOf<S> {
 public:
  using State = typename S::State;  ///< all components
  /// @param problem outlives the integration
  /// @param method outlives the integration
  EmbeddedRungeKutta(const InitialValueProblemOf<S>& problem, const M& method)
      : Base(problem, M::name, Pair::step_rule(method, problem.t0, problem.t1), refine_of(method)),
        method_(method),
        system_(problem.system),
        trial_(problem.system.size()) {}

  /// The first call after a step evaluates the stages for dense output, if there are any.
  void at(double t, State& x) const override {
    if constexpr (Pair::is_nystrom) {  // a shorter step, which overwrites the stages
      trial_.h = t - trial_.t0;
      evaluate<1>(t, std::make_index_sequence<stages - 1>());
      Pair::state(trial_, x);
    } else {
      expand();
      Pair::at(trial_, t, x);
    }
  }
  /// A Nystrom pair's is a shorter step.
  [[nodiscard]] bool is_as_accurate_as_step() const override { return Pair::is_nystrom; }
  /// See at().
  bool bound_change(double /*t1*/, [[maybe_unused]] State& least,
                    [[maybe_unused]] State& most) const override {
    if constexpr (!Pair::is_nystrom) {
      expand();
      least.resize(trial_.x0.size());
      most.resize(trial_.x0.size());
      for (Eigen::Index i = 0; i < most.size(); ++i) {
        const program::Interval change = Pair::change(trial_, i);
        least[i] = change.low;
        most[i] = change.high;
      }
    }
    return !Pair::is_nystrom;
  }

 private:
  using Base = AdaptiveStepLoop<S, EmbeddedRungeKutta>;
  friend Base;
  using Base::control_;
  using Base::now_;
  using Pair = typename M::Pair;
  using Trial = typename Pair::template Trial<S>;
  static constexpr std::size_t end = Trial::end, stages = Pair::error_weights.size();
  static_assert(stages == end || stages == end + 1);

  [[nodiscard]] static int refine_of(const M& method) {
    if constexpr (requires { method.refine; })
      return method.refine;
    else
      return 1;
  }
  // Evaluates stages of a step to t1. A stage at the end is evaluated at t1: t0 + h may be another double.
  template <std::size_t from, std::size_t... i>
  [[gnu::always_inline]] void evaluate(double t1, std::index_sequence<i...>) const {
    (Pair::template stage<from + i>(
         system_, segment_(Pair::c[from + i] == 1 ? t1 : trial_.t0 + Pair::c[from + i] * trial_.h), trial_),
     ...);
  }
  void expand() const {
    if constexpr (Pair::dense_stages > 0) {
      if (std::exchange(has_dense_, true)) return;
      evaluate<end + 1>(trial_.t0 + trial_.h, std::make_index_sequence<Pair::dense_stages>());
      Pair::expand(trial_);
    }
  }
  void start(double t) {
    Pair::start(system_, segment_(t), trial_);
    ++now_.statistics.right_hand_sides;
  }

  Status begin(double segment_end) {
    segment_ = SmoothSegment(now_.t, segment_end);
    trial_.x0 = now_.x;
    start(now_.t);
    if (!trial_.k[0].allFinite()) return non_finite_rhs(M::name, now_.t);
    if constexpr (Pair::is_nystrom) {
      if (now_.statistics.steps == 0 && uses_velocities(now_.t)) refuse_velocities(M::name);
    }
    control_.start(first_length(std::abs(segment_end - now_.t)));
    return {};
  }
  [[nodiscard]] double first_length(double left) const {
    const double length = std::min(control_.rule().largest, left);
    if (method_.initial_step > 0) return std::min(length, method_.initial_step);
    const FirstStep first = Pair::first_step(method_);
    const double rate = Pair::rate(trial_, first.floor) / first.change;
    return length * rate > first.parts ? 1 / rate : length / first.parts;
  }

  double attempt(double t1) {
    const double error = trial(t1);
    now_.statistics.right_hand_sides += static_cast<std::int64_t>(stages) - 1;
    if (!trial_.x1.allFinite()) return nan;
    if constexpr (Pair::is_nystrom) return error;
    if constexpr (stages == end) {
      if (!(error <= 1)) return error;
      system_.rhs(segment_(t1), trial_.x1, trial_.k[end]);
      ++now_.statistics.right_hand_sides;
    }
    return trial_.k[end].allFinite() ? error : nan;
  }
  [[nodiscard]] double trial(double t1) {
    trial_.t0 = now_.t;
    trial_.h = t1 - now_.t;
    has_dense_ = false;
    evaluate<1>(t1, std::make_index_sequence<stages - 1>());
    return Pair::finish(trial_, method_);
  }
  [[nodiscard]] double shorter(double error) const { return Pair::shorter_length(control_.taken(), error); }
  Status accept(double t1, double error) {
    control_.accepted(Pair::next_length(control_, error));
    Status status = this->take(t1, trial_.x1, *this);
    if (has_dense_) now_.statistics.right_hand_sides += static_cast<std::int64_t>(Pair::dense_stages);
    std::swap(trial_.x0, trial_.x1);
    if constexpr (Pair::is_nystrom) {
      start(t1);
      const bool is_first = now_.statistics.steps == 1 && t1 != this->problem_.t1;
      if (status.ok() && is_first && uses_velocities(t1)) status = depends_on_velocities(M::name, t1);
    } else {
      std::swap(trial_.k[0], trial_.k[end]);
    }
    return status;
  }
  [[nodiscard]] bool uses_velocities(double t) {
    now_.statistics.right_hand_sides += 2;
    return Pair::uses_velocities(system_, segment_(t), trial_);
  }

  const M& method_;
  const S& system_;
  SmoothSegment segment_;
  mutable Trial trial_;  // at() evaluates stages
  mutable bool has_dense_ = false;
};

/// See integrate().
template <SystemLike S, EmbeddedMethod M>
[[nodiscard]] SolutionOf<S> run(const InitialValueProblemOf<S>& problem, const M& method) {
  check_options(method);
  if constexpr (M::Pair::is_nystrom) require_accelerations(M::name, problem.system);
  return EmbeddedRungeKutta<S, M>(problem, method).run();
}

}  // namespace nlmech::ivp

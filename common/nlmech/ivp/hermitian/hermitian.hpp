/// @file
/// Integration by Hermitian operators: single steps with accelerations and jerks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/hermitian/hermitian_trial.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::ivp {

/// Hermite-Obreshkov steps for q'' = a(t, q, v) by two operators of Table 1 of J. E. Laier, High-order
/// algorithm for non-linear dynamics. Implicit; the 2m equations for positions and velocities are solved by
/// Newton's iteration, acceleration, jerk and their exact derivatives taken from the problem by dual numbers.
///
/// Order: order_of(solved_for_end(operators)), 4 for Laier and Argyris, 2 for the others, which are one
/// method and the one that Newmark{} is. On linear problems all but Argyris are stable for every step and
/// keep the spectral radius 1 where nothing damps: fast parts that a step does not resolve neither grow nor
/// decay.
///
/// A converged Newton iteration does not tell that its root continues the solution. Each step is therefore
/// held to two operators of order 6, one of which asks the problem in the middle of the step; what they leave
/// is the estimate of the error.
///  - With a `step`, a step whose estimate, as a displacement, is more than `branch_tolerance` of the
///    displacements ends the integration with `wrong_branch`, if stiffness times h^2 or damping times h
///    change by more than 3 over it. On linear problems, where a step has one root only, it never does.
///  - Without, steps are chosen: accepted if max_i |e_i| / (atol + rtol max(|x0_i|, |x1_i|)) <= 1. The
///    next one is longer or shorter by 0.9 err^(-1/(p + 1)), at least 0.2 and at most 5 times; a step that
///    is not solved is quartered. Where h^2 |a_q| > 2, and if it is a first one or more than twice as long as
///    the one before, a step must pass a second estimate, which vanishes on no oscillation however long the
///    step: see HermitianTrial::unresolved(). It is the error of a step that is held
///    (Controlled::local_error): at the end there are those of all steps, times the problem's condition.
///    Where the estimates add up to a hundredth of the state and ten thousand tolerances, the run ends with
///    `not_converged`.
///
/// Steps end on announced discontinuities. Dense output: the quintic of both ends with accelerations, of the
/// method's order. Statistics::right_hand_sides counts a and j apart: two a Newton iteration, three a step
/// more.
///
/// Tests hold every row to its order (observed within 0.15), runs there and back to 1e-11, the linear
/// oscillator to no growth for h omega up to 1e6, chosen steps to 2000 tolerances, and van der Pol's jumps to
/// a status wherever an end is wrong.
struct Hermitian {
  static constexpr std::string_view name = "hermitian";  ///< the family; a run's messages name the operators
  HermitianPair operators = laier;                       ///< a row of hermitian_table, or another pair
  double step = 0;                                       ///< length of a step; 0: chosen
  double relative_tolerance = 1e-9;                      ///< rtol where steps are chosen, from 1e-14 to 0.1
  double absolute_tolerance = 1e-9;                      ///< atol, positive
  double branch_tolerance = 0.1;                         ///< see above; positive; infinity: never
  algebraic::Newton newton = {};                         ///< solves each step's equations
};

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const Hermitian& method);

namespace hermitian {

/// The estimate of a converged step is of the size of the step: wrong_branch.
[[nodiscard]] Status wrong_branch(std::string_view method, double t, double step, double estimate);

/// The errors of all steps together may be far above the tolerance: not_converged.
[[nodiscard]] Status errors_add_up(std::string_view method, double t, std::int64_t steps, double sum);

/// Steps of fixed length.
template <SystemLike S>
class FixedStepper : public Stepper<S::dimension> {
 public:
  static constexpr int n = S::dimension;  ///< components of the state

  /// @param task outlives the stepper
  FixedStepper(const Task<S>& task, const Hermitian& method)
      : Stepper<n>(task.system.size()),
        method_(method),
        trial_(task.system, method.operators, method.newton) {}

  /// Of the operators.
  [[nodiscard]] std::string_view name() const { return method_.operators.name; }
  /// See Stepper.
  void begin_segment(double begin, double end) {
    begin_ = begin;
    end_ = end;
    is_new_ = true;
  }
  /// From t to t + h.
  Status step(double t, double h, const State<n>& x0, State<n>& x1, Statistics& statistics) {
    if (std::exchange(is_new_, false)) {
      if (!trial_.begin_segment(begin_, end_, x0, statistics)) return non_finite_rhs(name(), t);
    } else {
      trial_.accept();
    }
    const std::int64_t before = statistics.newton_iterations;
    const Outcome outcome = trial_.attempt(t, h, statistics);
    if (outcome != Outcome::success)
      return step_not_solved(name(), outcome, t, h, static_cast<int>(statistics.newton_iterations - before));
    const double estimate = trial_.relative_displacement();
    if (estimate > method_.branch_tolerance && trial_.nonlinearity(statistics) > 3)
      return wrong_branch(name(), t, h, estimate);
    x1 = trial_.end_state();
    return {};
  }
  /// Within the latest step.
  void at(double t, State<n>& x) const override { trial_.at(t, x); }

 private:
  const Hermitian& method_;
  HermitianTrial<S> trial_;
  double begin_ = 0, end_ = 0;
  bool is_new_ = true;
};

/// Steps of chosen length: one integration from begin to end.
template <SystemLike S>
class Run : public ChosenSteps<S, Run<S>> {
 public:
  /// @param task outlives the run
  Run(const Task<S>& task, const Hermitian& method)
      : Base(task, method.operators.name, {.shortest = 0, .kept_from = HUGE_VAL, .measured = true}),
        method_(method),
        exponent_(-1.0 / (order_of(solved_for_end(method.operators)) + 1)),
        trial_(task.system, method.operators, method.newton) {}

 private:
  using Base = ChosenSteps<S, Run>;
  friend Base;
  using Base::control_;
  using Base::now_;

  [[nodiscard]] std::string_view name() const { return method_.operators.name; }

  // Errors of the steps that leave nothing of the tolerance: of the state, and in tolerances.
  static constexpr double most_share = 0.01, most_tolerances = 1e4;

  Status begin(double end) {
    if (!trial_.begin_segment(now_.t, end, now_.x, now_.statistics)) return non_finite_rhs(name(), now_.t);
    control_.start(first_length(std::abs(end - now_.t)));
    before_ = 0;
    return {};
  }

  // The time in which the state would change by a tenth of its size, shortened with the tolerance.
  [[nodiscard]] double first_length(double interval) const {
    const State<Base::n>& f = trial_.begin_derivative();
    double rate = 0;
    for (int i = 0; i < f.size(); ++i)
      rate = std::max(rate, std::abs(f[i]) / (method_.absolute_tolerance / method_.relative_tolerance +
                                              std::abs(now_.x[i])));
    const double share = std::pow(method_.relative_tolerance, -exponent_);
    return rate * interval > share ? share / rate : interval;
  }

  double attempt(double t1) {
    outcome_ = trial_.attempt(now_.t, t1 - now_.t, now_.statistics);
    if (outcome_ != Outcome::success) return nan;
    const double atol = method_.absolute_tolerance, rtol = method_.relative_tolerance;
    const double error = trial_.error_of(atol, rtol);
    if (!(error <= 1)) return error;
    const bool is_new = control_.taken() > 2 * before_;  // of a length that has not been tried
    // A tenth: what a stiff motion rings with, tolerances of it, neither grows nor decays.
    const double unresolved = trial_.unresolved(atol, rtol, is_new, now_.statistics) / 10;
    return unresolved <= error ? error : unresolved;  // keeps a NaN
  }

  // An error of zero allows any step; the next but five times as long.
  [[nodiscard]] double change(double error) const {
    return std::clamp(0.9 * std::pow(error, exponent_), 0.2, 5.0);
  }
  [[nodiscard]] double shorter(double error) const {
    return control_.taken() * (std::isnan(error) ? 0.25 : std::min(change(error), 0.9));
  }
  [[nodiscard]] Status missed(double t1, double error) const {
    if (outcome_ == Outcome::success) return Base::missed(t1, error);
    return step_not_solved(name(), outcome_, now_.t, t1 - now_.t, method_.newton.iterations);
  }
  Status accept(double t1, double error) {
    total_ += error;
    before_ = control_.taken();
    control_.accepted(control_.taken() * change(error));
    Status status = this->take(t1, trial_.end_state(), trial_);
    trial_.accept();
    const double sum = method_.relative_tolerance * total_;
    if (status.ok() && sum > most_share && total_ > most_tolerances)
      return errors_add_up(name(), t1, now_.statistics.steps, sum);
    return status;
  }

  const Hermitian& method_;
  double exponent_, before_ = 0, total_ = 0;
  Outcome outcome_ = Outcome::success;
  HermitianTrial<S> trial_;
};

}  // namespace hermitian

/// Runs the operators.
template <SystemLike S>
struct Integrator<S, Hermitian> {
  /// See integrate(). @throws std::invalid_argument also for a problem without accelerations or written for
  /// double alone
  static Solution<S::dimension> run(const Task<S>& task, const Hermitian& method) {
    check_options(method);
    require_accelerations(method.operators.name, task.system);
    if (method.step > 0) {
      hermitian::FixedStepper<S> stepper(task, method);
      return walk(task, method.step, stepper);
    }
    return hermitian::Run<S>(task, method).run();
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<Hermitian> = InLibrary::even;
/// @endcond

}  // namespace nlmech::ivp

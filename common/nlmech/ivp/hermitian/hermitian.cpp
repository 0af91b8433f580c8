#include "nlmech/ivp/hermitian/hermitian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/chosen_steps.hpp"
#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/hermitian/hermitian_operators.hpp"
#include "nlmech/ivp/hermitian/hermitian_trial.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/second_order.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::ivp {

void check_options(const Hermitian& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::string_view name = method.operators.name;
  require_within(name, "step", method.step, 0, largest);
  require_within(name, "relative_tolerance", method.relative_tolerance, 1e-14, 0.1);
  require_within(name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(name, "branch_tolerance", method.branch_tolerance, least, infinity);
}

namespace {

Status wrong_branch(std::string_view method, double t, double step, double estimate) {
  return Status::failure(
      Outcome::wrong_branch,
      fmt::format("{}: Newton's iteration of the step of {:.6g} from t = {:.17g} converged, but the error "
                  "estimate is {:.2g} of the displacement: its root need not continue the solution; take a "
                  "smaller step, or a tolerance instead",
                  method, step, t, estimate));
}

Status errors_add_up(std::string_view method, double t, std::int64_t steps, double sum) {
  return Status::failure(
      Outcome::not_converged,
      fmt::format(
          "{}: each of {} steps to t = {:.17g} is within the tolerance, but their errors may add up to "
          "{:.2g} of the state; take a smaller tolerance",
          method, steps, t, sum));
}

/// Stepper of fixed step size.
class HermitianSteps : public Stepper {
 public:
  /// @param problem outlives the stepper
  HermitianSteps(const InitialValueProblem& problem, const Hermitian& method)
      : Stepper(problem.system.size()),
        method_(method),
        trial_(problem.system, method.operators, method.newton) {}

  /// Name of the operators.
  [[nodiscard]] std::string_view name() const { return method_.operators.name; }
  /// See Stepper.
  void begin_segment(double begin, double end) {
    begin_ = begin;
    end_ = end;
    is_new_ = true;
  }
  /// Integrates from t to t + h.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
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
  /// Dense output of the latest step.
  void at(double t, State& x) const override { trial_.at(t, x); }

 private:
  const Hermitian& method_;
  HermitianTrial trial_;
  double begin_ = 0, end_ = 0;
  bool is_new_ = true;
};

/// One integration with adaptive steps.
class HermitianRun : public AdaptiveStepLoop<System, HermitianRun> {
 public:
  /// @param problem outlives the run
  HermitianRun(const InitialValueProblem& problem, const Hermitian& method)
      : Base(problem, method.operators.name, {.shortest = 0, .kept_from = HUGE_VAL, .measured = true}),
        method_(method),
        exponent_(-1.0 / (order_of(solved_for_end(method.operators)) + 1)),
        trial_(problem.system, method.operators, method.newton) {}

 private:
  using Base = AdaptiveStepLoop<System, HermitianRun>;
  friend Base;
  using Base::control_;
  using Base::now_;

  [[nodiscard]] std::string_view name() const { return method_.operators.name; }

  // Limits on the sum of the error estimates: relative to the state, and in tolerances.
  static constexpr double most_share = 0.01, most_tolerances = 1e4;

  Status begin(double end) {
    if (!trial_.begin_segment(now_.t, end, now_.x, now_.statistics)) return non_finite_rhs(name(), now_.t);
    control_.start(first_length(std::abs(end - now_.t)));
    before_ = 0;
    return {};
  }

  // First step size: the time in which the state changes by a tenth of its size, reduced with the tolerance.
  [[nodiscard]] double first_length(double interval) const {
    const State& f = trial_.begin_derivative();
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
    const bool is_new = control_.taken() > 2 * before_;  // a step size that has not been tried
    // A tenth: unresolved stiff oscillations of some tolerances neither grow nor decay.
    const double unresolved = trial_.unresolved(atol, rtol, is_new, now_.statistics) / 10;
    return unresolved <= error ? error : unresolved;  // keeps a NaN
  }

  // Factor on the step size, from 0.2 to 5; 5 for an error of zero.
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
  HermitianTrial trial_;
};

}  // namespace

Solution run(const InitialValueProblem& problem, const Hermitian& method) {
  check_options(method);
  require_accelerations(method.operators.name, problem.system);
  if (method.step > 0) {
    HermitianSteps stepper(problem, method);
    return integrate_fixed_steps(problem, method.step, stepper);
  }
  return HermitianRun(problem, method).run();
}

}  // namespace nlmech::ivp

#include "nlmech/ivp/implicit/backward_euler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/named/fixed_steps.hpp"
#include "nlmech/ivp/smooth_segment.hpp"

namespace nlmech::ivp {

namespace {

/// Stepper of the backward Euler method.
class BackwardEulerStepper : public Stepper {
 public:
  /// @param system outlives the stepper
  BackwardEulerStepper(const System& system, const algebraic::Newton& newton)
      : Stepper(system.size()),
        system_(system),
        newton_(newton),
        x0_(system.size()),
        x1_(system.size()),
        f_(system.size()),
        workspace_(system.size()) {}
  /// Name of the method.
  [[nodiscard]] static std::string_view name() { return BackwardEuler::name; }

  /// The next step starts a segment on which f is smooth.
  void begin_segment(double begin, double end) { segment_ = SmoothSegment(begin, end); }

  /// Integrates from t to t + h.
  Status step(double t, double h, const State& x0, State& x1, Statistics& statistics) {
    const double t1 = segment_(t + h);
    const auto residual = [&](const State& x, State& r) {
      system_.rhs(t1, x, f_);
      ++statistics.right_hand_sides;
      r = x - x0 - h * f_;
    };
    const auto derivative = [&](const State& x, Jacobian& matrix) {
      system_.jacobian(t1, x, matrix);
      matrix *= -h;
      matrix.diagonal().array() += 1;
    };
    x1_ = x0;
    algebraic::Newton newton = newton_;
    // Rounding of a component by eps |x| changes components of the dimension of its rate by eps |x|/h, for
    // any stiffness of f of a motion that is smooth at this step size.
    const double noise = 16 * std::numeric_limits<double>::epsilon() * x0.cwiseAbs().maxCoeff();
    newton.noise = std::max(newton.noise, noise * (1 + 1 / std::abs(h)));
    const std::int64_t before = statistics.newton_iterations;
    const Outcome outcome = algebraic::solve(newton, residual, derivative, x1_, workspace_, statistics);
    if (outcome != Outcome::success)
      return step_not_solved(name(), outcome, t, h, static_cast<int>(statistics.newton_iterations - before));
    t0_ = t;
    h_ = h;
    x0_ = x0;
    x1 = x1_;
    return {};
  }

  /// Linear between the ends of the step.
  void at(double t, State& x) const override {
    const double s = (t - t0_) / h_;
    x = (1 - s) * x0_ + s * x1_;
  }

 private:
  const System& system_;
  algebraic::Newton newton_;
  SmoothSegment segment_;
  State x0_, x1_, f_;
  algebraic::Workspace<State> workspace_;
  double t0_ = 0, h_ = 1;
};

}  // namespace

Solution run(const InitialValueProblem& problem, const BackwardEuler& method) {
  require_step(method.name, method.step);
  BackwardEulerStepper stepper(problem.system, method.newton);
  return integrate_fixed_steps(problem, method.step, stepper);
}

}  // namespace nlmech::ivp

#include "nlmech/peers/ivp/odeint/odeint.hpp"

#include "nlmech/peers/ivp/odeint/odeint_rosenbrock.hpp"
#include "nlmech/peers/ivp/odeint/odeint_stepper.hpp"

namespace nlmech::peers {
namespace {

class RosenbrockStepper final : public PeerStepper, detail::RosenbrockEquations {
 public:
  RosenbrockStepper(Equations& equations, const Odeint& method, double largest_step)
      : equations_(equations),
        tolerances_{method.relative_tolerance, method.absolute_tolerance},
        method_(method.name()),
        formula_(*this, equations.size(), tolerances_.absolute, tolerances_.relative),
        step_(method_, largest_step),
        size_(static_cast<std::size_t>(equations.size())),
        slope_(size_) {}

  Status begin(double t, const double* x, double end) override {
    formula_.restart(x);
    equations_.rhs(t, x, slope_.data());
    if (!equations_.check(slope_.data())) return non_finite_rhs(method_, t, end - t);
    step_.begin(t, end, initial_step(t, x, slope_.data(), equations_.size(), end, tolerances_));
    return {};
  }

  Attempt attempt(double* x, Statistics& statistics) override {
    const double t0 = step_.time(), tried = step_.cut();
    double next_length = tried;
    const bool accepted = formula_.try_step(t0, next_length);
    ++statistics.factorisations;
    const bool is_finite = equations_.check(formula_.next());
    Attempt done = step_.finish_trial(accepted, is_finite, tried, next_length);
    if (!is_finite) formula_.restart(nullptr);  // its step-size control may have stored a NaN
    if (done.result != Attempt::Result::accepted) return done;
    std::copy_n(formula_.next(), size_, x);
    formula_.advance(t0, done.t);
    return done;
  }

  void at(double t, double* x) override { formula_.at(t, x); }
  void add_counters(Statistics& /*statistics*/) const override {}

 private:
  void rhs(double t, const double* x, double* f) override { equations_.rhs(t, x, f); }
  void derivatives(double t, const double* x, double* j, double* dfdt) override {
    equations_.jacobian(t, x, j);
    equations_.time_derivative(t, x, dfdt);
  }

  Equations& equations_;
  Tolerances tolerances_;
  std::string_view method_;
  detail::Rosenbrock formula_;
  detail::OdeintStep step_;
  std::size_t size_;
  std::vector<double> slope_;
};

Status run_rosenbrock4(Run& run, const Odeint& method) {
  RosenbrockStepper stepper(run.equations, method, run.limits.largest_step);
  return integrate_steps(method.name(), stepper, run);
}

}  // namespace

bool odeint_available() noexcept { return true; }

Status integrate_by(Run& run, const Odeint& method) {
  require_tolerances(method.name(), {method.relative_tolerance, method.absolute_tolerance});
  if (method.formula == Odeint::Formula::rosenbrock4) return run_rosenbrock4(run, method);
  return detail::run_explicit_odeint<std::vector<double>>(run.equations, run, method);
}

}  // namespace nlmech::peers

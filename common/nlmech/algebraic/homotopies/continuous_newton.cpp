#include "nlmech/algebraic/homotopies/continuous_newton.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/linear_solver.hpp"
#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

constexpr const char* continuous_newton = "continuous-newton";

void check(const ContinuousNewton& m) {
  require_option(continuous_newton, m.step > 0 && std::isfinite(m.step), "step", m.step, "positive");
  require_option(continuous_newton, m.turn >= 0 && std::isfinite(m.turn), "turn", m.turn, "0 or positive");
  require_option(continuous_newton, m.longest > 0 && std::isfinite(m.longest), "longest", m.longest,
                 "positive");
}

class NewtonFlow {
 public:
  NewtonFlow(const ContinuousNewton& method, SolverRun& run)
      : method_(method),
        run_(run),
        solver_(run.equations()),
        velocity_(run.x.size()),
        next_(run.x.size()),
        step_(method.turn > 0 ? std::min(method.step, method.longest) : method.step) {}

  Outcome step() {
    if (!has_velocity_) {
      const Outcome outcome = velocity(run_.x, run_.f, velocity_);
      if (outcome != Outcome::success) return outcome;
      has_velocity_ = true;
    }
    return method_.turn > 0 ? chosen_step() : fixed_step();
  }

 private:
  static constexpr double shortest_ = 1e-12;  // of chosen steps

  // Eq. 2.3.
  Outcome velocity(const Eigen::VectorXd& x, const Eigen::VectorXd& f, Eigen::VectorXd& v) {
    run_.linearise(x);
    ++run_.statistics().factorisations;
    const Outcome outcome = solver_.factorise(run_.equations());
    if (outcome != Outcome::success) return outcome;
    ++run_.statistics().newton_iterations;
    const Outcome solved = solver_.solve(f, v);
    v = -v;
    return solved;
  }

  Outcome fixed_step() {
    run_.trial = run_.x + step_ * velocity_;
    run_.evaluate_trial();
    if (!std::isfinite(run_.trial_norm)) return Outcome::non_finite;
    has_velocity_ = false;
    return run_.accept(run_.report.time + step_);
  }

  // The local error of Euler's rule is half the change of the velocity, times the step.
  Outcome chosen_step() {
    if (step_ < shortest_) return Outcome::step_underflow;
    run_.trial = run_.x + step_ * velocity_;
    run_.evaluate_trial();
    double fraction = HUGE_VAL;
    if (run_.trial_norm <= method_.tolerance)
      fraction = 0;
    else if (std::isfinite(run_.trial_norm) && velocity(run_.trial, run_.trial_f, next_) == Outcome::success)
      fraction = (next_ - velocity_).norm() / (2 * method_.turn * velocity_.norm());
    const double taken = step_;
    step_ = std::min(method_.longest, step_ * std::clamp(0.9 / fraction, 0.2, 2.0));
    if (!(fraction <= 1)) {
      run_.reject();
      return Outcome::success;
    }
    velocity_.swap(next_);
    return run_.accept(run_.report.time + taken);
  }

  const ContinuousNewton& method_;
  SolverRun& run_;
  LinearSolver solver_;
  Eigen::VectorXd velocity_, next_;
  double step_;
  bool has_velocity_ = false;
};

}  // namespace

Report find_root(const ContinuousNewton& method, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  check(method);
  return iterate<NewtonFlow>(
      continuous_newton, method, equations, x, observer,
      {Outcome::step_underflow,
       "no step is short enough: the flow ends where dF/dx is singular; start elsewhere"});
}

Report find_root(const FictitiousTime& m, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  constexpr const char* flow = "fictitious-time";
  require_option(flow, m.nu != 0 && std::isfinite(m.nu), "nu", m.nu, "finite and not 0");
  require_option(flow, m.power >= 0 && m.power <= 1, "power", m.power, "from 0 to 1");
  require_option(flow, m.step > 0 && std::isfinite(m.step), "step", m.step, "positive");
  SolverRun run(flow, equations, x, observer, m.tolerance, m.iterations);
  const Outcome outcome = make_steps(run, [&] {
    const double t = run.report.time;
    run.trial = run.x - (m.step * m.nu / std::pow(1 + t, m.power)) * run.f;  // Eq. 2.7
    run.evaluate_trial();
    return std::isfinite(run.trial_norm) ? run.accept(t + m.step) : Outcome::non_finite;
  });
  return run.finish(
      outcome, x,
      outcome == Outcome::non_finite
          ? "F is not finite any more; change the sign of nu, shorten the step or take a method "
            "that uses dF/dx"
          : "");
}

}  // namespace nlmech::algebraic

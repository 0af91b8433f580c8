#include "nlmech/algebraic/homotopies/continuous_newton.hpp"

#include <cmath>

#include "nlmech/algebraic/linear_solver.hpp"
#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

class NewtonFlow {
 public:
  NewtonFlow(const ContinuousNewton& method, SolverRun& run)
      : step_(method.step), run_(run), solver_(run.equations()), change_(run.x.size()) {}

  // Eq. 2.3.
  Outcome step() {
    run_.linearise(run_.x);
    ++run_.statistics().factorisations;
    Outcome outcome = solver_.factorise(run_.equations());
    if (outcome != Outcome::success) return outcome;
    ++run_.statistics().newton_iterations;
    outcome = solver_.solve(run_.f, change_);
    if (outcome != Outcome::success) return outcome;
    run_.trial = run_.x - step_ * change_;
    run_.evaluate_trial();
    return std::isfinite(run_.trial_norm) ? run_.accept(run_.report.time + step_) : Outcome::non_finite;
  }

 private:
  double step_;
  SolverRun& run_;
  LinearSolver solver_;
  Eigen::VectorXd change_;
};

}  // namespace

Report find_root(const ContinuousNewton& method, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  constexpr const char* name = "continuous-newton";
  require_option(name, method.step > 0 && std::isfinite(method.step), "step", method.step, "positive");
  return iterate<NewtonFlow>(name, method, equations, x, observer, {});
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

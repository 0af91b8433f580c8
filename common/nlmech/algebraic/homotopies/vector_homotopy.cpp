#include "nlmech/algebraic/homotopies/vector_homotopy.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/homotopies/homotopy_function.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::VectorXd;

constexpr double off_path = 100;  // a path's global error, in parts of what a step is allowed
constexpr const char* vector_name = "vector-homotopy";

class HomotopyPath {
 public:
  HomotopyPath(const VectorHomotopy& method, SolverRun& run)
      : method_(method),
        run_(run),
        h_(method.function, run.x, run.f),
        solver_(run.equations()),
        step_(1.0 / method.steps) {
    for (VectorXd* v : {&k1_, &k2_, &k3_, &k4_, &place_, &f_, &side_}) v->resize(run.x.size());
  }

  Outcome step() {
    if (t_ >= 1) return correct();
    if (!has_k1_) {
      const Outcome outcome = velocity(run_.x, t_, run_.f, k1_);
      if (outcome != Outcome::success) return outcome;
      has_k1_ = true;
    }
    return method_.accuracy > 0 ? chosen_step() : equal_step();
  }

 private:
  static constexpr double shortest_ = 1e-10;  // of chosen steps

  // Eq. 2.10, where F is known.
  Outcome velocity(const VectorXd& x, double t, const VectorXd& f, VectorXd& v) {
    run_.linearise(x);
    ++run_.statistics().factorisations;
    ++run_.statistics().newton_iterations;
    const Outcome outcome = solver_.factorise(run_.equations(), h_.matrix_scale(t), h_.matrix_shift(t));
    if (outcome != Outcome::success) return outcome;
    h_.slope(x, f, side_);
    side_ = -side_;
    return solver_.solve(side_, v);
  }

  Outcome stage(double t, VectorXd& v) {
    if (!(run_.evaluate(place_, f_) < HUGE_VAL)) return Outcome::non_finite;
    return velocity(place_, t, f_, v);
  }

  Outcome arrive(double step) {
    t_ = step >= 1 - t_ ? 1 : t_ + step;
    return run_.accept(t_);
  }

  Outcome equal_step() {
    const double h = std::min(1.0 / method_.steps, 1 - t_);
    place_ = run_.x + h / 2 * k1_;
    Outcome outcome = stage(t_ + h / 2, k2_);
    if (outcome != Outcome::success) return outcome;
    place_ = run_.x + h / 2 * k2_;
    outcome = stage(t_ + h / 2, k3_);
    if (outcome != Outcome::success) return outcome;
    place_ = run_.x + h * k3_;
    outcome = stage(t_ + h, k4_);
    if (outcome != Outcome::success) return outcome;
    run_.trial = run_.x + h / 6 * (k1_ + 2 * k2_ + 2 * k3_ + k4_);
    run_.evaluate_trial();
    has_k1_ = false;
    if (!(run_.trial_norm < HUGE_VAL)) return Outcome::non_finite;
    return arrive(++taken_ == method_.steps ? 1 : h);
  }

  // Error of the rule in parts of what is allowed; the velocity at the end is in k4_.
  double error_of(double h) {
    place_ = run_.x + h / 2 * k1_;
    if (stage(t_ + h / 2, k2_) != Outcome::success) return HUGE_VAL;
    place_ = run_.x + 0.75 * h * k2_;
    if (stage(t_ + 0.75 * h, k3_) != Outcome::success) return HUGE_VAL;
    run_.trial = run_.x + h / 9 * (2 * k1_ + 3 * k2_ + 4 * k3_);
    run_.evaluate_trial();
    if (!(run_.trial_norm < HUGE_VAL)) return HUGE_VAL;
    if (velocity(run_.trial, t_ + h, run_.trial_f, k4_) != Outcome::success) return HUGE_VAL;
    place_ = h * (-5.0 / 72 * k1_ + 1.0 / 12 * k2_ + 1.0 / 9 * k3_ - 1.0 / 8 * k4_);
    const double allowed = method_.accuracy * (1 + run_.trial.norm());
    const double part = place_.norm() / allowed;
    // Past a turning point the flow goes on where no path is. Newton's step back to it, by the factors at
    // hand, tells.
    h_.value(run_.trial, t_ + h, run_.trial_f, side_);
    if (solver_.solve(side_, place_) != Outcome::success || !(place_.norm() <= off_path * allowed))
      return HUGE_VAL;
    return std::isfinite(part) ? part : HUGE_VAL;
  }

  Outcome chosen_step() {
    if (step_ < shortest_) return Outcome::step_underflow;
    const double h = std::min(step_, 1 - t_), error = error_of(h);
    step_ = h * std::clamp(0.9 / std::cbrt(error), 0.2, 4.0);
    if (error > 1) {
      run_.reject();
      return Outcome::success;
    }
    k1_.swap(k4_);
    return arrive(h);
  }

  // Newton at t = 1, where F and H agree.
  Outcome correct() {
    if (corrections_++ == method_.corrections) return Outcome::not_converged;
    const Outcome outcome = newton_trial(run_, solver_, run_.x, run_.f, place_);
    return outcome == Outcome::success ? run_.accept(1) : outcome;
  }

  const VectorHomotopy& method_;
  SolverRun& run_;
  HomotopyFunction h_;
  LinearSolver solver_;
  VectorXd k1_, k2_, k3_, k4_, place_, f_, side_;
  double t_ = 0, step_;
  int taken_ = 0, corrections_ = 0;
  bool has_k1_ = false;
};

std::string_view along_path(Outcome outcome) {
  switch (outcome) {
    case Outcome::singular_matrix:
    case Outcome::step_underflow:
      return "dH/dx is singular: the path turns back, and t cannot lead over that; follow its arc length "
             "(chow-yorke)";
    case Outcome::not_converged:
      return "Newton's iteration at t = 1 does not end; follow the path more closely, or by its arc length";
    default: return "";
  }
}

}  // namespace

Report find_root(const VectorHomotopy& method, Equations& equations, VectorXd& x, const Observer& observer) {
  require_option(vector_name, method.accuracy >= 0 && std::isfinite(method.accuracy), "accuracy",
                 method.accuracy, "0 or positive");
  require_option(vector_name, method.steps >= 1, "steps", method.steps, "at least 1");
  require_option(vector_name, method.corrections >= 0, "corrections", method.corrections, "0 or positive");
  SolverRun run(vector_name, equations, x, observer, method.tolerance, method.limit);
  Outcome outcome = run.begin();
  HomotopyPath path(method, run);
  while (run.go_on(outcome)) outcome = path.step();
  return run.finish(outcome, x, along_path(outcome));
}

}  // namespace nlmech::algebraic

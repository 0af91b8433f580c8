#include "nlmech/algebraic/newton/broyden.hpp"

#include <cmath>

#include "nlmech/algebraic/linear_solver.hpp"
#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Secant {
 public:
  Secant(const Broyden& method, SolverRun& run)
      : method_(method),
        run_(run),
        solver_(run.equations()),
        update_(run.x.size()),
        image_(run.x.size()),
        step_(run.x.size()),
        changes_(run.x.size(), method.memory),
        steps_(run.x.size(), method.memory) {}

  Outcome step() {
    if (kept_ < 0) {
      const Outcome outcome = restart();
      if (outcome != Outcome::success) return outcome;
    }
    const double before = run_.norm;
    double part = 1;
    for (int k = 0;; ++k, part /= 2) {
      run_.trial = run_.x + part * update_;
      run_.evaluate_trial();
      if (run_.trial_norm <= method_.growth * before && run_.trial_norm < HUGE_VAL) break;
      run_.reject();
      if (run_.is_spent()) return Outcome::step_limit;
      if (k == 30) return Outcome::not_converged;
    }
    const Outcome outcome = run_.accept();
    if (outcome != Outcome::success || run_.is_done()) return outcome;
    learn(part, run_.norm < before);
    return outcome;
  }

 private:
  Outcome restart() {
    run_.linearise(run_.x);
    ++run_.statistics().factorisations;
    kept_ = 0;
    const Outcome outcome = solver_.factorise(run_.equations());
    return outcome == Outcome::success ? next(update_) : outcome;
  }

  // -A^-1 F at the iterate.
  Outcome next(VectorXd& out) {
    ++run_.statistics().newton_iterations;
    const Outcome outcome = solver_.solve(run_.f, out);
    if (outcome != Outcome::success) return outcome;
    for (Eigen::Index k = 0; k < kept_; ++k) out += changes_.col(k) * steps_.col(k).dot(out);
    out = -out;
    return out.allFinite() ? Outcome::success : Outcome::singular_matrix;
  }

  // A^-1 <- A^-1 + (s - A^-1 y) (s^T A^-1)/(s^T A^-1 y) for the step s and the change y of F; then A^-1 y =
  // s.
  void learn(double part, bool is_shorter) {
    if (!is_shorter || kept_ == method_.memory) {
      kept_ = -1;
      return;
    }
    step_ = part * update_;
    if (next(image_) != Outcome::success) {
      kept_ = -1;
      return;
    }
    // -A^-1 F was `update_` before the step and is `image_` now, so that A^-1 y = update_ - image_.
    const VectorXd& s = step_;
    const double product = s.dot(update_) - s.dot(image_);
    if (!(std::abs(product) > 1e-8 * s.squaredNorm())) {  // A^-1 would be nearly singular, or infinite
      kept_ = -1;
      return;
    }
    changes_.col(kept_) = (s - update_ + image_) / product;
    steps_.col(kept_) = s;
    update_ = image_ + changes_.col(kept_) * s.dot(image_);
    ++kept_;
    if (!update_.allFinite()) kept_ = -1;
  }

  const Broyden& method_;
  SolverRun& run_;
  LinearSolver solver_;
  VectorXd update_, image_, step_;
  MatrixXd changes_, steps_;
  Eigen::Index kept_ = -1;  // number of stored updates; below 0: A restarts
};

}  // namespace

Report find_root(const Broyden& method, Equations& equations, VectorXd& x, const Observer& observer) {
  constexpr const char* name = "broyden";
  require_option(name, method.memory >= 1, "memory", method.memory, "at least 1");
  require_option(name, method.growth >= 1, "growth", method.growth, "at least 1");
  return iterate<Secant>(name, method, equations, x, observer);
}

}  // namespace nlmech::algebraic

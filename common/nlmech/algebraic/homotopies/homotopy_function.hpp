/// @file
/// H(x, t) of the vector homotopies, its derivatives, and Newton's iteration at its end.
#pragma once

#include <cmath>

#include "nlmech/algebraic/homotopies/vector_homotopy.hpp"
#include "nlmech/algebraic/linear_solver.hpp"
#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {

/// H of a start x(0), with F(x(0)). dH/dx = matrix_scale() B + matrix_shift() I.
class HomotopyFunction {
 public:
  /// @param function which
  /// @param origin x(0)
  /// @param first F(x(0))
  HomotopyFunction(Homotopy function, const Eigen::VectorXd& origin, const Eigen::VectorXd& first)
      : function_(function), origin_(origin), first_(first) {}

  /// h = H(x, t) where F(x) = f.
  void value(const Eigen::VectorXd& x, double t, const Eigen::VectorXd& f, Eigen::VectorXd& h) const {
    if (function_ == Homotopy::fixed_point) {
      h = t * f + (1 - t) * (x - origin_);
    } else {
      h = f - (1 - t) * first_;
    }
  }
  /// h = dH/dt.
  void slope(const Eigen::VectorXd& x, const Eigen::VectorXd& f, Eigen::VectorXd& h) const {
    if (function_ == Homotopy::fixed_point) {
      h = f - (x - origin_);
    } else {
      h = first_;
    }
  }
  /// Of B in dH/dx.
  [[nodiscard]] double matrix_scale(double t) const { return function_ == Homotopy::fixed_point ? t : 1; }
  /// Of I in dH/dx.
  [[nodiscard]] double matrix_shift(double t) const { return function_ == Homotopy::fixed_point ? 1 - t : 0; }
  /// |F(x(0))|
  [[nodiscard]] double scale() const { return first_.norm(); }

 private:
  Homotopy function_;
  Eigen::VectorXd origin_, first_;
};

/// One step of Newton at t = 1, from the iterate to the trial point, with F there.
/// @param update workspace
[[nodiscard]] inline Outcome newton_trial(SolverRun& run, LinearSolver& solver, const Eigen::VectorXd& x,
                                          const Eigen::VectorXd& f, Eigen::VectorXd& update) {
  run.linearise(x);
  ++run.statistics().factorisations;
  ++run.statistics().newton_iterations;
  Outcome outcome = solver.factorise(run.equations());
  if (outcome == Outcome::success) outcome = solver.solve(f, update);
  if (outcome != Outcome::success) return outcome;
  run.trial = x - update;
  run.evaluate_trial();
  return run.trial_norm < HUGE_VAL ? Outcome::success : Outcome::non_finite;
}

}  // namespace nlmech::algebraic

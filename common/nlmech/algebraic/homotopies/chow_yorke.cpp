#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/homotopies/homotopy_function.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::VectorXd;

constexpr int corrections = 6;  // of a step; more mean that it is too long
constexpr const char* chow_yorke = "chow-yorke";

/// The path in z = (x, t). All vectors of it are of n + 1 components.
class AugmentedPath {
 public:
  AugmentedPath(const ChowYorke& method, SolverRun& run)
      : method_(method),
        run_(run),
        h_(method.function, run.x, run.f),
        solver_(run.equations()),
        n_(run.x.size()),
        step_(std::min(method.step, method.longest)) {
    for (VectorXd* v : {&z_, &next_, &tangent_, &turned_, &side_, &update_}) v->setZero(n_ + 1);
    for (VectorXd* v : {&x_, &f_, &column_, &value_}) v->resize(n_);
    z_.head(n_) = run.x;
  }

  Outcome step() {
    if (!has_tangent_) {
      const Outcome outcome = first_tangent();
      if (outcome != Outcome::success) return outcome;
      has_tangent_ = true;
    }
    if (step_ < shortest_) return Outcome::step_underflow;
    next_ = z_ + step_ * tangent_;
    const int used = return_to_path();
    const bool is_near = used < corrections && follow(next_, tangent_, turned_) == Outcome::success &&
                         turned_.dot(tangent_) >= std::cos(method_.turn);
    if (!is_near) return refuse();
    if (next_[n_] >= 1) return arrive();
    step_ = std::min(method_.longest, step_ * (used <= 2 ? 2 : used >= 4 ? 0.7 : 1.0));
    return take();
  }

 private:
  static constexpr double shortest_ = 1e-10;  // of steps

  Outcome refuse() {
    step_ /= 2;
    run_.reject();
    return Outcome::success;
  }

  Outcome take() {
    z_.swap(next_);
    tangent_.swap(turned_);
    run_.trial = z_.head(n_);
    run_.trial_f = f_;
    run_.trial_norm = f_.norm();
    return run_.accept(z_[n_]);
  }

  // Matrix of the augmented system, bordered by @p row, at (x_, t) with F = f_.
  Outcome factorise(double t, const VectorXd& row) {
    run_.linearise(x_);
    h_.slope(x_, f_, column_);
    ++run_.statistics().factorisations;
    return solver_.factorise_bordered(run_.equations(), h_.matrix_scale(t), h_.matrix_shift(t), column_, row);
  }

  // Unit tangent at z, whose F is in f_, on the side of `row`.
  Outcome follow(const VectorXd& z, const VectorXd& row, VectorXd& tangent) {
    x_ = z.head(n_);
    Outcome outcome = factorise(z[n_], row);
    if (outcome != Outcome::success) return outcome;
    side_.setZero();
    side_[n_] = 1;
    ++run_.statistics().newton_iterations;
    outcome = solver_.solve(side_, tangent);
    if (outcome != Outcome::success) return outcome;
    const double length = tangent.norm();
    if (!(length > 0 && std::isfinite(length))) return Outcome::singular_matrix;
    tangent /= length;
    return Outcome::success;
  }

  // Towards greater t; where dH/dx is singular the border of t alone is not enough, and any other row that is
  // not normal to the tangent will do.
  Outcome first_tangent() {
    f_ = run_.f;
    turned_.setZero();
    turned_[n_] = 1;
    Outcome outcome = follow(z_, turned_, tangent_);
    if (outcome == Outcome::singular_matrix) {
      ++run_.statistics().fallbacks;
      for (Eigen::Index i = 0; i <= n_; ++i) turned_[i] = std::cos(static_cast<double>(i + 1));
      outcome = follow(z_, turned_, tangent_);
      if (tangent_[n_] < 0) tangent_ = -tangent_;
    }
    return outcome;
  }

  // Newton's iteration for H = 0 normal to the tangent, from next_. @return how many steps; F is in f_
  int return_to_path() {
    const double enough = std::max(method_.accuracy * h_.scale(), method_.tolerance / 4);
    double before = HUGE_VAL;
    for (int k = 0; k < corrections; ++k) {
      x_ = next_.head(n_);
      if (!(run_.evaluate(x_, f_) < HUGE_VAL)) return corrections;
      h_.value(x_, next_[n_], f_, value_);
      if (value_.norm() <= enough) return k;
      if (factorise(next_[n_], tangent_) != Outcome::success) return corrections;
      side_.head(n_) = value_;
      side_[n_] = 0;
      ++run_.statistics().newton_iterations;
      if (solver_.solve(side_, update_) != Outcome::success) return corrections;
      const double length = update_.norm();
      if (!(length < before / 2 && length < step_)) return corrections;  // another branch, or none
      before = length;
      next_ -= update_;
    }
    return corrections;
  }

  // The path has passed t = 1 between z_ and next_: Newton at t = 1 from the secant, which must end near.
  Outcome arrive() {
    const double part = (1 - z_[n_]) / (next_[n_] - z_[n_]), reach = (next_ - z_).norm();
    x_ = z_.head(n_) + part * (next_ - z_).head(n_);
    value_ = x_;
    double norm = run_.evaluate(x_, f_);
    if (norm <= method_.tolerance) {
      run_.trial = x_;
      run_.trial_f = f_;
      run_.trial_norm = norm;
      return run_.accept(1);
    }
    for (int k = 0; k < 2 * corrections && norm < HUGE_VAL; ++k) {
      if (newton_trial(run_, solver_, x_, f_, column_) != Outcome::success) break;
      if (!((run_.trial - value_).norm() <= reach)) break;
      if (run_.trial_norm <= method_.tolerance) return run_.accept(1);
      x_ = run_.trial;
      f_ = run_.trial_f;
      norm = run_.trial_norm;
    }
    return refuse();
  }

  const ChowYorke& method_;
  SolverRun& run_;
  HomotopyFunction h_;
  LinearSolver solver_;
  Eigen::Index n_;
  VectorXd z_, next_, tangent_, turned_, side_, update_;  // n + 1
  VectorXd x_, f_, column_, value_;                       // n
  double step_;
  bool has_tangent_ = false;
};

void check(const ChowYorke& m) {
  require_option(chow_yorke, m.step > 0 && std::isfinite(m.step), "step", m.step, "positive");
  require_option(chow_yorke, m.longest > 0 && std::isfinite(m.longest), "longest", m.longest, "positive");
  require_option(chow_yorke, m.turn > 0 && m.turn <= 1, "turn", m.turn, "above 0 and at most 1");
  require_option(chow_yorke, m.accuracy > 0 && std::isfinite(m.accuracy), "accuracy", m.accuracy, "positive");
}

std::string_view after_path(Outcome outcome) {
  switch (outcome) {
    case Outcome::singular_matrix:
      return "the matrix of dH/dx and dH/dt has no full rank here; start elsewhere";
    case Outcome::step_underflow:
      return "the path cannot be followed by any step: it ends or branches here; start elsewhere or take the "
             "other homotopy";
    case Outcome::step_limit:
      return "the allowed steps are used up before t = 1; the path may run to infinity; start elsewhere or "
             "take the other homotopy";
    default: return "";
  }
}

}  // namespace

Report find_root(const ChowYorke& method, Equations& equations, VectorXd& x, const Observer& observer) {
  check(method);
  SolverRun run(chow_yorke, equations, x, observer, method.tolerance, method.iterations);
  Outcome outcome = run.begin();
  AugmentedPath path(method, run);
  while (run.go_on(outcome)) outcome = path.step();
  return run.finish(outcome, x, after_path(outcome));
}

}  // namespace nlmech::algebraic

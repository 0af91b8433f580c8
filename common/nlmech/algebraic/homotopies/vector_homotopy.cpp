#include "nlmech/algebraic/homotopies/vector_homotopy.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/linear_solver.hpp"
#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::VectorXd;

/// The homotopy H for a start x(0), with F(x(0)). dH/dx = matrix_scale() B + matrix_shift() I.
class HomotopyFunction {
 public:
  /// @param function choice of H
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
  /// Factor of B in dH/dx.
  [[nodiscard]] double matrix_scale(double t) const { return function_ == Homotopy::fixed_point ? t : 1; }
  /// Factor of I in dH/dx.
  [[nodiscard]] double matrix_shift(double t) const { return function_ == Homotopy::fixed_point ? 1 - t : 0; }
  /// |F(x(0))|
  [[nodiscard]] double scale() const { return first_.norm(); }

 private:
  Homotopy function_;
  Eigen::VectorXd origin_, first_;
};

/// One Newton step at t = 1 from the iterate to the trial point; evaluates F there.
/// @param update workspace
Outcome newton_trial(SolverRun& run, LinearSolver& solver, const Eigen::VectorXd& x, const Eigen::VectorXd& f,
                     Eigen::VectorXd& update) {
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

constexpr double off_path = 100;  // largest distance from the path, in units of the tolerance of a step
constexpr const char* vector_name = "vector-homotopy";

class HomotopyPath {
 public:
  HomotopyPath(const VectorHomotopy& method, SolverRun& run)
      : method_(method), run_(run), h_(method.function, run.x, run.f), solver_(run.equations()) {
    for (VectorXd* v : {&k1_, &k2_, &k3_, &k4_, &place_, &f_, &side_}) v->resize(run.x.size());
  }

  Outcome step() {
    if (t_ >= 1) return correct();
    if (!has_k1_) {
      const Outcome outcome = velocity(run_.x, t_, run_.f, k1_);
      if (outcome != Outcome::success) return outcome;
      has_k1_ = true;
    }
    return chosen_step();
  }

 private:
  static constexpr double shortest_ = 1e-10;  // smallest step size

  // Velocity of Eq. 2.10 for known F.
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

  // Error estimate divided by the tolerance; leaves the velocity at the end in k4_.
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
    // Past a turning point the flow leaves the path. Newton's step with the existing factors estimates the
    // distance.
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
    t_ = h >= 1 - t_ ? 1 : t_ + h;
    return run_.accept(t_);
  }

  // Newton at t = 1, where F and H agree.
  Outcome correct() {
    if (corrections_++ == 20) return Outcome::not_converged;
    const Outcome outcome = newton_trial(run_, solver_, run_.x, run_.f, place_);
    return outcome == Outcome::success ? run_.accept(1) : outcome;
  }

  const VectorHomotopy& method_;
  SolverRun& run_;
  HomotopyFunction h_;
  LinearSolver solver_;
  VectorXd k1_, k2_, k3_, k4_, place_, f_, side_;
  double t_ = 0, step_ = 0.05;
  int corrections_ = 0;
  bool has_k1_ = false;
};

std::string_view along_path(Outcome outcome) {
  switch (outcome) {
    case Outcome::singular_matrix:
    case Outcome::step_underflow:
      return "dH/dx is singular: the path turns back in t; follow it by arc length (chow-yorke)";
    case Outcome::not_converged:
      return "Newton's iteration at t = 1 does not converge; take shorter steps along the path, or follow it "
             "by arc length";
    default: return "";
  }
}

}  // namespace

Report find_root(const VectorHomotopy& method, Equations& equations, VectorXd& x, const Observer& observer) {
  require_option(vector_name, method.accuracy > 0 && std::isfinite(method.accuracy), "accuracy",
                 method.accuracy, "positive");
  SolverRun run(vector_name, equations, x, observer, method.tolerance, method.limit);
  Outcome outcome = run.begin();
  HomotopyPath path(method, run);
  while (run.go_on(outcome)) outcome = path.step();
  return run.finish(outcome, x, along_path(outcome));
}

namespace {

constexpr int corrections = 6;  // corrections allowed in a step; more mean that it is too long
constexpr const char* chow_yorke = "chow-yorke";

/// The path in z = (x, t); its vectors have n + 1 components.
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
  static constexpr double shortest_ = 1e-10;  // smallest step size

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

  // Unit tangent at z with tangent.row > 0; f_ holds F at z.
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

  // First tangent, towards greater t. Where dH/dx is singular, the border row e_t is not enough; any row that
  // is not normal to the tangent works.
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

  // Newton's iteration for H = 0 from next_, normal to the tangent. @return number of corrections; f_ holds F
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

  // The path has passed t = 1 between z_ and next_: Newton's iteration at t = 1 from the secant; rejected if
  // it goes farther than the step.
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
      return "no step length follows the path: it ends or branches here; start elsewhere or take the other "
             "homotopy";
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

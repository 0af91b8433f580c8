#include "nlmech/algebraic/newton/least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/algebraic/linear_solver.hpp"
#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::VectorXd;

class Hybrid {
 public:
  Hybrid(const Dogleg& method, SolverRun& run)
      : run_(run),
        solver_(run.equations()),
        newton_(run.x.size()),
        cauchy_(run.x.size()),
        update_(run.x.size()),
        image_(run.x.size()),
        radius_(method.radius) {}

  Outcome step() {
    if (!is_loaded_) {
      const Outcome outcome = load();
      if (outcome != Outcome::success) return outcome;
    }
    if (radius_ <= 1e-16 * run_.x.norm() || radius_ < 1e-300) return Outcome::not_converged;
    bend();
    run_.equations().apply(update_, image_);
    run_.trial = run_.x + update_;
    run_.evaluate_trial();
    const double trial = run_.trial_norm / run_.norm;
    const double model = (run_.f + image_).squaredNorm() / run_.norm / run_.norm;
    const double ratio = (1 - trial) * (1 + trial) / (1 - model), length = update_.norm();
    if (!(ratio >= 0.25)) {  // also where F is not finite
      radius_ = 0.25 * length;
    } else if (ratio > 0.75 && length >= 0.99 * radius_) {
      radius_ *= 2;
    }
    if (!(trial < 1 && ratio > 1e-4)) {
      run_.reject();
      return Outcome::success;
    }
    is_loaded_ = false;
    return run_.accept();
  }

 private:
  Outcome load() {
    run_.linearise(run_.x);
    ++run_.statistics().factorisations;
    Outcome outcome = solver_.factorise(run_.equations());
    if (outcome == Outcome::non_finite) return outcome;
    run_.equations().apply_transposed(run_.f, cauchy_);
    const double slope = cauchy_.norm();
    if (slope == 0) return Outcome::singular_matrix;
    run_.equations().apply(cauchy_, image_);
    const double bend = image_.norm(), cosine = slope / bend * (slope / run_.norm);
    if (!(cosine * cosine >= least_cosine_squared)) return Outcome::not_converged;
    cauchy_ *= -(slope / bend) * (slope / bend);
    ++run_.statistics().newton_iterations;
    if (outcome == Outcome::success) outcome = solver_.solve(run_.f, newton_);
    has_newton_ = outcome == Outcome::success;
    if (has_newton_) {
      newton_ = -newton_;
    } else {
      ++run_.statistics().fallbacks;
    }
    is_loaded_ = true;
    return Outcome::success;
  }

  // The point of the dogleg path at the radius, or its end point.
  void bend() {
    const double to_cauchy = cauchy_.norm();
    if (has_newton_ && newton_.norm() <= radius_) {
      update_ = newton_;
    } else if (to_cauchy >= radius_ || !has_newton_) {
      update_ = std::min(1.0, radius_ / to_cauchy) * cauchy_;
    } else {
      update_ = newton_ - cauchy_;
      const double length = update_.norm(), along = cauchy_.dot(update_) / length;
      const double rest = (radius_ - to_cauchy) * (radius_ + to_cauchy);
      // The positive root of s^2 + 2 s along = rest, without cancellation.
      const double root = std::sqrt(along * along + rest);
      const double s = along > 0 ? rest / (along + root) : root - along;
      update_ = cauchy_ + std::min(1.0, s / length) * update_;
    }
  }

  SolverRun& run_;
  LinearSolver solver_;
  VectorXd newton_, cauchy_, update_, image_;
  double radius_;
  bool is_loaded_ = false, has_newton_ = false;
};

}  // namespace

Report find_root(const Dogleg& method, Equations& equations, VectorXd& x, const Observer& observer) {
  constexpr const char* name = "dogleg";
  require_option(name, method.radius > 0 && std::isfinite(method.radius), "radius", method.radius,
                 "positive");
  return iterate<Hybrid>(name, method, equations, x, observer, stationary);
}

}  // namespace nlmech::algebraic

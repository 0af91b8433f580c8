#include "nlmech/algebraic/newton/descent.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

constexpr int halvings = 60;  // further ones do not move x

class Descent {
 public:
  Descent(const SteepestDescent& method, SolverRun& run)
      : method_(method),
        run_(run),
        gradient_(run.x.size()),
        before_(run.x.size()),
        image_(run.x.size()),
        place_(run.x.size()) {
    recent_.fill(-1);
  }

  Outcome step() {
    run_.linearise(run_.x);
    run_.equations().apply_transposed(run_.f, gradient_);
    const double slope = gradient_.norm();
    if (!std::isfinite(slope)) return Outcome::non_finite;
    if (slope == 0) return Outcome::singular_matrix;
    run_.equations().apply(gradient_, image_);
    const double bend = image_.norm();
    if (!std::isfinite(bend)) return Outcome::non_finite;
    const double cosine = slope / bend * (slope / run_.norm);  // angle of F and B g
    if (!(cosine * cosine >= least_cosine_squared)) return Outcome::not_converged;
    const double alpha = first_alpha(slope / bend * (slope / bend));
    before_ = gradient_;
    place_ = run_.x;
    return search(alpha, slope);
  }

 private:
  // Called while before_ still holds the gradient of the previous iterate.
  [[nodiscard]] double first_alpha(double cauchy) const {
    if (method_.length == SteepestDescent::Length::cauchy || run_.report.statistics.steps == 0) return cauchy;
    const double ss = (run_.x - place_).squaredNorm();
    const double sy = (run_.x - place_).dot(gradient_ - before_);
    return sy > 0 && std::isfinite(ss / sy) ? ss / sy : cauchy;
  }

  Outcome search(double alpha, double slope) {
    const std::size_t memory = method_.length == SteepestDescent::Length::cauchy ? 1 : recent_.size();
    recent_[static_cast<std::size_t>(run_.report.statistics.steps) % memory] = run_.norm;
    const double greatest = *std::max_element(recent_.begin(), recent_.end());
    for (int k = 0; k < halvings; ++k, alpha /= 2) {
      run_.trial = run_.x - alpha * gradient_;
      run_.evaluate_trial();
      // Written in norms, so that no square overflows.
      const double part = 2e-4 * alpha * (slope / greatest) * (slope / greatest);
      if (run_.trial_norm <= greatest * std::sqrt(std::max(0.0, 1 - part)) && run_.trial_norm < HUGE_VAL)
        return run_.accept();
      run_.reject();
      if (run_.is_spent()) return Outcome::step_limit;
    }
    return Outcome::not_converged;
  }

  const SteepestDescent& method_;
  SolverRun& run_;
  Eigen::VectorXd gradient_, before_, image_, place_;
  std::array<double, 10> recent_;  // |F|
};

class Optimal {
 public:
  Optimal(const OptimalIterative& method, SolverRun& run)
      : method_(method),
        run_(run),
        g_(run.x.size()),
        v1_(run.x.size()),
        v2_(run.x.size()),
        u_(run.x.size()) {}

  Outcome step() {
    const Outcome outcome = driving_vector();
    if (outcome != Outcome::success) return outcome;
    double part = 1 - method_.gamma;
    for (int k = 0; k < halvings; ++k, part /= 2) {
      run_.trial = run_.x - part * u_;
      run_.evaluate_trial();
      if (std::isfinite(run_.trial_norm)) return run_.accept();
      run_.reject();
      if (run_.is_spent()) return Outcome::step_limit;
    }
    return Outcome::non_finite;
  }

 private:
  // Computes u, scaled so that v = B u is the projection of F: Gram-Schmidt starting with B B^T F, which is
  // not normal to F unless B^T F = 0.
  Outcome driving_vector() {
    const Eigen::VectorXd& f = run_.f;
    run_.linearise(run_.x);
    run_.equations().apply_transposed(f, g_);
    const double slope = g_.norm();
    if (!std::isfinite(slope)) return Outcome::non_finite;
    if (slope == 0) return Outcome::singular_matrix;
    g_ /= slope;
    u_ = f / run_.norm;
    run_.equations().apply(g_, v2_);
    run_.equations().apply(u_, v1_);
    const double length2 = v2_.norm(), length1 = v1_.norm();
    if (!std::isfinite(length1 + length2)) return Outcome::non_finite;
    v2_ /= length2;
    double projected = v2_.dot(f), cosine = projected / run_.norm, cosine2 = cosine * cosine;
    const double along = v2_.dot(v1_);
    v1_ -= along * v2_;
    const double normal = v1_.norm();
    if (normal > 1e-10 * length1) {  // else B F adds only rounding errors
      v1_ /= normal;
      const double second = v1_.dot(f);
      u_ = (second / normal) * u_ + ((projected - second * along / normal) / length2) * g_;
      cosine2 += second / run_.norm * (second / run_.norm);
    } else {
      u_ = projected / length2 * g_;
    }
    if (!u_.allFinite()) return Outcome::singular_matrix;
    return cosine2 >= least_cosine_squared ? Outcome::success : Outcome::not_converged;
  }

  const OptimalIterative& method_;
  SolverRun& run_;
  Eigen::VectorXd g_, v1_, v2_, u_;
};

}  // namespace

Report find_root(const SteepestDescent& method, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  return iterate<Descent>("steepest-descent", method, equations, x, observer, stationary);
}

Report find_root(const OptimalIterative& method, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  constexpr const char* name = "optimal-iterative";
  require_option(name, method.gamma >= 0 && method.gamma < 1, "gamma", method.gamma, "from 0 to below 1");
  return iterate<Optimal>(name, method, equations, x, observer, stationary);
}

}  // namespace nlmech::algebraic

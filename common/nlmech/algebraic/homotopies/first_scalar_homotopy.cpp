#include "nlmech/algebraic/homotopies/first_scalar_homotopy.hpp"

#include <cmath>
#include <numbers>

#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::VectorXd;

constexpr const char* first_homotopy = "scalar-homotopy";

class Pass {
 public:
  Pass(const FirstScalarHomotopy& method, SolverRun& run)
      : method_(method), run_(run), origin_(run.x), way_(run.x.size()), w_(run.x.size()), f_(run.x.size()) {}

  Outcome step() {
    const double h = std::numbers::pi / 2 / method_.steps, phi = h * taken_;
    if (taken_ == 0) begin();
    Outcome outcome = velocity(run_.x, phi, run_.f, run_.norm);
    if (outcome != Outcome::success) return outcome;
    run_.trial = run_.x + h / 2 * w_;
    const double norm = run_.evaluate(run_.trial, f_);
    if (!(norm < HUGE_VAL)) return Outcome::non_finite;
    outcome = velocity(run_.trial, phi + h / 2, f_, norm);
    if (outcome != Outcome::success) return outcome;
    run_.trial = run_.x + h * w_;
    run_.evaluate_trial();
    if (!(run_.trial_norm < HUGE_VAL)) return Outcome::non_finite;
    taken_ = (taken_ + 1) % method_.steps;
    return run_.accept(taken_ == 0 ? 1 : std::pow(std::sin(h * taken_), 2));
  }

 private:
  void begin() {
    origin_ = run_.x;
    if (method_.weight > 0) return;
    run_.linearise(run_.x);
    run_.equations().apply_transposed(run_.f, w_);
    run_.equations().apply(w_, way_);
    weight_ = w_.norm() / way_.norm();
  }

  // dx/dphi = dx/dt 2 sin phi cos phi, into w_.
  Outcome velocity(const VectorXd& x, double phi, const VectorXd& f, double norm) {
    const double s = std::sin(phi), c = std::cos(phi);
    run_.linearise(x);
    run_.equations().apply_transposed(f, w_);
    if (phi > 0) {
      way_ = x - origin_;
      w_ = s * s * weight_ * weight_ * w_ - c * c * way_;
    }
    const double slope = w_.norm();
    if (!std::isfinite(slope)) return Outcome::non_finite;
    if (slope == 0) return Outcome::singular_matrix;
    if (phi > 0) {
      const double length = std::hypot(weight_ * norm, way_.norm());
      w_ *= -s * c * (length / slope) * (length / slope);
    } else {
      w_ *= -weight_ * norm / slope;  // the limit for a path that starts along -B^T F
    }
    return w_.allFinite() ? Outcome::success : Outcome::singular_matrix;
  }

  const FirstScalarHomotopy& method_;
  SolverRun& run_;
  VectorXd origin_, way_, w_, f_;
  double weight_ = method_.weight;
  int taken_ = 0;  // steps of this pass
};

}  // namespace

Report find_root(const FirstScalarHomotopy& method, Equations& equations, VectorXd& x,
                 const Observer& observer) {
  require_option(first_homotopy, method.steps >= 1, "steps", method.steps, "at least 1");
  require_option(first_homotopy, method.weight >= 0 && std::isfinite(method.weight), "weight", method.weight,
                 "0 or positive");
  return iterate<Pass>(
      first_homotopy, method, equations, x, observer,
      {Outcome::singular_matrix,
       "the flow has no direction: dh/dx is 0, as where |F| is stationary; start elsewhere"});
}

}  // namespace nlmech::algebraic

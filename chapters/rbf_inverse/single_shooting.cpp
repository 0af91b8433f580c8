#include "chapters/rbf_inverse/single_shooting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "chapters/rbf_inverse/variational.hpp"
#include "nlmech/algebraic/equations.hpp"
#include "nlmech/ivp/dormand_prince.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The end conditions as functions of x(t_0), flown when that changes.
class Arc {
 public:
  Arc(const bvp::Problem& problem, const SingleShooting& method)
      : problem_(problem), n_(problem.states()), method_(method), system_(Variational{&problem}) {}

  void residual(const VectorXd& x, VectorXd& f) {
    fly(x);
    f.resize(n_);
    problem_.conditions(ends_, VectorXd(), f);
  }
  void derivative(const VectorXd& x, MatrixXd& b) {
    fly(x);
    MatrixXd by_ends = MatrixXd::Zero(n_, 2 * n_), none(n_, 0);
    problem_.condition_jacobian(ends_, VectorXd(), by_ends, none);
    b = by_ends.leftCols(n_) + by_ends.rightCols(n_) * transition_;
  }
  [[nodiscard]] double reach() const { return reach_; }

 private:
  void fly(const VectorXd& x) {
    if (ends_.cols() == 2 && ends_.col(0) == x) return;
    const double none = std::numeric_limits<double>::quiet_NaN();
    ends_ = MatrixXd::Constant(n_, 2, none);
    ends_.col(0) = x;
    transition_ = MatrixXd::Constant(n_, n_, none);
    if (!x.allFinite()) return;
    reach_ = std::max(reach_, x.norm());
    const ivp::Ode45 method{.relative_tolerance = method_.tolerance, .absolute_tolerance = method_.tolerance};
    const std::vector<double> points = problem_.points();
    // A flight that needs more steps goes off to infinity, or swings too fast to be an answer.
    const auto s =
        ivp::integrate(system_, with_identity(x), points.front(), points.back(), method, {}, {.steps = 1000});
    if (!s.status.ok()) return;
    ends_.col(1) = s.x.head(n_);
    transition_ = s.x.tail(n_ * n_).reshaped(n_, n_);
  }

  const bvp::Problem& problem_;
  Index n_;
  SingleShooting method_;
  ivp::System<Eigen::Dynamic> system_;
  MatrixXd ends_, transition_;
  double reach_ = 0;
};

}  // namespace

SingleShot shoot_once(const bvp::Problem& problem, const VectorXd& first, const SingleShooting& method) {
  Arc arc(problem, method);
  VectorXd x = first, f(problem.states());
  algebraic::DenseEquations equations(
      first.size(), [&](const VectorXd& v, VectorXd& r) { arc.residual(v, r); },
      [&](const VectorXd& v, MatrixXd& b) { arc.derivative(v, b); });
  // Errors of a flight, some hundred tolerances, are the noise of the updates.
  const double tolerance = 10 * method.tolerance, noise = 1e4 * method.tolerance;
  const algebraic::Report report =
      find_root(algebraic::Newton{.tolerance = tolerance, .noise = noise, .iterations = method.iterations},
                equations, x);
  arc.residual(x, f);
  SingleShot shot{report.status, x, f.cwiseAbs().maxCoeff(), arc.reach(),
                  report.statistics.newton_iterations};
  const double allowed = 1e-6 * (1 + x.norm());
  if (shot.status.ok() && !(shot.miss <= allowed)) {
    shot.status = Status::failure(
        Outcome::not_converged,
        fmt::format("single shooting: the updates end where the end is missed by {:.3g}; allowed are {:.3g}",
                    shot.miss, allowed));
  }
  return shot;
}

}  // namespace nlmech::chapters::rbf_inverse

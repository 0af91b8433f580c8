#include "chapters/rbf_inverse/control/shooting_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Variational equations for integrators: x, then the columns of its n by n derivative with respect to the
/// initial value.
struct Variational {
  static constexpr int dimension = Eigen::Dynamic;  ///< size known at run time
  const bvp::Problem* problem;                      ///< must outlive the system

  [[nodiscard]] int size() const { return problem->states() * (1 + problem->states()); }
  void operator()(const double& t, const VectorXd& y, VectorXd& dydt) const {
    const Index n = problem->states();
    VectorXd slope(n);
    MatrixXd by_state(n, n), none(n, 0);
    const VectorXd x = y.head(n);
    problem->rhs(t, x, VectorXd(), slope);
    problem->jacobian(t, x, VectorXd(), by_state, none);
    dydt.resize(y.size());
    dydt.head(n) = slope;
    dydt.tail(n * n) = (by_state * y.tail(n * n).reshaped(n, n)).reshaped();
  }
  /// Not needed by explicit methods and fixed-point iterations.
  void jacobian(double /*t*/, const VectorXd& /*y*/, MatrixXd& /*j*/) const {
    throw std::logic_error("the variational equations give no Jacobian");
  }
};

using System = ivp::System;
using Integration =
    std::function<ivp::Solution(const System& system, const VectorXd& y, double t0, double t1)>;

/// End conditions and continuity conditions as functions of the states at the starts of the segments;
/// integrates when these change.
class Segments {
 public:
  Segments(const bvp::Problem& problem, int count, Integration integration)
      : problem_(problem),
        n_(problem.states()),
        count_(count),
        integration_(std::move(integration)),
        system_(Variational{&problem}) {}
  [[nodiscard]] double time(Index k) const {
    const std::vector<double> points = problem_.points();
    return points.front() +
           (points.back() - points.front()) * static_cast<double>(k) / static_cast<double>(count_);
  }

  /// Largest Euclidean norm of the iterates.
  [[nodiscard]] double reach() const { return reach_; }

  void residual(const VectorXd& x, VectorXd& f) {
    integrate_from(x);
    f.resize(n_ * count_);
    for (Index k = 1; k < count_; ++k) f.segment(k * n_, n_) = ends_.col(k - 1) - x.segment(k * n_, n_);
    VectorXd r(n_);
    problem_.conditions(outer(x), VectorXd(), r);
    f.head(n_) = r;
  }
  void derivative(const VectorXd& x, MatrixXd& b) {
    integrate_from(x);
    b = MatrixXd::Zero(n_ * count_, n_ * count_);
    const Index last = count_ - 1;
    for (Index k = 0; k < last; ++k) {
      b.block((k + 1) * n_, k * n_, n_, n_) = transitions_.middleCols(k * n_, n_);
      b.block((k + 1) * n_, (k + 1) * n_, n_, n_) = -MatrixXd::Identity(n_, n_);
    }
    MatrixXd by_ends = MatrixXd::Zero(n_, 2 * n_), none(n_, 0);
    problem_.condition_jacobian(outer(x), VectorXd(), by_ends, none);
    b.block(0, 0, n_, n_) += by_ends.leftCols(n_);
    b.block(0, last * n_, n_, n_) += by_ends.rightCols(n_) * transitions_.middleCols(last * n_, n_);
  }
  /// Solves for the states at the starts of all segments.
  template <class Method>
  ShootingResult solve(const Method& method, VectorXd x) {
    algebraic::DenseEquations equations(
        x.size(), [&](const VectorXd& v, VectorXd& f) { residual(v, f); },
        [&](const VectorXd& v, MatrixXd& b) { derivative(v, b); });
    const algebraic::Report report = find_root(method, equations, x);
    return {report.status, x.head(n_), 0, 0, report.statistics.newton_iterations};
  }

 private:
  [[nodiscard]] MatrixXd outer(const VectorXd& x) const {
    MatrixXd both(n_, 2);
    both << x.head(n_), ends_.rightCols(1);
    return both;
  }
  void integrate_from(const VectorXd& x) {
    if (integrated_.size() == x.size() && integrated_ == x) return;
    integrated_ = x;
    ends_ = MatrixXd::Constant(n_, count_, std::numeric_limits<double>::quiet_NaN());
    transitions_ = ends_.replicate(1, n_);
    if (!x.allFinite()) return;
    reach_ = std::max(reach_, x.norm());
    for (Index k = 0; k < count_; ++k) {
      VectorXd y(n_ + n_ * n_);
      y << x.segment(k * n_, n_), MatrixXd::Identity(n_, n_).reshaped();
      const auto s = integration_(system_, y, time(k), time(k + 1));
      if (!s.status.ok()) {
        ends_.setConstant(std::numeric_limits<double>::quiet_NaN());
        return;
      }
      ends_.col(k) = s.x.head(n_);
      transitions_.middleCols(k * n_, n_) = s.x.tail(n_ * n_).reshaped(n_, n_);
    }
  }

  const bvp::Problem& problem_;
  Index n_, count_;
  Integration integration_;
  System system_;
  VectorXd integrated_;
  MatrixXd ends_, transitions_;
  double reach_ = 0;
};

}  // namespace

ShootingResult shoot_once(const bvp::Problem& problem, const VectorXd& first, const SingleShooting& method) {
  const ivp::Ode45 ode45{.relative_tolerance = method.tolerance, .absolute_tolerance = method.tolerance};
  // A trajectory that needs more steps diverges, or oscillates too fast to be a solution.
  Segments segments(problem, 1, [&](const System& system, const VectorXd& y, double t0, double t1) {
    return ivp::integrate(system, y, t0, t1, ode45, {}, {.steps = 1000});
  });
  // Integration errors of some hundred tolerances limit the accuracy of the updates.
  ShootingResult shot = segments.solve(algebraic::Newton{.tolerance = 10 * method.tolerance,
                                                         .noise = 1e4 * method.tolerance,
                                                         .iterations = method.iterations},
                                       first);
  VectorXd f;
  segments.residual(shot.first, f);
  shot.miss = f.cwiseAbs().maxCoeff();
  shot.reach = segments.reach();
  const double allowed = 1e-6 * (1 + shot.first.norm());
  if (shot.status.ok() && !(shot.miss <= allowed)) {
    shot.status = Status::failure(
        Outcome::not_converged,
        fmt::format("single shooting: the updates end where the end is missed by {:.3g}; allowed are {:.3g}",
                    shot.miss, allowed));
  }
  return shot;
}

ShootingResult shoot(const bvp::Problem& problem, const bvp::Start& start, const MultipleShooting& method) {
  const peers::Cvode cvode{.formula = peers::Cvode::Formula::adams,
                           .relative_tolerance = method.tolerance,
                           .absolute_tolerance = method.tolerance};
  Segments segments(problem, method.segments,
                    [&](const System& system, const VectorXd& y, double t0, double t1) {
                      return integrate(system, y, t0, t1, cvode, {}, {.steps = 20'000});
                    });
  const Index n = problem.states();
  VectorXd x(n * method.segments), at(n);
  for (Index k = 0; k < method.segments; ++k) {
    start.states(segments.time(k), at);
    x.segment(k * n, n) = at;
  }
  return segments.solve(algebraic::DampedNewton{.tolerance = 10 * method.tolerance,
                                                .noise = 1e3 * method.tolerance,
                                                .iterations = method.iterations},
                        x);
}

bool multiple_shooting_available() { return peers::cvode_available(); }

}  // namespace nlmech::chapters::rbf_inverse

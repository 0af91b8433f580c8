#include "chapters/rbf_inverse/multiple_shooting.hpp"

#include <limits>

#include "chapters/rbf_inverse/variational.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/peers/ivp/cvode.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The joints and the end conditions, flown when x changes.
class Segments {
 public:
  Segments(const bvp::Problem& problem, const MultipleShooting& method)
      : problem_(problem), method_(method), n_(problem.states()), system_(Variational{&problem}) {
    const std::vector<double> points = problem.points();
    for (int k = 0; k <= method.segments; ++k)
      times_.push_back(points.front() + (points.back() - points.front()) * k / method.segments);
  }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] Index size() const { return n_ * method_.segments; }
  [[nodiscard]] std::int64_t flights() const { return flights_; }

  void residual(const VectorXd& x, VectorXd& f) {
    fly(x);
    f.resize(size());
    for (int k = 0; k + 1 < method_.segments; ++k)
      f.segment((k + 1) * n_, n_) = ends_.col(k) - x.segment((k + 1) * n_, n_);
    VectorXd r(n_);
    problem_.conditions(outer(x), VectorXd(), r);
    f.head(n_) = r;
  }
  void derivative(const VectorXd& x, MatrixXd& b) {
    fly(x);
    b = MatrixXd::Zero(size(), size());
    const Index last = method_.segments - 1;
    for (Index k = 0; k < last; ++k) {
      b.block((k + 1) * n_, k * n_, n_, n_) = transitions_.middleCols(k * n_, n_);
      b.block((k + 1) * n_, (k + 1) * n_, n_, n_) = -MatrixXd::Identity(n_, n_);
    }
    MatrixXd by_ends = MatrixXd::Zero(n_, 2 * n_), none(n_, 0);
    problem_.condition_jacobian(outer(x), VectorXd(), by_ends, none);
    b.block(0, 0, n_, n_) += by_ends.leftCols(n_);
    b.block(0, last * n_, n_, n_) += by_ends.rightCols(n_) * transitions_.middleCols(last * n_, n_);
  }

 private:
  [[nodiscard]] MatrixXd outer(const VectorXd& x) const {
    MatrixXd both(n_, 2);
    both << x.head(n_), ends_.rightCols(1);
    return both;
  }
  void fly(const VectorXd& x) {
    if (flown_.size() == x.size() && flown_ == x) return;
    flown_ = x;
    ++flights_;
    ends_.resize(n_, method_.segments);
    transitions_.resize(n_, n_ * method_.segments);
    const peers::Cvode cvode{.formula = peers::Cvode::Formula::adams,
                             .relative_tolerance = method_.tolerance,
                             .absolute_tolerance = method_.tolerance};
    for (int k = 0; k < method_.segments; ++k) {
      const VectorXd y = with_identity(x.segment(k * n_, n_));
      const auto at = static_cast<std::size_t>(k);
      const ivp::Solution<Eigen::Dynamic> s =
          integrate(system_, y, times_[at], times_[at + 1], cvode, {}, {.steps = 20'000});
      if (!s.status.ok()) {
        ends_.setConstant(std::numeric_limits<double>::quiet_NaN());
        return;
      }
      ends_.col(k) = s.x.head(n_);
      transitions_.middleCols(k * n_, n_) = s.x.tail(n_ * n_).reshaped(n_, n_);
    }
  }

  const bvp::Problem& problem_;
  MultipleShooting method_;
  Index n_;
  ivp::System<Eigen::Dynamic> system_;
  std::vector<double> times_;
  VectorXd flown_;
  MatrixXd ends_, transitions_;
  std::int64_t flights_ = 0;
};

}  // namespace

bool multiple_shooting_available() { return peers::cvode_available(); }

ShotSolution shoot(const bvp::Problem& problem, const bvp::Start& start, const MultipleShooting& method) {
  Segments segments(problem, method);
  const Index n = problem.states();
  VectorXd x(segments.size()), at(n);
  for (int k = 0; k < method.segments; ++k) {
    start.states(segments.times()[static_cast<std::size_t>(k)], at);
    x.segment(k * n, n) = at;
  }
  algebraic::DenseEquations equations(
      segments.size(), [&](const VectorXd& v, VectorXd& f) { segments.residual(v, f); },
      [&](const VectorXd& v, MatrixXd& b) { segments.derivative(v, b); });
  const algebraic::Report report = find_root(algebraic::DampedNewton{.tolerance = 10 * method.tolerance,
                                                                     .noise = 1e3 * method.tolerance,
                                                                     .iterations = method.iterations},
                                             equations, x);
  return {report.status, x.head(n), report.statistics.newton_iterations, segments.flights()};
}

}  // namespace nlmech::chapters::rbf_inverse

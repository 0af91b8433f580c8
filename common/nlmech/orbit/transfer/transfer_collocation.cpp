
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::orbit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The discrete equations in units in which the unknowns are near 1.
class Discrete {
 public:
  Discrete(const TransferProblem& problem, const TransferCollocation& method) : n_(method.nodes) {
    length_ = method.length_unit > 0 ? method.length_unit : problem.from.stableNorm();
    time_ = method.time_unit > 0 ? method.time_unit : length_ * std::sqrt(length_ / problem.gravity.mu);
    gravity_ = problem.gravity;
    gravity_.mu = problem.gravity.mu / length_ * (time_ / length_) * (time_ / length_);
    gravity_.radius /= length_;
    from_ = problem.from / length_;
    to_ = problem.to / length_;
    duration_ = problem.time / time_;
    times_ = (collocation::legendre_gauss_lobatto(method.nodes).array() + 1) / 2 * duration_;
    times_[n_ - 1] = duration_;
    const double shape = (method.shape > 0 ? method.shape : (method.nodes + 3) / 4.0) / duration_;
    switch (method.basis) {
      case TransferBasis::polynomial:
        d_ = collocation::polynomial_differentiation_matrix<double>(times_);
        break;
      case TransferBasis::stable_gaussian:
        d_ = collocation::StableGaussian(times_, shape).differentiation_matrix();
        break;
      default: {
        auto found = collocation::radial_differentiation(times_, collocation::Kernel::gaussian, shape);
        condition_ = found.condition;
        d_ = std::move(found.matrix);
        status_ = found.status;
      }
    }
    full_ = method.equations == TransferEquations::positions_and_velocities;
    if (d_.size() > 0 && !full_) d2_ = d_ * d_;
  }

  /// Is there a differentiation matrix? An unsuitable shape is not rejected, so that its effect can be
  /// studied.
  [[nodiscard]] bool possible() const { return d_.size() > 0; }
  [[nodiscard]] const Status& status() const { return status_; }
  [[nodiscard]] double condition() const { return condition_; }
  [[nodiscard]] Index size() const { return full_ ? 6 * n_ : 3 * (n_ - 2); }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const VectorXd& times() const { return times_; }

  /// Unknowns for positions at the nodes, in the units of the problem.
  [[nodiscard]] VectorXd unknowns(const std::function<Vector3<double>(double)>& position) const {
    Eigen::MatrixX3d r(n_, 3);
    for (Index j = 0; j < n_; ++j) r.row(j) = position(times_[j] * time_).transpose() / length_;
    VectorXd x(size());
    if (!full_) {
      for (Index k = 0; k < 3; ++k) x.segment(k * (n_ - 2), n_ - 2) = r.col(k).segment(1, n_ - 2);
      return x;
    }
    const Eigen::MatrixX3d v = d_ * r;
    for (Index k = 0; k < 3; ++k) {
      x.segment(k * n_, n_) = r.col(k);
      x.segment((3 + k) * n_, n_) = v.col(k);
    }
    return x;
  }
  /// Positions at the nodes, one row per node.
  [[nodiscard]] Eigen::MatrixX3d positions(const VectorXd& x) const {
    Eigen::MatrixX3d r(n_, 3);
    for (Index k = 0; k < 3; ++k) {
      if (full_) {
        r.col(k) = x.segment(k * n_, n_);
      } else {
        r(0, k) = from_[static_cast<int>(k)];
        r(n_ - 1, k) = to_[static_cast<int>(k)];
        r.col(k).segment(1, n_ - 2) = x.segment(k * (n_ - 2), n_ - 2);
      }
    }
    return r;
  }
  [[nodiscard]] Eigen::MatrixX3d velocities(const VectorXd& x) const {
    if (!full_) return d_ * positions(x);
    Eigen::MatrixX3d v(n_, 3);
    for (Index k = 0; k < 3; ++k) v.col(k) = x.segment((3 + k) * n_, n_);
    return v;
  }

  /// F(x) of Eq. 5.37, or with the velocities D r inserted.
  void residual(const VectorXd& x, VectorXd& f) const {
    const Eigen::MatrixX3d r = positions(x);
    Eigen::MatrixX3d a(n_, 3);
    for (Index j = 0; j < n_; ++j)
      a.row(j) = acceleration<double>(r.row(j).transpose(), gravity_).transpose();
    if (!full_) {
      const Eigen::MatrixX3d rest = d2_ * r - a;
      for (Index k = 0; k < 3; ++k) f.segment(k * (n_ - 2), n_ - 2) = rest.col(k).segment(1, n_ - 2);
      return;
    }
    for (Index k = 0; k < 3; ++k) {
      const auto v = x.segment((3 + k) * n_, n_);
      f.segment(k * n_, n_) = d_ * r.col(k) - v;
      f.segment((3 + k) * n_, n_) = d_ * v - a.col(k);
      f[(3 + k) * n_] = r(0, k) - from_[static_cast<int>(k)];
      f[(4 + k) * n_ - 1] = r(n_ - 1, k) - to_[static_cast<int>(k)];
    }
  }
  /// dF/dx.
  void derivative(const VectorXd& x, MatrixXd& b) const {
    const Eigen::MatrixX3d r = positions(x);
    const Index m = full_ ? n_ : n_ - 2, row = full_ ? 3 * n_ : 0, shift = full_ ? 0 : 1;
    b.setZero();
    for (Index k = 0; k < 3; ++k) {
      if (full_) {
        b.block(k * n_, k * n_, n_, n_) = d_;
        b.block(k * n_, (3 + k) * n_, n_, n_).diagonal().setConstant(-1);
        b.block((3 + k) * n_, (3 + k) * n_, n_, n_) = d_;
        b.row((3 + k) * n_).setZero();
        b.row((4 + k) * n_ - 1).setZero();
        b((3 + k) * n_, k * n_) = b((4 + k) * n_ - 1, (k + 1) * n_ - 1) = 1;
      } else {
        b.block(k * m, k * m, m, m) = d2_.block(1, 1, m, m);
      }
    }
    for (Index j = 1; j < n_ - 1; ++j) {
      Vector3<Dual<double, 3>> place;
      for (int k = 0; k < 3; ++k) place[k] = Dual<double, 3>::variable(r(j, k), k);
      const Vector3<Dual<double, 3>> a = acceleration(place, gravity_);
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l)
          b(row + k * m + j - shift, l * m + j - shift) -= a[k].partial[static_cast<std::size_t>(l)];
      }
    }
  }

 private:
  Index n_;
  bool full_ = false;
  double length_ = 1, time_ = 1, duration_ = 1, condition_ = 1;
  Gravity gravity_;
  Vector3<double> from_, to_;
  VectorXd times_;
  MatrixXd d_, d2_;
  Status status_;
};

/// Position on an arc from r_0 to r_F about the centre, the short way; for opposite positions about the given
/// normal.
[[nodiscard]] Vector3<double> on_arc(const TransferProblem& p, double share) {
  const double r1 = p.from.norm(), r2 = p.to.norm();
  const Vector3<double> u1 = p.from / r1, u2 = p.to / r2;
  Vector3<double> axis = u1.cross(u2);
  if (axis.norm() < 1e-12) axis = p.normal ? *p.normal : u1.unitOrthogonal();
  const double angle = std::atan2(u1.cross(u2).norm(), u1.dot(u2));
  return (r1 + share * (r2 - r1)) * (Eigen::AngleAxisd(share * angle, axis.normalized()) * u1);
}

[[nodiscard]] VectorXd start(const TransferProblem& p, const TransferCollocation& method,
                             const Discrete& discrete) {
  if (method.start) return discrete.unknowns(method.start);
  switch (method.guess) {
    case TransferGuess::line:
      return discrete.unknowns(
          [&](double t) { return Vector3<double>(p.from + t / p.time * (p.to - p.from)); });
    case TransferGuess::arc: return discrete.unknowns([&](double t) { return on_arc(p, t / p.time); });
    case TransferGuess::ones: return VectorXd::Ones(discrete.size());
    case TransferGuess::random: break;
  }
  std::mt19937_64 engine(method.seed);
  std::normal_distribution<double> normal;
  VectorXd x(discrete.size());
  for (double& value : x) value = normal(engine);
  return x;
}

void check_method(const TransferCollocation& m) {
  const auto require = [](bool fine, const char* what, double value) {
    if (!fine) throw invalid_argument("transfer by collocation: {}, not {}", what, value);
  };
  require(m.nodes >= 4 && m.nodes <= 200, "the number of nodes must be from 4 to 200", m.nodes);
  require(m.shape >= 0 && std::isfinite(m.shape), "the shape must be positive, or 0 for the printed one",
          m.shape);
  require(m.length_unit >= 0 && std::isfinite(m.length_unit), "the unit of length must be positive",
          m.length_unit);
  require(m.time_unit >= 0 && std::isfinite(m.time_unit), "the unit of time must be positive", m.time_unit);
  require(m.iterations >= 1, "the number of iterations must be at least 1", m.iterations);
  require(m.tolerance > 0, "the tolerance must be positive", m.tolerance);
  require(m.largest_miss > 0, "the largest miss must be positive", m.largest_miss);
}

void check_problem(const TransferProblem& p) {
  check(p.gravity);
  check(State{p.from, {0, 0, 0}}, "transfer, the departure");
  check(State{p.to, {0, 0, 0}}, "transfer, the arrival");
  if (!(p.time > 0) || !std::isfinite(p.time))
    throw invalid_argument("transfer: the time of flight must be positive and finite, not {}", p.time);
}

}  // namespace

CollocatedTransfer collocate(const TransferProblem& problem, const TransferCollocation& method) {
  check_problem(problem);
  check_method(method);
  const Stopwatch watch;
  const Discrete discrete(problem, method);
  CollocatedTransfer result;
  result.condition = discrete.condition();
  result.miss = std::numeric_limits<double>::infinity();
  if (!discrete.possible()) {
    result.status = discrete.status();
    return result;
  }
  VectorXd x = start(problem, method, discrete);
  algebraic::Workspace<VectorXd> workspace(discrete.size());
  // For an ill-conditioned matrix updates stall at the rounding level, hence `noise`.
  const algebraic::Newton newton{
      .tolerance = method.tolerance, .noise = 1e-5, .iterations = method.iterations};
  const Outcome outcome = algebraic::solve(
      newton, [&](const VectorXd& at, VectorXd& f) { discrete.residual(at, f); },
      [&](const VectorXd& at, MatrixXd& b) { discrete.derivative(at, b); }, x, workspace, result.statistics);
  result.statistics.seconds = watch.seconds();
  if (outcome != Outcome::success) {
    result.status = failed_with(outcome,
                                "transfer by collocation: Newton's iteration with {} nodes ended after {} "
                                "steps ({}); start from another guess, or with more nodes",
                                method.nodes, result.statistics.newton_iterations, to_string(outcome));
    return result;
  }
  const double speed = discrete.length() / discrete.time();
  result.times = discrete.times() * discrete.time();
  result.positions = discrete.positions(x).transpose() * discrete.length();
  result.velocities = discrete.velocities(x).transpose() * speed;
  result.v1 = result.velocities.col(0);
  result.v2 = result.velocities.rightCols(1);
  result.miss = miss_of(problem, result.v1);
  if (!(result.miss <= method.largest_miss * problem.to.stableNorm())) {
    result.status =
        failed_with(Outcome::spurious_root,
                    "transfer by collocation: the {} discrete equations are solved, but the orbit with the "
                    "velocity found, integrated, misses by {:.3g}; take more nodes, or another start",
                    discrete.size(), result.miss);
  }
  return result;
}

}  // namespace nlmech::orbit

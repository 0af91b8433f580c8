#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "nlmech/bvp/optimal_control/extremal.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int substeps = 8;  // of the implicit midpoint rule per piece of the control

/// Classifies by the eigenvalues of the Hessian of the cost on the directions v with r v = 0 for every row r
/// of @p held. The rows must be linearly independent.
SecondOrder classify(const MatrixXd& hessian, const std::vector<Eigen::RowVectorXd>& conditions) {
  const auto count = static_cast<Index>(conditions.size());
  MatrixXd reduced = hessian;
  if (count > 0) {
    MatrixXd rows(count, hessian.rows());
    for (Index i = 0; i < count; ++i) rows.row(i) = conditions[static_cast<std::size_t>(i)];
    const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(rows.transpose()).householderQ();
    const MatrixXd null = q.rightCols(hessian.rows() - count);
    reduced = null.transpose() * hessian * null;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(reduced, Eigen::EigenvaluesOnly);
  const VectorXd& values = eigen.eigenvalues();
  SecondOrder result;
  result.least = values.minCoeff();
  result.tolerance = 1e-6 * std::max(1.0, values.maxCoeff());
  result.negative = static_cast<int>((values.array() < -result.tolerance).count());
  result.kind = result.negative > 0               ? Kind::saddle
                : result.least > result.tolerance ? Kind::minimum
                                                  : Kind::degenerate;
  return result;
}

/// Linearised trajectories dx = S v and the Hessian of the cost in v: the free components of dx(t_0), then
/// the controls, scaled so that |v|^2 is the integral of |du|^2.
class Variation {
 public:
  Variation(const ExtremalProblem& problem, const Solution& solution, int pieces)
      : problem_(problem),
        solution_(solution),
        model_(problem.model()),
        n_(model_.states()),
        q_(model_.controls()),
        pieces_(pieces) {
    for (int i = 0; i < n_; ++i) {
      if (!problem.task().begin[static_cast<std::size_t>(i)]) free_.push_back(i);
    }
    size_ = static_cast<Index>(free_.size()) + Index{pieces} * q_;
    hessian_ = MatrixXd::Zero(size_, size_);
    state_ = MatrixXd::Zero(n_, size_);
    for (std::size_t k = 0; k < free_.size(); ++k) state_(free_[k], static_cast<Index>(k)) = 1;
  }

  SecondOrder result() {
    const MatrixXd start = state_;
    march();
    end_cost(start);
    return classify(hessian_, conditions_);
  }

 private:
  void march() {
    const std::vector<double> points = problem_.points();
    const double t0 = points.front(), length = (points.back() - t0) / pieces_;
    const double stretch = (problem_.final_time(solution_.parameters()) - t0) / (points.back() - t0);
    for (int k = 0; k < pieces_; ++k) {
      // A waypoint inside a piece splits its integration.
      const double from = t0 + k * length, to = k + 1 == pieces_ ? points.back() : t0 + (k + 1) * length;
      std::vector<double> cuts{from};
      for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        if (points[i] > from && points[i] <= to) cuts.push_back(points[i]);
      }
      if (cuts.back() < to) cuts.push_back(to);
      for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double h = (cuts[i + 1] - cuts[i]) / substeps;
        for (int j = 0; j < substeps; ++j) step(k, cuts[i] + (j + 0.5) * h, h * stretch, length * stretch);
        add_waypoints(cuts[i + 1]);
      }
    }
  }

  void step(int piece, double t, double h, double length) {
    const VectorXd& p = solution_.parameters();
    const VectorXd z = solution_.at(t), u = control_at(problem_, solution_, t);
    const Constraints& c = problem_.task().constraints;
    const auto e = model_.expand(problem_.true_time(t, p), z.head(n_), u, z.tail(n_), problem_.task().mu, c);
    // Later controls do not affect the state yet: only the first columns of S are nonzero. The rows of du are
    // the variation of this piece.
    const Index live = static_cast<Index>(free_.size()) + Index{piece + 1} * q_;
    MatrixXd du = MatrixXd::Zero(q_, live);
    for (int i = 0; i < q_; ++i) {
      const bool clipped = std::abs(u[i]) > 0.999 * c.control_limit;
      if (!clipped) du(i, static_cast<Index>(free_.size()) + Index{piece} * q_ + i) = 1 / std::sqrt(length);
    }
    const MatrixXd one = MatrixXd::Identity(n_, n_);
    const Eigen::PartialPivLU<MatrixXd> left(one - h / 2 * e.g_x);
    auto state = state_.leftCols(live);
    const MatrixXd next = left.solve((one + h / 2 * e.g_x) * state + h * e.g_u * du);
    MatrixXd both(n_ + q_, live);
    both << (state + next) / 2, du;
    hessian_.topLeftCorner(live, live).noalias() += h * both.transpose() * (e.hessian * both);
    state = next;
  }

  void add_waypoints(double t) {
    for (const Waypoint& w : problem_.task().waypoints) {
      if (w.t == t) conditions_.push_back(state_.row(w.component));
    }
  }

  void end_cost(const MatrixXd& start) {
    const VectorXd from = solution_.first().head(n_), to = solution_.last().head(n_);
    const EndCost phi = model_.end_cost(from, to, problem_.final_time(solution_.parameters()));
    MatrixXd both(2 * n_, size_);
    both << start, state_;
    hessian_ += both.transpose() * (phi.hessian.topLeftCorner(2 * n_, 2 * n_) * both);
    for (int i = 0; i < n_; ++i) {
      if (problem_.task().end[static_cast<std::size_t>(i)]) conditions_.push_back(state_.row(i));
    }
  }

  const ExtremalProblem& problem_;
  const Solution& solution_;
  const ControlModel& model_;
  int n_, q_, pieces_;
  std::vector<int> free_;
  Index size_ = 0;
  MatrixXd hessian_, state_;
  std::vector<Eigen::RowVectorXd> conditions_;
};

}  // namespace

std::string_view to_string(Kind kind) {
  switch (kind) {
    case Kind::untested: return "untested";
    case Kind::minimum: return "minimum";
    case Kind::saddle: return "saddle";
    case Kind::degenerate: return "degenerate";
  }
  return "unknown";
}

SecondOrder second_order(const ExtremalProblem& problem, const Solution& solution, int pieces) {
  if (pieces < 10 || pieces > 400) {
    throw std::invalid_argument("second_order: " + std::to_string(pieces) + " pieces; 10 to 400 are allowed");
  }
  return Variation(problem, solution, pieces).result();
}

}  // namespace nlmech::bvp

#include "nlmech/ivp/singular_start.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::ivp {
namespace {

using Eigen::Index;

constexpr int node_count = 17;  // nodes of the polynomial, including the start

Status refused(double t0, std::string_view why) {
  return failed_with(Outcome::outside_validity,
                     "the equations are singular at the start t = {:.9g}, where a denominator is zero: {}",
                     t0, why);
}

/// f and df/dx times the distance t - t0 from the start, at a small distance.
struct Limits0 {
  Eigen::VectorXd f;  ///< (t - t0) f
  Eigen::MatrixXd j;  ///< (t - t0) df/dx
};
Limits0 near_start(const System& system, const State& x0, double t0, double distance) {
  State f(x0.size());
  Eigen::MatrixXd j(x0.size(), x0.size());
  const double t = t0 + distance;
  system.rhs(t, x0, f);
  system.jacobian(t, x0, j);
  return {(t - t0) * f, (t - t0) * j};
}

/// Checks the limits at the singular point: success if one smooth solution may start there.
Status examine(const System& system, const State& x0, double t0, double span) {
  const Limits0 far = near_start(system, x0, t0, 1e-6 * span), near = near_start(system, x0, t0, 1e-8 * span);
  if (!near.f.allFinite() || !near.j.allFinite() || !far.j.allFinite())
    return refused(t0, "the equations are not finite near it");
  if (near.j.norm() > 3 * std::max(far.j.norm(), 1.0))
    return refused(
        t0,
        "the equations of first order grow faster than the reciprocal of the distance from it, for "
        "which no power series is implemented; start at another time");
  const double size = std::max(x0.norm(), 1e-300);
  if (near.f.norm() > 1e-6 * size && near.f.norm() > 0.5 * far.f.norm())
    return refused(t0,
                   "these initial values have no smooth solution: the numerator must be zero there too (x' = "
                   "0 in x'' + 2 x'/t = 0)");
  const Eigen::VectorXd real = near.j.eigenvalues().real();
  if (real.maxCoeff() > 1e-3)
    return refused(t0, "these initial values have several solutions; start at another time");
  return {};
}

/// Collocation on one interval.
class Collocation {
 public:
  Collocation(const System& system, const State& x0, double t0)
      : system_(system),
        x0_(x0),
        t0_(t0),
        nodes_((collocation::left_end_and_radau(node_count).array() + 1) / 2),
        weights_(collocation::barycentric_weights(nodes_)),
        slope_(collocation::polynomial_differentiation_matrix(nodes_)) {}

  /// The polynomial on [t0, t0 + @p h], h of either sign; none if Newton's iteration fails or the check
  /// between the nodes does.
  std::optional<StatePolynomial> solve(double h) const {
    Nodes x = x0_.replicate(1, node_count);
    constexpr int most = 25;
    double update = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most; ++k) {
      const double last = std::exchange(update, improve(h, x));
      if (!std::isfinite(update)) return {};
      const bool is_rounding = update < 1e-11 && update > last / 2;
      if (update > 1e-13 && !is_rounding) continue;
      StatePolynomial found(t0_, h, nodes_, x);
      if (is_solution(h, x, found)) return found;
      return {};
    }
    return {};
  }

 private:
  // One step of Newton's iteration. @return the largest change relative to the size of its component
  double improve(double h, Nodes& x) const {
    const Index n = x0_.size(), size = (node_count - 1) * n;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size), j(n, n);
    Eigen::VectorXd rest(size);
    State f(n);
    for (Index row = 1; row < node_count; ++row) {
      const State at = x.col(row);
      const double t = t0_ + h * nodes_[row];
      system_.rhs(t, at, f);
      system_.jacobian(t, at, j);
      rest.segment((row - 1) * n, n) = h * f - x * slope_.row(row).transpose();
      for (Index k = 1; k < node_count; ++k)
        matrix.block((row - 1) * n, (k - 1) * n, n, n).diagonal().setConstant(slope_(row, k));
      matrix.block((row - 1) * n, (row - 1) * n, n, n) -= h * j;
    }
    const Eigen::VectorXd change = matrix.partialPivLu().solve(rest);
    x.rightCols(node_count - 1) += change.reshaped(n, node_count - 1);
    const Eigen::VectorXd sizes = x.cwiseAbs().rowwise().maxCoeff();
    double update = 0;
    for (Index i = 0; i < n; ++i) {
      const double most = change.reshaped(n, node_count - 1).row(i).cwiseAbs().maxCoeff();
      update = std::max(update, most / std::max(sizes[i], 1e-3 * sizes.maxCoeff() + 1e-300));
    }
    return change.allFinite() ? update : std::nan("");
  }
  // Does the polynomial satisfy the equations between the nodes?
  bool is_solution(double h, const Nodes& x, const StatePolynomial& found) const {
    State f(x0_.size()), at(x0_.size());
    const Nodes slopes = x * slope_.transpose();
    const double size = std::max(x.cwiseAbs().maxCoeff(), slopes.cwiseAbs().maxCoeff());
    for (Index k = 0; k + 1 < node_count; ++k) {
      const double tau = (nodes_[k] + nodes_[k + 1]) / 2;
      Eigen::RowVectorXd row;
      collocation::polynomial_row(nodes_, weights_, tau, row);
      found.at(t0_ + h * tau, at);
      system_.rhs(t0_ + h * tau, at, f);
      if (!((slopes * row.transpose() - h * f).cwiseAbs().maxCoeff() <= 1e-12 * size)) return false;
    }
    return true;
  }

  const System& system_;
  const State& x0_;
  double t0_;
  Eigen::VectorXd nodes_, weights_;
  Eigen::MatrixXd slope_;
};

}  // namespace

StatePolynomial::StatePolynomial(double t0, double h, Eigen::VectorXd nodes, Nodes values)
    : t0_(t0),
      h_(h),
      nodes_(std::move(nodes)),
      weights_(collocation::barycentric_weights(nodes_)),
      values_(std::move(values)) {}

void StatePolynomial::at(double t, State& x) const {
  Eigen::RowVectorXd row;
  collocation::polynomial_row(nodes_, weights_, (t - t0_) / h_, row);
  x = values_ * row.transpose();
}

Status begin_at_singular_point(const System& system, const State& x0, double t0, double t1,
                               StatePolynomial& series) {
  constexpr Index most_components = 60;
  if (x0.size() > most_components)
    return refused(t0, fmt::format("a power series is computed for at most {} components", most_components));
  if (Status status = examine(system, x0, t0, t1 - t0); !status.ok()) return status;
  const Collocation collocation(system, x0, t0);
  constexpr int most_halvings = 60;
  double h = t1 - t0;
  for (int k = 0; k < most_halvings && t0 + h != t0; ++k, h /= 2) {
    if (!collocation.solve(h)) continue;
    const std::optional<StatePolynomial> shorter = collocation.solve(h / 4);
    if (!shorter) continue;
    series = *shorter;
    return {};
  }
  return refused(t0, "no power series was found; start at another time");
}

}  // namespace nlmech::ivp

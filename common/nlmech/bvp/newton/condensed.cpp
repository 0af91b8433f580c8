#include "nlmech/bvp/newton/condensed.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// a of x_k' = a x_m.
double coefficient(const Problem& problem, const LinearEquation& e) {
  const int n = problem.states();
  const auto refuse = [&](const char* why) {
    throw invalid_argument("condensed collocation: equation {} for unknown {}: {}", e.equation, e.unknown,
                           why);
  };
  if (e.equation < 0 || e.equation >= n || e.unknown < 0 || e.unknown >= n || e.equation == e.unknown) {
    refuse("no such pair");
  }
  MatrixXd by_state(n, n), none(n, 0);
  VectorXd x(n), f(n);
  double a = 0;
  for (int trial = 0; trial < 3; ++trial) {
    for (Index i = 0; i < n; ++i) x[i] = std::sin(1.7 * trial + 2.3 * static_cast<double>(i));
    const std::vector<double> points = problem.points();
    const double t = points.front() + 0.4 * trial * (points.back() - points.front());
    problem.jacobian(t, x, VectorXd(), by_state, none);
    problem.rhs(t, x, VectorXd(), f);
    if (trial == 0) a = by_state(e.equation, e.unknown);
    const bool alone = by_state.row(e.equation).cwiseAbs().sum() == std::abs(a) && a != 0;
    if (!alone || by_state(e.equation, e.unknown) != a || f[e.equation] != a * x[e.unknown]) {
      refuse("x_k' is not a constant times x_m");
    }
  }
  return a;
}

}  // namespace

CondensedCollocation::CondensedCollocation(const Problem& problem, GlobalCollocation& equations,
                                           const std::vector<LinearEquation>& linear)
    : equations_(equations) {
  const Index nodes = equations.times().size(), all = equations.size();
  std::vector<bool> unknown_gone(static_cast<std::size_t>(all)), row_gone(unknown_gone);
  std::vector<double> factor;
  for (const LinearEquation& e : linear) {
    const double a = coefficient(problem, e);
    for (Index j = 0; j < nodes; ++j) {
      const Index row = e.equation * nodes + j, unknown = e.unknown * nodes + j;
      if (equations.is_replaced(row)) continue;
      if (unknown_gone[static_cast<std::size_t>(unknown)]) {
        throw invalid_argument("condensed collocation: two equations for unknown {}", e.unknown);
      }
      unknown_gone[static_cast<std::size_t>(unknown)] = row_gone[static_cast<std::size_t>(row)] = true;
      gone_.push_back(unknown);
      eliminated_.push_back(row);
      factor.push_back(a);
    }
  }
  for (Index i = 0; i < all; ++i) {
    if (!unknown_gone[static_cast<std::size_t>(i)]) kept_.push_back(i);
    if (!row_gone[static_cast<std::size_t>(i)]) rows_.push_back(i);
  }
  // The eliminated row is (D x_k)_j - a x_m,j; no other eliminated unknown is in it unless x_k is one.
  MatrixXd b;
  equations_.linearise(VectorXd::Zero(all));
  equations_.matrix(b);
  const MatrixXd among = b(eliminated_, gone_);
  by_kept_ = b(eliminated_, kept_);
  for (std::size_t i = 0; i < factor.size(); ++i) {
    const auto row = static_cast<Index>(i);
    if (among.row(row).cwiseAbs().sum() != std::abs(factor[i])) {
      throw std::invalid_argument("condensed collocation: an eliminated unknown needs another one");
    }
    by_kept_.row(row) /= factor[i];
  }
  through_gone_ = b(rows_, gone_) * by_kept_;
}

VectorXd CondensedCollocation::expanded(const VectorXd& some) const {
  VectorXd all(equations_.size());
  all(kept_) = some;
  all(gone_) = by_kept_ * some;
  return all;
}

void CondensedCollocation::residual(const VectorXd& x, VectorXd& f) {
  VectorXd whole(equations_.size());
  equations_.residual(expanded(x), whole);
  f = whole(rows_);
}

void CondensedCollocation::linearise(const VectorXd& x) {
  equations_.linearise(expanded(x));
  MatrixXd b;
  equations_.matrix(b);
  matrix_ = b(rows_, kept_) + through_gone_;
}

}  // namespace nlmech::bvp

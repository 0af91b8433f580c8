#include "nlmech/bvp/optimal_control/printed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// D on [0, 1]; empty if it is not finite.
MatrixXd unit_derivative(const GlobalMethod& method) {
  const VectorXd lgl = collocation::legendre_gauss_lobatto(method.nodes);
  const VectorXd nodes = (lgl.array() + 1) / 2;
  switch (method.derivative) {
    case DerivativeMatrix::polynomial: return 2 * collocation::polynomial_differentiation_matrix(lgl);
    case DerivativeMatrix::stable_gaussian:
      return collocation::StableGaussian(nodes, method.relative_shape).differentiation_matrix();
    default:
      return collocation::radial_differentiation(nodes, collocation::Kernel::gaussian, method.relative_shape)
          .matrix;
  }
}

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("global collocation: " + what);
}

}  // namespace

GlobalCollocation::GlobalCollocation(const Problem& problem, GlobalMethod method)
    : problem_(problem), method_(std::move(method)), n_(problem.states()), nodes_(method_.nodes) {
  check_problem(problem);
  if (problem.phases() != 1) refuse(fmt::format("{} phases; it takes one", problem.phases()));
  if (problem.parameters() != 0) refuse(fmt::format("{} parameters; it takes none", problem.parameters()));
  std::vector<bool> seen(static_cast<std::size_t>(n_)), taken(static_cast<std::size_t>(2 * n_));
  for (const ReplacedRow& row : method_.rows) {
    if (row.condition < 0 || row.condition >= n_ || row.component < 0 || row.component >= n_) {
      refuse(fmt::format("no row for condition {} and component {}", row.condition, row.component));
    }
    seen[static_cast<std::size_t>(row.condition)] = true;
    const auto place = 2 * static_cast<std::size_t>(row.component) + (row.at_end ? 1 : 0);
    if (taken[place]) refuse(fmt::format("two conditions in the row of component {}", row.component));
    taken[place] = true;
  }
  if (std::count(seen.begin(), seen.end(), true) != n_) {
    refuse(fmt::format("{} rows do not place each of {} conditions", method_.rows.size(), n_));
  }
  d_ = unit_derivative(method_);
  const std::vector<double> points = problem.points();
  const double length = points.back() - points.front();
  times_ = points.front() + length * (collocation::legendre_gauss_lobatto(method_.nodes).array() + 1) / 2;
  if (d_.size() == 0) {
    status_ = failed_with(Outcome::non_finite,
                          "global collocation: the derivative matrix of {} nodes and shape c T = {} is not "
                          "finite; choose a larger shape",
                          method_.nodes, method_.relative_shape);
    return;
  }
  d_ /= length;
}

VectorXd GlobalCollocation::unknowns(const Start& start) const {
  VectorXd result(size()), x(n_);
  for (Index j = 0; j < nodes_; ++j) {
    start.states(times_[j], x);
    for (Index k = 0; k < n_; ++k) result[k * nodes_ + j] = x[k];
  }
  return result;
}

MatrixXd GlobalCollocation::states(const VectorXd& unknowns) const {
  return unknowns.reshaped(nodes_, n_).transpose();
}

MatrixXd GlobalCollocation::ends(const VectorXd& x) const {
  MatrixXd result(n_, 2);
  for (Index k = 0; k < n_; ++k) {
    result(k, 0) = x[k * nodes_];
    result(k, 1) = x[(k + 1) * nodes_ - 1];
  }
  return result;
}

VectorXd GlobalCollocation::condition_residuals(const VectorXd& unknowns) const {
  VectorXd r(n_);
  problem_.conditions(ends(unknowns), VectorXd(), r);
  return r;
}

bool GlobalCollocation::is_replaced(Index row) const {
  return std::any_of(method_.rows.begin(), method_.rows.end(),
                     [&](const ReplacedRow& r) { return row_of(r) == row; });
}

Index GlobalCollocation::row_of(const ReplacedRow& row) const {
  return row.component * nodes_ + (row.at_end ? nodes_ - 1 : 0);
}
// [collocation and conditions]
void GlobalCollocation::residual(const VectorXd& x, VectorXd& f) {
  VectorXd at(n_), slope(n_);
  const auto values = x.reshaped(nodes_, n_);
  f = (d_ * values).reshaped();
  for (Index j = 0; j < nodes_; ++j) {
    at = values.row(j).transpose();
    problem_.rhs(times_[j], at, VectorXd(), slope);
    for (Index k = 0; k < n_; ++k) f[k * nodes_ + j] -= slope[k];
  }
  const VectorXd r = condition_residuals(x);
  for (const ReplacedRow& row : method_.rows) f[row_of(row)] = r[row.condition];
}
// [collocation and conditions]
void GlobalCollocation::linearise(const VectorXd& x) {
  matrix_ = MatrixXd::Zero(size(), size());
  MatrixXd by_state(n_, n_), none(n_, 0);
  for (Index k = 0; k < n_; ++k) matrix_.block(k * nodes_, k * nodes_, nodes_, nodes_) = d_;
  VectorXd at(n_);
  for (Index j = 0; j < nodes_; ++j) {
    at = x.reshaped(nodes_, n_).row(j).transpose();
    problem_.jacobian(times_[j], at, VectorXd(), by_state, none);
    for (Index k = 0; k < n_; ++k) {
      for (Index i = 0; i < n_; ++i) matrix_(k * nodes_ + j, i * nodes_ + j) -= by_state(k, i);
    }
  }
  MatrixXd by_ends(n_, 2 * n_);
  problem_.condition_jacobian(ends(x), VectorXd(), by_ends, none);
  for (const ReplacedRow& row : method_.rows) {
    const Index at_row = row_of(row);
    matrix_.row(at_row).setZero();
    for (Index i = 0; i < n_; ++i) {
      matrix_(at_row, i * nodes_) = by_ends(row.condition, i);
      matrix_(at_row, (i + 1) * nodes_ - 1) = by_ends(row.condition, n_ + i);
    }
  }
}

namespace {

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
  // The eliminated row is (D x_k)_j - a x_m,j; it contains another eliminated unknown only if x_k is one.
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

std::vector<ReplacedRow> printed_rows(const ExtremalProblem& problem) {
  if (problem.model().states() != 2) {
    throw invalid_argument("printed_rows: {} states; the text has two", problem.model().states());
  }
  const auto& begin = problem.task().begin;
  const auto& end = problem.task().end;
  // Components are x1, x2, lambda1, lambda2. Eq. 5.28, and by analogy x1x1, do not replace the rows of x1 and
  // lambda2.
  if (begin[0] && end[0]) return {{0, 1, false}, {1, 2, false}, {2, 1, true}, {3, 2, true}};
  return {{0, begin[0] ? 0 : 2, false},
          {1, begin[1] ? 1 : 3, false},
          {2, end[0] ? 0 : 2, true},
          {3, end[1] ? 1 : 3, true}};
}

namespace {

/// Converts the root to a solution on one interval, with the polynomial through the values.
Solution as_solution(const Problem& problem, const GlobalCollocation& equations, const VectorXd& root) {
  const auto nodes = static_cast<int>(equations.times().size());
  Solution s;
  s.scheme = std::make_shared<const Scheme>(interpolation_scheme(nodes));
  const double t0 = equations.times()[0], h = equations.times()[nodes - 1] - t0;
  Interval interval{t0, h, 0, equations.states(root), MatrixXd::Zero(problem.states(), nodes)};
  VectorXd f(problem.states()), x;
  for (Index j = 0; j < nodes; ++j) {
    x = interval.values.col(j);
    problem.rhs(equations.times()[j], x, VectorXd(), f);
    interval.slopes.col(j) = f;
  }
  s.unknowns.intervals.push_back(std::move(interval));
  return s;
}

void verify_by_integration(const Problem& problem, const GlobalCollocation& equations, double tolerance,
                           GlobalResult& result) {
  Solution& s = result.extremal.solution;
  const VectorXd& t = equations.times();
  const MatrixXd& values = s.unknowns.intervals.front().values;
  const VectorXd weight = (values.cwiseAbs().rowwise().maxCoeff().array() + 1).cwiseInverse();
  MatrixXd& integrated = result.integrated;
  integrated = values.col(0);
  double worst = 0;
  // In pieces: spurious roots mostly oscillate fast, and are rejected before the end of the integration.
  constexpr Index piece = 6;
  while (integrated.cols() < t.size() && worst <= tolerance) {
    const Index done = integrated.cols(), next = std::min(done + piece, static_cast<Index>(t.size()));
    const std::span<const double> times(t.data() + done - 1, static_cast<std::size_t>(next - done + 1));
    const Integration next_piece = integrate_at(problem, integrated.rightCols(1), VectorXd(), times);
    if (!next_piece.status.ok()) {
      worst = std::numeric_limits<double>::infinity();
      break;
    }
    integrated.conservativeResize(Eigen::NoChange, next);
    integrated.rightCols(next - done) = next_piece.states.rightCols(next - done);
    const MatrixXd off = values.leftCols(next) - integrated;
    worst = (weight.asDiagonal() * off).cwiseAbs().maxCoeff();
  }
  if (integrated.cols() == t.size()) s.integrated_end = integrated.rightCols(1);
  s.integration_error = worst;
  if (worst <= tolerance) return;
  s.status = failed_with(Outcome::spurious_root,
                         "global collocation: the root of the equations is no solution: integrated from its "
                         "own initial values the trajectory is {:.3g} off at a node (relative; allowed "
                         "{:.2g}); take the method with refinement, or start elsewhere",
                         worst, tolerance);
}

algebraic::Report iterate(algebraic::Equations& equations, VectorXd& x, bool damped, int iterations) {
  // With a condition number of 1e17 the rounding of D causes updates of about 1e-9.
  constexpr double tolerance = 1e-9, noise = 1e-7;
  if (!damped) {
    return find_root(algebraic::Newton{.tolerance = tolerance, .noise = noise, .iterations = iterations},
                     equations, x);
  }
  return find_root(algebraic::DampedNewton{.tolerance = tolerance, .noise = noise, .iterations = iterations},
                   equations, x);
}

}  // namespace

GlobalResult solve_global(const ExtremalProblem& problem, const GlobalMethod& method, const Start& start,
                          double verification_tolerance, bool damped, int iterations) {
  GlobalResult result;
  GlobalCollocation equations(problem, method);
  Solution& s = result.extremal.solution;
  s.status = equations.status();
  if (!s.status.ok()) return result;
  VectorXd x = equations.unknowns(start);
  if (method.condensed.empty()) {
    result.report = iterate(equations, x, damped, iterations);
  } else {
    CondensedCollocation condensed(problem, equations, method.condensed);
    VectorXd some = condensed.reduced(x);
    result.report = iterate(condensed, some, damped, iterations);
    x = condensed.expanded(some);
  }
  if (!x.allFinite()) {
    s.status =
        result.report.status.ok()
            ? Status::failure(Outcome::non_finite, "global collocation: Newton's iterate is not finite")
            : result.report.status;
    return result;
  }
  s = as_solution(problem, equations, x);
  s.status = result.report.status;
  s.statistics = result.report.statistics;
  result.conditions = equations.condition_residuals(x);
  result.extremal.final_time = problem.task().final_time;
  result.extremal.cost = cost_of(problem, s);
  if (s.status.ok()) verify_by_integration(problem, equations, verification_tolerance, result);
  result.extremal.miss = end_miss(problem, s);
  return result;
}

}  // namespace nlmech::bvp

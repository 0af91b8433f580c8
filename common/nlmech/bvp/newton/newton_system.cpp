#include "nlmech/bvp/newton/newton_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nlmech::bvp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd Unknowns::ends(int phases) const {
  MatrixXd result(intervals.front().values.rows(), 2 * phases);
  for (const Interval& interval : intervals) {
    // Intervals are in order of time: the last one of a phase sets its end.
    const Index begin = 2L * interval.phase;
    const bool first = &interval == &intervals.front() || (&interval)[-1].phase != interval.phase;
    if (first) result.col(begin) = interval.values.col(0);
    result.col(begin + 1) = interval.values.rightCols(1);
  }
  return result;
}

NewtonSystem::NewtonSystem(const Problem& problem, const Scheme& scheme)
    : problem_(problem),
      scheme_(scheme),
      n_(problem.states()),
      m_(problem.parameters()),
      phases_(problem.phases()) {}

double NewtonSystem::node_time(const Interval& interval, Index node) const {
  const double end = interval.t0 + interval.h;
  if (phases_ > 1 && node + 1 == scheme_.nodes.size()) return std::nextafter(end, interval.t0);
  return interval.t0 + scheme_.nodes[node] * interval.h;
}

bool NewtonSystem::residual(Unknowns& y) {
  const Index nodes = scheme_.nodes.size();
  parts_.resize(y.intervals.size());
  phase_of_.resize(y.intervals.size());
  VectorXd f(n_), x(n_);
  bool finite = y.parameters.allFinite();
  for (std::size_t k = 0; k < y.intervals.size() && finite; ++k) {
    Interval& interval = y.intervals[k];
    phase_of_[k] = interval.phase;
    for (Index j = scheme_.skipped; j < nodes - scheme_.skipped; ++j) {
      x = interval.values.col(j);
      problem_.rhs(node_time(interval, j), x, y.parameters, f);
      interval.slopes.col(j) = f;
    }
    evaluations_ += nodes - 2 * scheme_.skipped;
    change_.noalias() = interval.slopes * scheme_.slope.transpose();
    change_ =
        (interval.values.rightCols(nodes - 1).colwise() - interval.values.col(0)) - interval.h * change_;
    parts_[k].r = change_.reshaped();
    finite = parts_[k].r.allFinite();
  }
  if (!finite) return false;
  conditions_.resize(problem_.condition_count());
  problem_.conditions(y.ends(phases_), y.parameters, conditions_);
  parameters_ = y.parameters;
  return conditions_.allFinite();
}

void NewtonSystem::set_units(const Unknowns& y) {
  VectorXd sizes = VectorXd::Zero(n_);
  for (const Interval& interval : y.intervals)
    sizes = sizes.cwiseMax(interval.values.cwiseAbs().rowwise().maxCoeff());
  const double largest = sizes.maxCoeff();
  units_ = VectorXd::Ones(n_);
  // A state that is 0 so far has no size; one that is rounding has none either.
  sizes = sizes.unaryExpr([largest](double s) { return s > 0 ? std::max(s, 1e-8 * largest) : largest; });
  if (largest > 1e3 * sizes.minCoeff())
    units_ = sizes.unaryExpr([](double s) { return std::exp2(std::round(std::log2(s))); });
}

void NewtonSystem::condense(const Interval& interval, Condensed& c) {
  const Index nodes = scheme_.nodes.size(), rows = (nodes - 1) * n_, inner = (nodes - 2) * n_;
  MatrixXd &edges = edges_, &between = between_, &by_state = by_state_, &by_parameter = by_parameter_;
  edges.setZero(rows, 2 * n_ + m_);
  between.setZero(rows, inner);
  by_state.resize(n_, n_);
  by_parameter.resize(n_, m_);
  VectorXd& x = x_;
  c.terms.setZero(n_);
  for (Index j = 0; j < nodes; ++j) {
    x = interval.values.col(j);
    if (j < scheme_.skipped || j >= nodes - scheme_.skipped) {
      by_state.setZero();
      by_parameter.setZero();
    } else {
      problem_.jacobian(node_time(interval, j), x, parameters_, by_state, by_parameter);
    }
    c.terms = c.terms.cwiseMax(by_state.cwiseAbs() * x.cwiseAbs() +
                               by_parameter.cwiseAbs() * parameters_.cwiseAbs());
    state_influence_ = state_influence_.cwiseMax(by_state.cwiseAbs());
    influence_.topRows(n_) = influence_.topRows(n_).cwiseMax(by_parameter.cwiseAbs());
    for (Index i = 0; i < n_; ++i) {  // units are powers of two
      by_state.row(i) = by_state.row(i).cwiseProduct(units_.transpose()) / units_[i];
      by_parameter.row(i) /= units_[i];
    }
    auto block = j == 0           ? edges.leftCols(n_)
                 : j == nodes - 1 ? edges.middleCols(n_, n_)
                                  : between.middleCols((j - 1) * n_, n_);
    for (Index i = 0; i + 1 < nodes; ++i) {
      const double by_slope = -interval.h * scheme_.slope(i, j);
      if (by_slope != 0) {
        block.middleRows(i * n_, n_) = by_slope * by_state;
        if (m_ > 0) edges.block(i * n_, 2L * n_, n_, m_) += by_slope * by_parameter;
      }
    }
    for (Index i = 0; j == 0 && i + 1 < nodes; ++i) block.middleRows(i * n_, n_).diagonal().array() -= 1;
    if (j > 0) block.middleRows((j - 1) * n_, n_).diagonal().array() += 1;
  }
  terms_ = terms_.cwiseMax(c.terms);
  c.has_inner = inner > 0;
  if (c.has_inner) {
    c.inner.compute(between);
    c.inner.householderQ().transpose().applyThisOnTheLeft(edges, workspace_);
  }
  c.top = edges.topRows(inner);
  c.bottom = edges.bottomRows(n_);
}

void NewtonSystem::chain() {
  phase_rows_.assign(static_cast<std::size_t>(phases_), MatrixXd());
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Condensed& c = parts_[k];
    MatrixXd& so_far = phase_rows_[static_cast<std::size_t>(phase_of_[k])];
    c.has_left = so_far.size() > 0;
    if (!c.has_left) {
      so_far = c.bottom;
      continue;
    }
    // Columns of the phase so far: its start, left end of the interval, parameters; columns of the interval:
    // left end, right end, parameters.
    MatrixXd here(2 * n_, n_), others = MatrixXd::Zero(2L * n_, 2L * n_ + m_);
    here.topRows(n_) = so_far.middleCols(n_, n_);
    here.bottomRows(n_) = c.bottom.leftCols(n_);
    others.topLeftCorner(n_, n_) = so_far.leftCols(n_);
    others.block(n_, n_, n_, n_) = c.bottom.middleCols(n_, n_);
    others.topRightCorner(n_, m_) = so_far.rightCols(m_);
    others.bottomRightCorner(n_, m_) = c.bottom.rightCols(m_);
    c.left.compute(here);
    others.applyOnTheLeft(c.left.householderQ().transpose());
    c.left_top = others.topRows(n_);
    so_far = others.bottomRows(n_);
  }
}

void NewtonSystem::border(const Unknowns& y) {
  const Index count = conditions_.size(), ends = 2L * n_ * phases_, size = ends + m_;
  MatrixXd by_ends = MatrixXd::Zero(count, ends), by_parameter = MatrixXd::Zero(count, m_);
  problem_.condition_jacobian(y.ends(phases_), y.parameters, by_ends, by_parameter);
  MatrixXd a = MatrixXd::Zero(size, size);
  for (Index k = 0; k < phases_; ++k) {
    const MatrixXd& rows = phase_rows_[static_cast<std::size_t>(k)];
    a.block(k * n_, 2 * k * n_, n_, 2 * n_) = rows.leftCols(2 * n_);
    a.block(k * n_, ends, n_, m_) = rows.rightCols(m_);
  }
  condition_terms_ = by_ends.cwiseAbs() * y.ends(phases_).cwiseAbs().reshaped() +
                     by_parameter.cwiseAbs() * parameters_.cwiseAbs();
  influence_.bottomRows(count) = by_parameter.cwiseAbs();
  a.bottomLeftCorner(count, ends) = by_ends * units_.replicate(2L * phases_, 1).asDiagonal();
  a.bottomRightCorner(count, m_) = by_parameter;

  MatrixXd only(count, size);
  only << by_ends, by_parameter;
  VectorXd r = conditions_;
  for (Index i = 0; i < count; ++i) {
    const double largest = only.row(i).lpNorm<Eigen::Infinity>();
    if (largest > 0) {
      only.row(i) /= largest;
      r[i] /= largest;
    }
  }
  Eigen::ColPivHouseholderQR<MatrixXd> rank(only);
  rank.setThreshold(1e-12);
  independent_ = rank.rank();
  contradiction_ = 0;
  if (independent_ < count && r.size() > 0) {
    const VectorXd rest = r - only * rank.solve(r);
    const double scale = std::max(r.lpNorm<Eigen::Infinity>(), 1e-300);
    contradiction_ = rest.lpNorm<Eigen::Infinity>() / scale;
  }

  row_scale_.resize(size);
  column_scale_.resize(size);
  for (Index i = 0; i < size; ++i) {
    const double largest = a.row(i).lpNorm<Eigen::Infinity>();
    row_scale_[i] = largest > 0 ? 1 / largest : 1;
  }
  a = row_scale_.asDiagonal() * a;
  for (Index i = 0; i < size; ++i) {
    const double largest = a.col(i).lpNorm<Eigen::Infinity>();
    column_scale_[i] = largest > 0 ? 1 / largest : 1;
  }
  a = a * column_scale_.asDiagonal();
  rest_.compute(a);
  const auto pivots = rest_.matrixQR().diagonal().cwiseAbs();
  pivot_ratio_ = pivots.minCoeff() / pivots.maxCoeff();
}

Index NewtonSystem::loosest_unknown(const VectorXd& sizes) const {
  const Index size = row_scale_.size(), ends = 2L * n_ * phases_;
  VectorXd z = VectorXd::Ones(size);
  const auto& r = rest_.matrixQR();
  z.head(size - 1) = -r.topLeftCorner(size - 1, size - 1)
                          .triangularView<Eigen::Upper>()
                          .solve(r.col(size - 1).head(size - 1));
  z = column_scale_.cwiseProduct(rest_.colsPermutation() * z);
  Index loosest = 0;
  double most = -1;
  for (Index i = 0; i < size; ++i) {
    const Index unknown = i < ends ? i % n_ : n_ + i - ends;
    const double unit = unknown < n_ ? units_[unknown] : 1;
    const double change = unit * std::abs(z[i]) / (sizes[unknown] > 0 ? sizes[unknown] : 1e-300);
    if (change > most) {
      most = change;
      loosest = unknown;
    }
  }
  return loosest;
}

bool NewtonSystem::factorise(const Unknowns& y) {
  terms_ = VectorXd::Zero(n_);
  influence_ = MatrixXd::Zero(n_ + conditions_.size(), m_);
  state_influence_ = MatrixXd::Zero(n_, n_);
  set_units(y);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    condense(y.intervals[k], parts_[k]);
    if (!parts_[k].bottom.allFinite() || !parts_[k].top.allFinite()) return false;
  }
  chain();
  border(y);
  return std::isfinite(pivot_ratio_);
}

void NewtonSystem::right_hand_sides() {
  rest_r_.resize(row_scale_.size());
  VectorXd so_far(n_), both(2 * n_);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Condensed& c = parts_[k];
    r_ = -(c.r.reshaped(n_, c.r.size() / n_).array().colwise() / units_.array()).reshaped();
    if (c.has_inner) c.inner.householderQ().transpose().applyThisOnTheLeft(r_, workspace_);
    c.r_top = r_.head(r_.size() - n_);
    c.r_bottom = r_.tail(n_);
    if (c.has_left) {
      both << so_far, c.r_bottom;
      c.left.householderQ().transpose().applyThisOnTheLeft(both, workspace_);
      c.r_left = both.head(n_);
      so_far = both.tail(n_);
    } else {
      so_far = c.r_bottom;
    }
    rest_r_.segment(Index{phase_of_[k]} * n_, n_) = so_far;
  }
  rest_r_.tail(conditions_.size()) = -conditions_;
}

void NewtonSystem::back_substitute(Unknowns& step) {
  const Index nodes = scheme_.nodes.size();
  step.parameters = rest_x_.tail(m_);
  VectorXd right(n_);
  for (std::size_t k = parts_.size(); k-- > 0;) {
    const Condensed& c = parts_[k];
    const VectorXd begin = rest_x_.segment(2L * n_ * phase_of_[k], n_);
    if (k + 1 == parts_.size() || phase_of_[k + 1] != phase_of_[k]) {
      right = rest_x_.segment(2 * n_ * phase_of_[k] + n_, n_);
    }
    VectorXd left = begin;
    if (c.has_left) {
      left = c.r_left - c.left_top.leftCols(n_) * begin - c.left_top.middleCols(n_, n_) * right -
             c.left_top.rightCols(m_) * step.parameters;
      c.left.matrixQR().topRows(n_).triangularView<Eigen::Upper>().solveInPlace(left);
    }
    MatrixXd& dx = step.intervals[k].values;
    dx.col(0) = left;
    dx.col(nodes - 1) = right;
    if (c.has_inner) {
      VectorXd inner = c.r_top - c.top.leftCols(n_) * left - c.top.middleCols(n_, n_) * right -
                       c.top.rightCols(m_) * step.parameters;
      c.inner.matrixQR().topRows(inner.size()).triangularView<Eigen::Upper>().solveInPlace(inner);
      dx.middleCols(1, nodes - 2) = inner.reshaped(n_, nodes - 2);
    }
    dx = (units_.asDiagonal() * dx).eval();
    right = left;
  }
}

void NewtonSystem::solve(Unknowns& step) {
  right_hand_sides();
  rest_x_ = column_scale_.cwiseProduct(rest_.solve(row_scale_.cwiseProduct(rest_r_)));
  back_substitute(step);
}

void NewtonSystem::solve_rounding(const Unknowns& y, Unknowns& step) {
  constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;
  double sign = unit_roundoff;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Interval& interval = y.intervals[k];
    MatrixXd r = interval.values.rightCols(interval.values.cols() - 1).cwiseAbs();
    r.colwise() += interval.h * parts_[k].terms;
    for (Index j = 0; j < r.cols(); ++j, sign = -sign) r.col(j) *= sign;
    parts_[k].r = r.reshaped();
  }
  for (Index i = 0; i < conditions_.size(); ++i, sign = -sign) conditions_[i] = sign * condition_terms_[i];
  solve(step);
}

}  // namespace nlmech::bvp

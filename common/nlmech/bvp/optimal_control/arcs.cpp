#include "nlmech/bvp/optimal_control/arcs.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using program::Graph;
using program::NodeId;

ArcFlow::ArcFlow(const NecessaryConditions& c, const Arc& arc) : conditions_(c), arc_(arc) {
  Graph graph = c.graph;
  std::vector<NodeId> equations;
  for (int i = 0; i < c.q; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const NodeId u = Graph::state(2 * c.n + i);
    switch (arc.controls[k]) {
      case ControlMode::interior: equations.push_back(c.by_control[k]); break;
      case ControlMode::low: equations.push_back(graph.difference(u, graph.number(c.low[k]))); break;
      case ControlMode::high: equations.push_back(graph.difference(u, graph.number(c.high[k]))); break;
      case ControlMode::singular: equations.push_back(c.switching[2]); minimises_ = false;
    }
  }
  for (int k = 0; k < c.bounds; ++k) {
    const bool on = arc.on_bound[static_cast<std::size_t>(k)];
    equations.push_back(on ? c.path[static_cast<std::size_t>(k)] : Graph::state(2 * c.n + c.q + k));
    if (on) minimises_ = false;
  }
  pointwise_ = Expressions(graph, equations);
  hamiltonian_ = Expressions(graph, {c.hamiltonian});
  flow_ = Expressions(graph, c.flow);
}

/// Newton's step for dH/du = 0 towards a minimum of H: along directions of negative curvature its sign is
/// changed, and it is shortened until H decreases.
void ArcFlow::minimise(double t, VectorXd& wide) const {
  const Index q = conditions_.q, first = 2L * conditions_.n;
  VectorXd r;
  MatrixXd by;
  std::vector<Index> free;
  for (Index i = 0; i < q; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const ControlMode mode = arc_.controls[k];
    if (mode == ControlMode::interior)
      free.push_back(i);
    else
      wide[first + i] = mode == ControlMode::low ? conditions_.low[k] : conditions_.high[k];
  }
  if (free.empty()) return;
  constexpr int most = 60;
  for (int iteration = 0; iteration < most; ++iteration) {
    pointwise_.differentiate(t, wide, r, by);
    const MatrixXd curvature = by.rightCols(by.cols() - 1 - first)(free, free);
    const VectorXd slope = r(free);
    if (!curvature.allFinite() || !slope.allFinite()) break;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(curvature);
    const double most_curved = eigen.eigenvalues().cwiseAbs().maxCoeff(), least = 1e-14 * most_curved;
    const VectorXd sizes = eigen.eigenvalues().cwiseAbs().cwiseMax(least);
    VectorXd step = -eigen.eigenvectors() * (eigen.eigenvectors().transpose() * slope).cwiseQuotient(sizes);
    const double size = 1 + wide.segment(first, q).norm();
    // From a maximum or a saddle along the direction in which H decreases most.
    if (step.norm() <= 1e-6 * size && eigen.eigenvalues()[0] < -1e-6 * most_curved)
      step += 0.1 * size * eigen.eigenvectors().col(0);
    // A long step could pass minima of an H that is not quadratic, such as one of angles.
    if (!conditions_.quadratic && step.norm() > size) step *= size / step.norm();
    if (step.norm() > 1e-6 * size) {
      const double before = hamiltonian_.values(t, wide)[0];
      VectorXd trial = wide;
      for (int k = 0; k < 40; ++k, step /= 2) {
        for (std::size_t i = 0; i < free.size(); ++i)
          trial[first + free[i]] = wide[first + free[i]] + step[static_cast<Index>(i)];
        if (hamiltonian_.values(t, trial)[0] < before) break;
      }
    }
    for (std::size_t i = 0; i < free.size(); ++i) wide[first + free[i]] += step[static_cast<Index>(i)];
    if (step.norm() <= 1e-15 * size || (iteration > 0 && step.norm() <= 1e-9 * size)) return;
  }
  wide.tail(wide.size() - first).setConstant(std::numeric_limits<double>::quiet_NaN());
}

void ArcFlow::complete(double t, const VectorXd& z, VectorXd& wide) const {
  const Index count = conditions_.q + conditions_.bounds;
  wide.resize(z.size() + count);
  wide << z, VectorXd::Zero(count);
  for (Index i = 0; i < conditions_.q; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double low = conditions_.low[k], high = conditions_.high[k];
    wide[z.size() + i] = std::isfinite(low + high) ? (low + high) / 2 : std::max(low, std::min(high, 0.0));
  }
  if (minimises_) return minimise(t, wide);
  VectorXd r;
  MatrixXd by;
  constexpr int most = 60;
  for (int iteration = 0; iteration < most; ++iteration) {
    pointwise_.differentiate(t, wide, r, by);
    const VectorXd step = by.rightCols(count).partialPivLu().solve(r);
    wide.tail(count) -= step;
    const double size = 1 + wide.tail(count).norm();
    if (!(step.norm() > 1e-15 * size) || (iteration > 0 && step.norm() <= 1e-9 * size)) return;
  }
  wide.tail(count).setConstant(std::numeric_limits<double>::quiet_NaN());
}

VectorXd ArcFlow::values(const Expressions& expressions, double t, const VectorXd& z) const {
  VectorXd wide;
  complete(t, z, wide);
  return expressions.values(t, wide);
}

void ArcFlow::differentiate(const Expressions& expressions, double t, const VectorXd& z, VectorXd& values,
                            MatrixXd& by) const {
  VectorXd wide, r;
  MatrixXd equations, all;
  complete(t, z, wide);
  const Index count = wide.size() - z.size();
  expressions.differentiate(t, wide, values, all);
  pointwise_.differentiate(t, wide, r, equations);
  const MatrixXd response =
      -equations.rightCols(count).partialPivLu().solve(equations.leftCols(1 + z.size()));
  by = all.leftCols(1 + z.size()) + all.rightCols(count) * response;
}

ArcProblem::ArcProblem(std::shared_ptr<const NecessaryConditions> conditions, const std::vector<Arc>& arcs,
                       std::vector<Junction> junctions)
    : necessary_(std::move(conditions)),
      n_(necessary_->n),
      parameters_(static_cast<int>(necessary_->multipliers)),
      junctions_(std::move(junctions)),
      ends_(necessary_->ends, necessary_->end_conditions) {
  for (const Arc& arc : arcs) flows_.emplace_back(*necessary_, arc);
  int needed = parameters_;
  for (std::size_t j = 0; j < junctions_.size(); ++j) {
    add_junction(j);
    needed += joined_[j].count;
  }
  if (needed != parameters_)
    throw invalid_argument("arcs: {} conditions for {} unknown constants", needed, parameters_);
}

void ArcProblem::add_junction(std::size_t j) {
  const Junction& junction = junctions_[j];
  const NecessaryConditions& c = *necessary_;
  const auto index = static_cast<std::size_t>(junction.index);
  const Arc &last = flows_[j].arc(), &next = flows_[j + 1].arc();
  JunctionConditions made;
  std::vector<NodeId> nodes, jumping;
  const auto is_bound = [](ControlMode mode) {
    return mode == ControlMode::low || mode == ControlMode::high;
  };
  switch (junction.kind) {
    case JunctionKind::point:
      made.point = junction.index;
      point_columns_.push_back(static_cast<Index>(2 * j + 2));
      break;
    case JunctionKind::switching:
      nodes = {c.by_control[index]};
      made.before = is_bound(last.controls[index]);
      break;
    case JunctionKind::singular_entry:
      nodes.push_back(c.switching[0]);
      // On an arc to the end the conditions there contain the other one: lambda = 0, or a state.
      if (j + 2 < flows_.size()) nodes.push_back(c.switching[1]);
      break;
    case JunctionKind::singular_exit:
      if (j == 0) nodes = {c.switching[0]};
      break;
    case JunctionKind::exit: nodes = {Graph::state(2 * c.n + c.q + junction.index)}; break;
    case JunctionKind::contact:
      jumping = {c.tangency[index].front()};
      nodes = {c.tangency[index][0], c.tangency[index][1]};
      break;
    case JunctionKind::entry: {
      jumping = nodes = c.tangency[index];
      // H is continuous: so is an interior control; a control at a bound leaves it where dH/du = 0.
      NodeId meeting = c.path[index];
      for (std::size_t i = 0; i < last.controls.size(); ++i) {
        if (is_bound(last.controls[i]) && !is_bound(next.controls[i])) meeting = c.by_control[i];
      }
      nodes.push_back(meeting);
    }
  }
  made.count = static_cast<int>(nodes.size());
  made.jumps = static_cast<int>(jumping.size());
  Graph graph = c.graph;
  for (const NodeId node : jumping) {
    for (const NodeId slope : partials(graph, node, 0, n_)) nodes.push_back(slope);
  }
  made.conditions = Expressions(graph, nodes);
  if (junction.kind != JunctionKind::point) made.time = parameters_++;
  made.multipliers = parameters_;
  parameters_ += made.jumps;
  joined_.push_back(std::move(made));
}

std::vector<double> ArcProblem::points() const {
  std::vector<double> points;
  for (std::size_t k = 0; k <= flows_.size(); ++k) points.push_back(static_cast<double>(k));
  return points;
}

std::vector<double> ArcProblem::times(const VectorXd& p) const {
  std::vector<double> times{necessary_->points.front()};
  for (std::size_t j = 0; j < junctions_.size(); ++j)
    times.push_back(joined_[j].time < 0 ? junctions_[j].time : p[joined_[j].time]);
  times.push_back(necessary_->points.back());
  return times;
}

std::pair<double, int> ArcProblem::place(double s, const VectorXd& p) const {
  const int k = std::clamp(static_cast<int>(s), 0, static_cast<int>(flows_.size()) - 1);
  const std::vector<double> all = times(p);
  const auto i = static_cast<std::size_t>(k);
  return {all[i] + (s - k) * (all[i + 1] - all[i]), k};
}

VectorXd ArcProblem::jump_multipliers(std::size_t junction, const VectorXd& p) const {
  return p.segment(joined_[junction].multipliers, joined_[junction].jumps);
}

void ArcProblem::rhs(double s, const VectorXd& z, const VectorXd& p, VectorXd& dzds) const {
  const auto [t, k] = place(s, p);
  const std::vector<double> all = times(p);
  const auto i = static_cast<std::size_t>(k);
  dzds = (all[i + 1] - all[i]) * flows_[i].values(flows_[i].flow(), t, z);
}

void ArcProblem::jacobian(double s, const VectorXd& z, const VectorXd& p, MatrixXd& by_state,
                          MatrixXd& by_parameter) const {
  const auto [t, k] = place(s, p);
  const std::vector<double> all = times(p);
  const auto i = static_cast<std::size_t>(k);
  const double length = all[i + 1] - all[i], share = s - k;
  VectorXd f;
  MatrixXd by;
  flows_[i].differentiate(flows_[i].flow(), t, z, f, by);
  by_state = length * by.rightCols(2L * n_);
  by_parameter.setZero();
  if (i > 0 && joined_[i - 1].time >= 0)
    by_parameter.col(joined_[i - 1].time) = -f + length * (1 - share) * by.col(0);
  if (i < joined_.size() && joined_[i].time >= 0)
    by_parameter.col(joined_[i].time) = f + length * share * by.col(0);
}

/// Column of the state at a point of the problem in the matrix of the ends of all arcs.
Index ArcProblem::column_of(int point) const {
  const auto last = static_cast<int>(necessary_->points.size()) - 1;
  if (point == 0) return 0;
  return point == last ? 2 * static_cast<Index>(flows_.size()) - 1
                       : point_columns_[static_cast<std::size_t>(point - 1)];
}

VectorXd ArcProblem::end_state(const MatrixXd& ends, const VectorXd& p) const {
  const auto points = static_cast<int>(necessary_->points.size());
  const auto nu = static_cast<Index>(necessary_->multipliers);
  VectorXd state(static_cast<Index>(points) * n_ + nu);
  for (int j = 0; j < points; ++j) state.segment(Index{j} * n_, n_) = ends.col(column_of(j)).head(n_);
  state.tail(nu) = p.head(nu);
  return state;
}

// Order: psi; lambda at the first and last point; at each junction continuity of x, the jump of lambda, and
// its own conditions.
void ArcProblem::conditions(const MatrixXd& ends, const VectorXd& p, VectorXd& r) const {
  const auto m = static_cast<Index>(necessary_->multipliers);
  const Index last = ends.cols() - 1;
  const VectorXd psi = ends_.values(0, end_state(ends, p));
  const std::vector<double> all = times(p);
  r.head(m) = psi.head(m);
  r.segment(m, n_) = ends.col(0).tail(n_) + psi.segment(m, n_);
  r.segment(m + n_, n_) = ends.col(last).tail(n_) - psi.tail(n_);
  Index row = m + 2L * n_;
  for (std::size_t j = 0; j < joined_.size(); ++j) {
    const JunctionConditions& c = joined_[j];
    const auto before = static_cast<Index>(2 * j + 1), after = before + 1;
    const std::size_t side = c.before ? j : j + 1;
    r.segment(row, n_) = ends.col(after).head(n_) - ends.col(before).head(n_);
    auto jump = r.segment(row + n_, n_);
    jump = ends.col(before).tail(n_) - ends.col(after).tail(n_);
    if (c.point >= 0) jump -= psi.segment(m + Index{c.point} * n_, n_);
    if (c.count > 0) {
      const VectorXd values =
          flows_[side].values(c.conditions, all[j + 1], ends.col(c.before ? before : after));
      r.segment(row + 2L * n_, c.count) = values.head(c.count);
      for (int k = 0; k < c.jumps; ++k) jump -= p[c.multipliers + k] * values.segment(c.count + k * n_, n_);
    }
    row += 2 * n_ + c.count;
  }
}

void ArcProblem::condition_jacobian(const MatrixXd& ends, const VectorXd& p, MatrixXd& by_ends,
                                    MatrixXd& by_parameter) const {
  const auto m = static_cast<Index>(necessary_->multipliers);
  const Index last = ends.cols() - 1, size = 2L * n_;
  const auto points = static_cast<int>(necessary_->points.size());
  const std::vector<double> all = times(p);
  by_ends.setZero();
  by_parameter.setZero();
  VectorXd values;
  MatrixXd psi, by;
  ends_.differentiate(0, end_state(ends, p), values, psi);
  const auto add_ends = [&](Index row, Index from, Index count, double sign) {
    for (int j = 0; j < points; ++j)
      by_ends.block(row, column_of(j) * size, count, n_) +=
          sign * psi.block(from, 1 + Index{j} * n_, count, n_);
    by_parameter.block(row, 0, count, m) += sign * psi.block(from, 1 + Index{points} * n_, count, m);
  };
  const MatrixXd one = MatrixXd::Identity(n_, n_);
  add_ends(0, 0, m, 1);
  add_ends(m, m, n_, 1);
  by_ends.block(m, n_, n_, n_) += one;
  add_ends(m + n_, m + Index{points - 1} * n_, n_, -1);
  by_ends.block(m + n_, last * size + n_, n_, n_) += one;
  Index row = m + 2L * n_;
  for (std::size_t j = 0; j < joined_.size(); ++j) {
    const JunctionConditions& c = joined_[j];
    const auto before = static_cast<Index>(2 * j + 1), after = before + 1;
    const std::size_t arc = c.before ? j : j + 1;
    const Index side = c.before ? before : after;
    by_ends.block(row, after * size, n_, n_) += one;
    by_ends.block(row, before * size, n_, n_) -= one;
    by_ends.block(row + n_, before * size + n_, n_, n_) += one;
    by_ends.block(row + n_, after * size + n_, n_, n_) -= one;
    if (c.point >= 0) add_ends(row + n_, m + Index{c.point} * n_, n_, -1);
    if (c.count > 0) {
      flows_[arc].differentiate(c.conditions, all[j + 1], ends.col(side), values, by);
      const Index own = row + 2L * n_;
      by_ends.block(own, side * size, c.count, size) += by.block(0, 1, c.count, size);
      if (c.time >= 0) by_parameter.block(own, c.time, c.count, 1) += by.block(0, 0, c.count, 1);
      for (int k = 0; k < c.jumps; ++k) {
        const Index from = c.count + Index{k} * n_;
        const double pi = p[c.multipliers + k];
        by_ends.block(row + n_, side * size, n_, size) -= pi * by.block(from, 1, n_, size);
        by_parameter.block(row + n_, c.multipliers + k, n_, 1) -= values.segment(from, n_);
        by_parameter.block(row + n_, c.time, n_, 1) -= pi * by.block(from, 0, n_, 1);
      }
    }
    row += 2 * n_ + c.count;
  }
}

void ArcProblem::set_sizes(const VectorXd& x, const VectorXd& lambda) {
  const auto or_one = [](double size) { return size > 0 ? size : 1; };
  const VectorXd states = x.unaryExpr(or_one);
  const double largest = or_one(lambda.cwiseProduct(states).maxCoeff());
  const VectorXd costates = (largest * states.cwiseInverse()).cwiseMin(or_one(lambda.maxCoeff()));
  least_sizes_.resize(2 * n_ + parameters_);
  least_sizes_ << states, costates, VectorXd::Constant(parameters_, costates.maxCoeff());
  for (const JunctionConditions& c : joined_) {
    if (c.time >= 0) least_sizes_[2 * n_ + c.time] = necessary_->points.back() - necessary_->points.front();
  }
}

VectorXd ArcProblem::parameters_from(const MatrixXd& z) const {
  VectorXd p = VectorXd::Zero(parameters_);
  for (std::size_t j = 0; j < joined_.size(); ++j) {
    if (joined_[j].time >= 0) p[joined_[j].time] = junctions_[j].time;
  }
  const auto m = static_cast<Index>(necessary_->multipliers);
  const auto points = static_cast<Index>(necessary_->points.size());
  VectorXd state = VectorXd::Zero(points * n_ + m), values;
  for (Index j = 0; j < points; ++j) state.segment(j * n_, n_) = z.col(j).head(n_);
  MatrixXd by;
  ends_.differentiate(0, state, values, by);  // at nu = 0: psi, and the gradient of phi
  MatrixXd rows(2 * n_, m);
  rows << -by.block(m, 1 + points * n_, n_, m), by.block(m + (points - 1) * n_, 1 + points * n_, n_, m);
  VectorXd right(2 * n_);
  right << z.col(0).tail(n_) + values.segment(m, n_), z.col(points - 1).tail(n_) - values.tail(n_);
  if (m > 0) p.head(m) = rows.completeOrthogonalDecomposition().solve(right);
  return p;
}

}  // namespace nlmech::bvp

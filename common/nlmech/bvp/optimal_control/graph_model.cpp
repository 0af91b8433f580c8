#include "nlmech/bvp/optimal_control/graph_model.hpp"

#include <cmath>

namespace nlmech::bvp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using program::Function;
using program::Graph;
using program::NodeId;

namespace {

Arc interior_arc(const NecessaryConditions& c) {
  return {std::vector<ControlMode>(static_cast<std::size_t>(c.q), ControlMode::interior),
          std::vector<bool>(static_cast<std::size_t>(c.bounds))};
}

NodeId half_square(Graph& graph, NodeId node, double weight) {
  return graph.product(graph.number(weight / 2), graph.product(node, node));
}

}  // namespace

GraphModel::GraphModel(const ControlProblem& problem, std::shared_ptr<const NecessaryConditions> necessary,
                       const Regularisation& regularisation)
    : necessary_(std::move(necessary)),
      interior_(*necessary_, interior_arc(*necessary_)),
      n_(problem.states),
      q_(problem.controls()) {
  Graph graph(2 * n_ + q_);
  std::vector<NodeId> ids = problem.slopes, variables{Graph::time()};
  ids.push_back(problem.running_cost);
  ids.insert(ids.end(), problem.state_bounds.begin(), problem.state_bounds.end());
  for (int i = 0; i < n_; ++i) variables.push_back(Graph::state(i));
  for (int i = 0; i < q_; ++i) variables.push_back(Graph::state(2 * n_ + i));
  std::vector<NodeId> made = substituted(problem.graph, ids, graph, variables);
  NodeId cost = made[static_cast<std::size_t>(n_)];
  for (std::size_t k = static_cast<std::size_t>(n_) + 1; k < made.size(); ++k)
    cost = graph.sum(
        cost, half_square(graph, graph.call(Function::max, made[k], graph.number(0)), regularisation.bounds));
  for (int i = 0; i < q_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!necessary_->linear[k] || regularisation.control == 0) continue;
    const double middle = (problem.low[k] + problem.high[k]) / 2,
                 half = (problem.high[k] - problem.low[k]) / 2;
    const NodeId off =
        graph.quotient(graph.difference(Graph::state(2 * n_ + i), graph.number(middle)), graph.number(half));
    cost = graph.sum(cost, half_square(graph, off, regularisation.control));
  }
  made.resize(static_cast<std::size_t>(n_));
  NodeId hamiltonian = cost;
  for (int i = 0; i < n_; ++i)
    hamiltonian =
        graph.sum(hamiltonian, graph.product(Graph::state(n_ + i), made[static_cast<std::size_t>(i)]));
  std::vector<NodeId> all = made;
  all.push_back(cost);
  dynamics_ = Expressions(graph, all);
  for (const NodeId slope : partials(graph, hamiltonian, 0, n_)) all.push_back(slope);
  for (const NodeId slope : partials(graph, hamiltonian, 2 * n_, q_)) all.push_back(slope);
  all.push_back(hamiltonian);
  expansion_ = Expressions(graph, all);
  cost_ = Expressions(necessary_->graph, {necessary_->hamiltonian});
  derive_end_cost(problem, regularisation.ends);
}

/// phi and the penalties by x(t_0) and x(t_J). Conditions at other points are ignored.
void GraphModel::derive_end_cost(const ControlProblem& problem, double weight) {
  Graph graph(2 * n_);
  const int last = static_cast<int>(problem.points.size()) - 1;
  std::vector<NodeId> variables{Graph::time()};
  for (int j = 0; j <= last; ++j) {
    for (int i = 0; i < n_; ++i)
      variables.push_back(j == 0      ? Graph::state(i)
                          : j == last ? Graph::state(n_ + i)
                                      : graph.number(std::nan("")));
  }
  std::vector<bool> prescribed(problem.conditions.size());
  for (const PrescribedValue& value : prescribed_values(problem)) prescribed[value.condition] = true;
  NodeId sum = substituted(problem.ends, {problem.end_cost}, graph, variables).front();
  for (std::size_t k = 0; k < problem.conditions.size(); ++k) {
    if (prescribed[k]) continue;
    const std::vector<bool> part = parts_of(problem.ends, {problem.conditions[k]});
    bool inside = false;
    for (int i = n_; i < last * n_; ++i) inside = inside || part[program::index(Graph::state(i))];
    if (inside) continue;
    const NodeId psi = substituted(problem.ends, {problem.conditions[k]}, graph, variables).front();
    sum = graph.sum(sum, half_square(graph, psi, weight));
  }
  std::vector<NodeId> all{sum};
  for (const NodeId slope : partials(graph, sum, 0, 2 * n_)) all.push_back(slope);
  ends_ = Expressions(graph, all);
}

VectorXd GraphModel::wide(const VectorXd& x, const VectorXd& lambda, const VectorXd& u) const {
  VectorXd all(2 * n_ + q_);
  all << x, lambda, u;
  return all;
}

void GraphModel::control(double t, const VectorXd& z, double, const Constraints&, VectorXd& u) const {
  VectorXd all;
  interior_.complete(t, z, all);
  u = all.segment(2L * n_, q_);
}

void GraphModel::extremal(double t, const VectorXd& z, double, const Constraints&, VectorXd& dzdt) const {
  dzdt = interior_.values(interior_.flow(), t, z);
}

void GraphModel::extremal_jacobian(double t, const VectorXd& z, double, const Constraints&,
                                   MatrixXd& j) const {
  VectorXd values;
  MatrixXd by;
  interior_.differentiate(interior_.flow(), t, z, values, by);
  j.leftCols(2L * n_) = by.rightCols(2L * n_);
  if (j.cols() > 2L * n_) j.col(2L * n_) = by.col(0);
}

double GraphModel::hamiltonian(double t, const VectorXd& z, double, const Constraints&,
                               VectorXd& gradient) const {
  VectorXd values;
  MatrixXd by;
  interior_.differentiate(cost_, t, z, values, by);
  gradient.resize(2L * n_ + 1);
  gradient << by.rightCols(2L * n_).transpose(), by(0, 0);
  return values[0];
}

HamiltonianExpansion GraphModel::expand(double t, const VectorXd& x, const VectorXd& u,
                                        const VectorXd& lambda, double, const Constraints&) const {
  VectorXd values;
  MatrixXd by;
  expansion_.differentiate(t, wide(x, lambda, u), values, by);
  HamiltonianExpansion e;
  e.g = values.head(n_);
  e.g_x = by.block(0, 1, n_, n_);
  e.g_u = by.block(0, 1 + 2L * n_, n_, q_);
  e.value = values[values.size() - 1];
  const Index first = n_ + 1;
  e.gradient = values.segment(first, n_ + q_);
  e.hessian.resize(n_ + q_, n_ + q_);
  e.hessian << by.block(first, 1, n_ + q_, n_), by.block(first, 1 + 2L * n_, n_ + q_, q_);
  return e;
}

void GraphModel::linearise(double t, const VectorXd& x, const VectorXd& u, double,
                           LinearDynamics& linear) const {
  VectorXd values;
  MatrixXd by;
  dynamics_.differentiate(t, wide(x, VectorXd::Zero(n_), u), values, by);
  linear.g = values.head(n_);
  linear.g_x = by.block(0, 1, n_, n_);
  linear.g_u = by.block(0, 1 + 2L * n_, n_, q_);
}

double GraphModel::dynamics(double t, const VectorXd& x, const VectorXd& u, double, VectorXd& g) const {
  const VectorXd values = dynamics_.values(t, wide(x, VectorXd::Zero(n_), u));
  g = values.head(n_);
  return values[n_];
}

EndCost GraphModel::end_cost(const VectorXd& x0, const VectorXd& xF, double) const {
  VectorXd at(2 * n_), values;
  at << x0, xF;
  MatrixXd by;
  ends_.differentiate(0, at, values, by);
  const Index size = 2L * n_;
  EndCost e{values[0], VectorXd::Zero(size + 1), MatrixXd::Zero(size + 1, size + 1)};
  e.gradient.head(size) = values.tail(size);
  e.hessian.topLeftCorner(size, size) = by.block(1, 1, size, size);
  return e;
}

ControlTask task_of(const ControlProblem& problem) {
  ControlTask task;
  task.begin_time = problem.points.front();
  task.final_time = problem.points.back();
  task.begin.resize(static_cast<std::size_t>(problem.states));
  task.end.resize(task.begin.size());
  const int last = static_cast<int>(problem.points.size()) - 1;
  for (const PrescribedValue& value : prescribed_values(problem)) {
    const auto i = static_cast<std::size_t>(value.component);
    if (value.point == 0)
      task.begin[i] = value.value;
    else if (value.point == last)
      task.end[i] = value.value;
    else
      task.waypoints.push_back(
          {problem.points[static_cast<std::size_t>(value.point)], value.component, value.value});
  }
  return task;
}

}  // namespace nlmech::bvp

#include "nlmech/bvp/optimal_control/necessary_conditions.hpp"

#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {

using program::Graph;
using program::NodeId;

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// a . b
NodeId dot(Graph& graph, const std::vector<NodeId>& a, const std::vector<NodeId>& b) {
  NodeId sum = graph.number(0);
  for (std::size_t i = 0; i < a.size(); ++i) sum = graph.sum(sum, graph.product(a[i], b[i]));
  return sum;
}

std::vector<NodeId> negated(Graph& graph, std::vector<NodeId> nodes) {
  for (NodeId& node : nodes) node = graph.negative(node);
  return nodes;
}

/// Time, the components from 0 of x, and those from @p first of u as nodes of a graph.
std::vector<NodeId> variables_of(int states, int controls, int first) {
  std::vector<NodeId> variables{Graph::time()};
  for (int i = 0; i < states; ++i) variables.push_back(Graph::state(i));
  for (int i = 0; i < controls; ++i) variables.push_back(Graph::state(first + i));
  return variables;
}

}  // namespace

std::vector<PrescribedValue> prescribed_values(const ControlProblem& problem) {
  std::vector<PrescribedValue> values;
  Graph graph = problem.ends;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(graph.size());
  for (std::size_t k = 0; k < problem.conditions.size(); ++k) {
    const std::vector<NodeId> slopes = partials(graph, problem.conditions[k], 0, graph.size());
    int place = -1, count = 0;
    for (int i = 0; i < graph.size(); ++i) {
      if (graph.is_number(slopes[at(i)], 0)) continue;
      ++count;
      if (graph.is_number(slopes[at(i)])) place = i;
    }
    if (count != 1 || place < 0) continue;
    const double rest = Expressions(graph, {problem.conditions[k]}).values(0, zero)[0];
    values.push_back(
        {k, place / problem.states, place % problem.states, 0.0 - rest / graph[slopes[at(place)]].c});
  }
  return values;
}

NecessaryConditions::NecessaryConditions(const ControlProblem& problem)
    : n(problem.states),
      q(problem.controls()),
      bounds(static_cast<int>(problem.state_bounds.size())),
      low(problem.low),
      high(problem.high),
      points(problem.points),
      graph(2 * n + q + bounds),
      ends(static_cast<int>(problem.points.size()) * n + static_cast<int>(problem.conditions.size())),
      multipliers(problem.conditions.size()) {
  std::vector<NodeId> ids = problem.slopes;
  ids.push_back(problem.running_cost);
  ids.insert(ids.end(), problem.state_bounds.begin(), problem.state_bounds.end());
  const std::vector<NodeId> made = substituted(problem.graph, ids, graph, variables_of(n, q, 2 * n));
  flow.assign(made.begin(), made.begin() + n);
  running_cost = made[at(n)];
  derive_bounds({made.begin() + n + 1, made.end()});
  std::vector<NodeId> costates, bound_multipliers;
  for (int i = 0; i < n; ++i) costates.push_back(Graph::state(n + i));
  for (int k = 0; k < bounds; ++k) bound_multipliers.push_back(Graph::state(2 * n + q + k));
  hamiltonian =
      graph.sum(graph.sum(running_cost, dot(graph, costates, flow)), dot(graph, bound_multipliers, path));
  by_control = partials(graph, hamiltonian, 2 * n, q);
  for (const NodeId rate : negated(graph, partials(graph, hamiltonian, 0, n))) flow.push_back(rate);
  for (int i = 0; i < q; ++i) {
    const std::vector<NodeId> curvature = partials(graph, by_control[at(i)], 2 * n, q);
    linear.push_back(graph.is_number(curvature[at(i)], 0));
    for (const NodeId second : curvature) quadratic = quadratic && !has_control(second);
  }
  if (q == 1 && linear.front()) derive_switching(problem);
  derive_ends(problem);
}

bool NecessaryConditions::has_control(NodeId node) const {
  const std::vector<bool> part = parts_of(graph, {node});
  for (int i = 0; i < q; ++i) {
    if (part[program::index(Graph::state(2 * n + i))]) return true;
  }
  return false;
}

void NecessaryConditions::derive_bounds(const std::vector<NodeId>& state_bounds) {
  std::vector<NodeId> slopes = flow;
  slopes.resize(at(graph.size()), graph.number(0));
  for (NodeId current : state_bounds) {
    if (has_control(current))
      throw std::invalid_argument("a bound on states contains a control; bound the control by itself");
    constexpr std::size_t most = 4;
    std::vector<NodeId> free_of_control;
    while (!has_control(current)) {
      if (free_of_control.size() == most)
        throw invalid_argument(
            "the control does not act on a bound of the states within {} derivatives of it; bound another "
            "quantity",
            most);
      free_of_control.push_back(current);
      current = rates(graph, {current}, slopes).front();
    }
    tangency.push_back(std::move(free_of_control));
    path.push_back(current);
  }
}

// With H = H_0 + u sigma, sigma' = {sigma, H_0}, since {sigma, sigma} = 0, and sigma'' = {sigma', H_0} + u
// {sigma', sigma} with Poisson's brackets.
void NecessaryConditions::derive_switching(const ControlProblem& problem) {
  std::vector<NodeId> ids = problem.slopes, variables = variables_of(n, q, 2 * n);
  ids.push_back(problem.running_cost);
  std::vector<NodeId> costates;
  for (int i = 0; i < n; ++i) costates.push_back(Graph::state(n + i));
  const auto flow_of = [&](const std::vector<NodeId>& f, NodeId h) {
    std::vector<NodeId> all = f;
    for (const NodeId rate : negated(graph, partials(graph, h, 0, n))) all.push_back(rate);
    all.resize(at(graph.size()), graph.number(0));
    return all;
  };
  const std::vector<NodeId> whole = substituted(problem.graph, ids, graph, variables);
  variables.back() = graph.number(0);
  std::vector<NodeId> drift = substituted(problem.graph, ids, graph, variables), control;
  for (const NodeId node : whole) control.push_back(partials(graph, node, 2 * n, 1).front());
  const auto hamiltonian_of = [&](std::vector<NodeId>& f) {
    const NodeId cost = f.back();
    f.pop_back();
    return graph.sum(cost, dot(graph, costates, f));
  };
  const NodeId h0 = hamiltonian_of(drift), sigma = hamiltonian_of(control);
  const std::vector<NodeId> along = flow_of(drift, h0), across = flow_of(control, sigma);
  const NodeId first = rates(graph, {sigma}, along).front();
  NodeId by_control_flow = graph.number(0);
  const std::vector<NodeId> slopes = partials(graph, first, 0, 2 * n);
  for (int i = 0; i < 2 * n; ++i)
    by_control_flow = graph.sum(by_control_flow, graph.product(slopes[at(i)], across[at(i)]));
  const NodeId second =
      graph.sum(rates(graph, {first}, along).front(), graph.product(Graph::state(2 * n), by_control_flow));
  switching = {sigma, first, second};
}

void NecessaryConditions::derive_ends(const ControlProblem& problem) {
  const int values = problem.ends.size();
  std::vector<NodeId> ids = problem.conditions, nu;
  ids.push_back(problem.end_cost);
  std::vector<NodeId> made = substituted(problem.ends, ids, ends, variables_of(values, 0, 0));
  end_cost = made.back();
  made.pop_back();
  for (std::size_t k = 0; k < multipliers; ++k) nu.push_back(Graph::state(values + static_cast<int>(k)));
  const NodeId lagrangian = ends.sum(end_cost, dot(ends, nu, made));
  end_conditions = made;
  for (const NodeId slope : partials(ends, lagrangian, 0, values)) end_conditions.push_back(slope);
}

}  // namespace nlmech::bvp

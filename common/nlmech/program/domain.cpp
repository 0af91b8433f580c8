#include "nlmech/program/domain.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/program/program.hpp"
#include "nlmech/program/time_features.hpp"

namespace nlmech::program {
namespace {

bool is_arc(const Node& n) {
  return n.operation == Operation::function && (n.function == Function::asin || n.function == Function::acos);
}

/// Bounds on an expression at all times and states.
Interval bounds_of(const Graph& graph, NodeId id) {
  struct AnyState {
    Interval operator[](int) const { return {}; }
  };
  Interval bounds;
  Program(graph, {id}).run(Interval(), AnyState{}, 0, 1, [&](int, const Interval& v) { bounds = v; });
  return bounds;
}

/// The denominator of a node, if there is one.
std::optional<NodeId> denominator_of(const Node& n) {
  switch (n.operation) {
    case Operation::quotient: return n.b;
    case Operation::reciprocal: return n.a;
    case Operation::power: return n.c < 0 ? std::optional(n.a) : std::nullopt;
    default: return {};
  }
}

void add_once(std::vector<NodeId>& all, NodeId id) {
  if (std::ranges::find(all, id) == all.end()) all.push_back(id);
}

bool depends_on_state(const Graph& graph, NodeId id) {
  const std::vector<bool> part = parts_of(graph, {id});
  const auto states = part.begin() + 1, end = states + graph.size();
  return std::find(states, end, true) != end;
}

/// The expressions @p ids with arguments of roots replaced by max(a, 0), and those of arcs clamped to [-1,
/// 1].
std::vector<NodeId> continued(Graph& graph, const std::vector<NodeId>& ids,
                              const std::vector<NodeId>& arguments) {
  const std::vector<bool> part = parts_of(graph, ids);
  std::vector<NodeId> made(part.size());
  for (NodeId i = 0; index(i) < part.size(); ++i) {
    if (!part[index(i)]) continue;
    const Node n = graph[i];
    if (i <= graph.size() || n.operation == Operation::number) {
      made[index(i)] = i;
      continue;
    }
    NodeId a = made[index(n.a)];
    const std::optional<NodeId> argument = needs_positive(graph, n);
    if (argument && std::ranges::find(arguments, *argument) != arguments.end()) {
      const NodeId beyond = is_arc(n) ? graph.choice(a, graph.number(1), graph.number(-1)) : graph.number(0);
      const NodeId decides = is_arc(n) ? graph.difference(graph.number(1), graph.product(a, a)) : a;
      a = graph.choice(decides, a, beyond);
    }
    made[index(i)] = n.operation == Operation::choice
                         ? graph.choice(made[index(n.decides)], a, made[index(n.b)])
                         : graph.again(n, a, made[index(n.b)]);
  }
  std::vector<NodeId> all;
  for (const NodeId id : ids) all.push_back(made[index(id)]);
  return all;
}

}  // namespace

std::optional<NodeId> needs_positive(Graph& graph, const Node& n) {
  if (n.operation == Operation::any_power) return n.a;
  if (n.operation == Operation::power && n.c != std::floor(n.c)) return n.a;
  if (n.operation != Operation::function) return {};
  if (n.function == Function::sqrt) return n.a;
  if (is_arc(n)) return graph.difference(graph.number(1), graph.product(n.a, n.a));
  return {};
}

bool is_never_negative(const Graph& graph, NodeId argument) {
  const Node& n = graph[argument];
  if (n.operation != Operation::choice || n.a != n.decides) return false;
  const Node& other = graph[n.b];
  const bool is_opposite = other.operation == Operation::scaled && other.c < 0 && other.a == n.decides;
  return is_opposite || (other.operation == Operation::number && other.c >= 0);
}

Domain::Domain(const Equations& equations) : graph(equations.graph()) {
  const std::vector<bool> part = parts_of(graph, equations.slopes()), by_time = of_time_alone(graph);
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (!part[i]) continue;
    const Node node = graph[static_cast<NodeId>(i)];
    const std::optional<NodeId> argument = needs_positive(graph, node), below = denominator_of(node);
    if (argument && depends_on_state(graph, *argument) && !is_never_negative(graph, *argument) &&
        bounds_of(graph, *argument).low < 0)
      add_once(arguments, *argument);
    if (below && !graph.is_number(*below) && bounds_of(graph, *below).has(0))
      add_once(by_time[index(*below)] ? timed : denominators, *below);
  }
  if (!arguments.empty()) beyond = continued(graph, equations.slopes(), arguments);
}

}  // namespace nlmech::program

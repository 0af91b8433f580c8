#include "nlmech/program/domain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/program/program.hpp"

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

/// The denominator of a node, if there is one. May add a node to the graph.
std::optional<NodeId> denominator_of(Graph& graph, const Node& n) {
  switch (n.operation) {
    case Operation::quotient: return n.b;
    case Operation::reciprocal: return n.a;
    case Operation::power: return n.c < 0 ? std::optional(n.a) : std::nullopt;
    case Operation::function:
      return n.function == Function::tan ? std::optional(graph.call(Function::cos, n.a, n.a)) : std::nullopt;
    default: return {};
  }
}

/// Adds the factors of a denominator. A power and abs(a) touch zero where their base changes its sign.
void add_factors(const Graph& graph, NodeId id, std::vector<NodeId>& factors) {
  const Node& n = graph[id];
  const bool is_root = n.operation == Operation::function && n.function == Function::sqrt;
  const bool is_abs = n.operation == Operation::choice && n.a == n.decides && is_never_negative(graph, id);
  if (n.operation == Operation::product || n.operation == Operation::scaled ||
      n.operation == Operation::divided || n.operation == Operation::power || is_root || is_abs) {
    add_factors(graph, n.a, factors);
    if (n.operation == Operation::product && n.b != n.a) add_factors(graph, n.b, factors);
  } else {
    factors.push_back(id);
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

/// Is a choice the same on both sides of its surface, as in abs, min and max: is the difference of its
/// operands a multiple of the switching function? Tried at a few states; else it may jump.
bool is_continuous(const Graph& graph, const Node& n) {
  struct SomeState {
    int k;
    double operator[](int i) const { return 0.3 + std::fmod(0.6180339887498949 * (3 * i + k), 1.); }
  };
  const Program all(graph, {n.a, n.b, n.decides});
  double first = 0;
  for (int k = 1; k <= 3; ++k) {
    double values[3] = {};
    all.run(0.7 * k, SomeState{k}, 0, 3, [&](int i, double v) { values[i] = v; });
    const double ratio = (values[0] - values[1]) / values[2];
    if (k == 1) first = ratio;
    if (!(std::abs(ratio - first) <= 1e-9 * std::abs(first))) return false;
  }
  return true;
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

std::vector<NodeId> jumps_of(Graph& graph, NodeId id) {
  const std::vector<bool> part = parts_of(graph, {id});
  std::vector<NodeId> jumps;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (!part[i]) continue;
    const Node n = graph[static_cast<NodeId>(i)];
    if (n.operation == Operation::choice && !is_continuous(graph, n)) add_once(jumps, n.decides);
    if (n.operation == Operation::atan2) add_once(jumps, graph.choice(n.b, graph.number(1), n.a));
    if (n.operation == Operation::floor) {
      const NodeId turns = graph.product(graph.number(std::numbers::pi), n.a);
      add_once(jumps, graph.call(Function::sin, turns, turns));
    }
    const bool is_stepped =
        n.operation == Operation::table && graph.tables()[static_cast<std::size_t>(n.c)]->stepped;
    if (is_stepped) add_once(jumps, graph.number(0));
  }
  return jumps;
}

Domain::Domain(const Equations& equations) : graph(equations.graph()) {
  const std::vector<bool> part = parts_of(graph, equations.slopes());
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i]) add_conditions(static_cast<NodeId>(i));
  }
  if (!arguments.empty() || !corners.empty()) beyond = continued(graph, equations.slopes(), arguments);
}

void Domain::add_conditions(NodeId id) {
  const Node node = graph[id];
  const auto may_be_zero = [this](NodeId a) { return !graph.is_number(a) && bounds_of(graph, a).has(0); };
  if (const std::optional<NodeId> argument = needs_positive(graph, node)) {
    const bool is_corner = is_never_negative(graph, *argument);
    const NodeId a = is_corner ? graph[*argument].decides : *argument;
    const bool is_timed = !depends_on_state(graph, a);
    if (bounds_of(graph, a).low < 0 && !(is_timed && (is_corner || graph.is_number(a))))
      add_once(is_timed ? timed_arguments : is_corner ? corners : arguments, a);
  }
  if (const std::optional<NodeId> below = denominator_of(graph, node)) {
    std::vector<NodeId> factors;
    add_factors(graph, *below, factors);
    for (const NodeId factor : factors) {
      if (may_be_zero(factor)) add_once(depends_on_state(graph, factor) ? denominators : timed, factor);
    }
  }
  const bool is_logarithm = node.operation == Operation::function && node.function == Function::log;
  if (is_logarithm && may_be_zero(node.a))
    add_once(depends_on_state(graph, node.a) ? logarithms : timed_arguments, node.a);
}

}  // namespace nlmech::program

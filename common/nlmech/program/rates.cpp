#include <cmath>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/partials.hpp"

namespace nlmech::program {
namespace {

NodeId slope_of(Graph& graph, const Table& table) {
  if (table.stepped) return graph.number(0);
  Table slopes{table.times, {}, true};
  for (std::size_t i = 0; i + 1 < table.times.size(); ++i) slopes.values.push_back(table.slope(i));
  slopes.values.push_back(slopes.values.back());
  return graph.table(slopes);
}

/// Derivatives along a direction of time and state, one per node.
class Rates {
 public:
  Rates(Graph& graph, const std::vector<NodeId>& slopes, double of_time)
      : graph_(graph), slopes_(slopes), of_time_(of_time) {}

  // Operands have smaller numbers: one ascending pass over the needed nodes suffices, without recursion.
  std::vector<NodeId> of(const std::vector<NodeId>& ids) {
    const std::vector<bool> needed = parts_of(graph_, ids);
    known_.assign(needed.size(), 0);
    for (NodeId i = 0; i < static_cast<NodeId>(needed.size()); ++i) {
      if (needed[index(i)]) known_[index(i)] = rule(i);
    }
    std::vector<NodeId> all;
    for (const NodeId id : ids) all.push_back(known_[index(id)]);
    return all;
  }

 private:
  NodeId rule(NodeId id) {
    const Node n = graph_[id];
    if (n.operation == Operation::number) return graph_.number(0);
    if (n.operation == Operation::variable)
      return n.a == 0 ? graph_.number(of_time_) : slopes_[index(n.a - 1)];
    return derivative_of(graph_, id, known_[index(n.a)], known_[index(n.b)]);
  }

  Graph& graph_;
  const std::vector<NodeId>& slopes_;
  double of_time_;
  std::vector<NodeId> known_;
};

// sqrt(1 - a^2) without cancellation near 1.
NodeId cosine_of_arc(Graph& g, NodeId a) {
  const NodeId one = g.number(1);
  const NodeId square = g.product(g.difference(one, a), g.sum(one, a));
  return g.call(Function::sqrt, square, square);
}

}  // namespace

NodeId derivative_of(Graph& g, NodeId id, NodeId da, NodeId db) {
  const Node n = g[id];
  const NodeId a = n.a, b = n.b;
  switch (n.operation) {
    case Operation::sum: return g.sum(da, db);
    case Operation::difference: return g.difference(da, db);
    case Operation::shifted: return da;
    case Operation::scaled: return g.product(g.number(n.c), da);
    case Operation::divided: return g.quotient(da, g.number(n.c));
    case Operation::product: return g.sum(g.product(da, b), g.product(a, db));
    case Operation::quotient: return g.quotient(g.difference(da, g.product(id, db)), b);
    case Operation::reciprocal: return g.negative(g.quotient(g.product(id, da), a));
    case Operation::power: return g.product(g.product(g.number(n.c), g.power(a, g.number(n.c - 1))), da);
    case Operation::any_power:
      return g.product(id,
                       g.sum(g.product(db, g.call(Function::log, a, a)), g.quotient(g.product(b, da), a)));
    case Operation::atan2: {
      const NodeId square = g.sum(g.product(a, a), g.product(b, b));
      return g.quotient(g.difference(g.product(b, da), g.product(a, db)), square);
    }
    case Operation::choice: return g.choice(n.decides, da, db);
    case Operation::floor: return g.number(0);
    case Operation::table: return g.product(slope_of(g, *g.tables()[static_cast<std::size_t>(n.c)]), da);
    default: return g.product(derivative(g, n.function, id, a), da);
  }
}

NodeId derivative(Graph& g, Function function, NodeId value, NodeId a) {
  const NodeId one = g.number(1), square = g.product(a, a);
  switch (function) {
    case Function::sqrt: return g.quotient(g.number(0.5), value);
    case Function::exp: return value;
    case Function::log: return g.quotient(one, a);
    case Function::sin: return g.call(Function::cos, a, a);
    case Function::cos: return g.negative(g.call(Function::sin, a, a));
    case Function::tan: return g.sum(one, g.product(value, value));
    case Function::asin: return g.quotient(one, cosine_of_arc(g, a));
    case Function::acos: return g.quotient(g.number(-1), cosine_of_arc(g, a));
    case Function::atan: return g.quotient(one, g.sum(one, square));
    case Function::sinh: return g.call(Function::cosh, a, a);
    case Function::cosh: return g.call(Function::sinh, a, a);
    case Function::tanh: return g.difference(one, g.product(value, value));
    case Function::asinh: {
      const NodeId cosine = g.sum(one, square);
      return g.quotient(one, g.call(Function::sqrt, cosine, cosine));
    }
    default:  // erf: 2/sqrt(pi) exp(-a^2)
      return g.product(g.number(2 / std::sqrt(std::acos(-1.0))),
                       g.call(Function::exp, g.negative(square), one));
  }
}

std::vector<NodeId> rates(Graph& graph, const std::vector<NodeId>& ids, const std::vector<NodeId>& slopes) {
  return Rates(graph, slopes, 1).of(ids);
}

std::vector<NodeId> partials(Graph& graph, NodeId id, int first, int count) {
  std::vector<NodeId> result;
  for (int i = first; i < first + count; ++i) {
    std::vector<NodeId> direction(index(graph.size()), graph.number(0));
    direction[index(i)] = graph.number(1);
    result.push_back(Rates(graph, direction, 0).of({id}).front());
  }
  return result;
}

std::vector<NodeId> substituted(const Graph& from, const std::vector<NodeId>& ids, Graph& to,
                                const std::vector<NodeId>& variables) {
  const std::vector<bool> needed = parts_of(from, ids);
  std::vector<NodeId> made(needed.size());
  for (NodeId i = 0; i < static_cast<NodeId>(needed.size()); ++i) {
    if (!needed[index(i)]) continue;
    Node n = from[i];
    if (n.operation == Operation::variable) {
      made[index(i)] = variables[index(n.a)];
    } else if (n.operation == Operation::table) {
      made[index(i)] = to.table(*from.tables()[static_cast<std::size_t>(n.c)]);
    } else {
      if (n.operation == Operation::choice) n.decides = made[index(n.decides)];
      made[index(i)] = to.again(n, made[index(n.a)], made[index(n.b)]);
    }
  }
  std::vector<NodeId> result;
  for (const NodeId id : ids) result.push_back(made[index(id)]);
  return result;
}

}  // namespace nlmech::program

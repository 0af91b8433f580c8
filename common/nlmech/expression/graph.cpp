#include "nlmech/expression/graph.hpp"

#include <cmath>
#include <utility>

namespace nlmech::expression {
namespace {

double apply(Function function, double a) {
  switch (function) {
    case Function::sqrt: return std::sqrt(a);
    case Function::exp: return std::exp(a);
    case Function::log: return std::log(a);
    case Function::sin: return std::sin(a);
    case Function::cos: return std::cos(a);
    case Function::tan: return std::tan(a);
    case Function::asin: return std::asin(a);
    case Function::acos: return std::acos(a);
    case Function::atan: return std::atan(a);
    case Function::sinh: return std::sinh(a);
    case Function::cosh: return std::cosh(a);
    case Function::tanh: return std::tanh(a);
    default: return std::erf(a);
  }
}

// A reciprocal by which one may multiply in place of dividing.
bool has_exact_reciprocal(double c) {
  int exponent = 0;
  return std::abs(std::frexp(c, &exponent)) == 0.5 && std::abs(exponent) < 1000;
}

}  // namespace

bool has_two_operands(Operation operation) {
  switch (operation) {
    case Operation::sum:
    case Operation::difference:
    case Operation::product:
    case Operation::quotient:
    case Operation::any_power:
    case Operation::atan2:
    case Operation::choice: return true;
    default: return false;
  }
}

double evaluate(const Node& node, double a, double b) {
  switch (node.operation) {
    case Operation::number: return node.c;
    case Operation::variable: return a;
    case Operation::sum: return a + b;
    case Operation::difference: return a - b;
    case Operation::shifted: return a + node.c;
    case Operation::scaled: return node.c * a;
    case Operation::divided: return a / node.c;
    case Operation::product: return a * b;
    case Operation::quotient: return a / b;
    case Operation::reciprocal: return node.c / a;
    case Operation::power: return std::pow(a, node.c);
    case Operation::any_power: return std::pow(a, b);
    case Operation::function: return apply(node.function, a);
    case Operation::atan2: return std::atan2(a, b);
    case Operation::choice: return a;
  }
  return 0;
}

Graph::Graph(int size) : size_(size) {
  for (int i = 0; i <= size; ++i) nodes_.push_back({Operation::variable, {}, i, i, 0, 0});
}

NodeId Graph::add(Operation operation, NodeId a, NodeId b, double c, Function function, NodeId decides) {
  const Node node{operation, function, a, b, decides, c};
  const bool leaf = operation == Operation::number;
  const bool known_operands = !leaf && is_number(a) && (!has_two_operands(operation) || is_number(b)) &&
                              operation != Operation::choice;
  if (known_operands) return number(evaluate(node, (*this)[a].c, (*this)[b].c));
  const auto [place, is_new] = known_.try_emplace(node.key(), nodes());
  if (is_new) nodes_.push_back(node);
  return place->second;
}

// NaN has no place among keys that are compared: it is a node of its own each time.
NodeId Graph::number(double c) {
  if (std::isnan(c)) {
    nodes_.push_back({Operation::number, {}, 0, 0, 0, c});
    return nodes() - 1;
  }
  return add(Operation::number, 0, 0, c + 0.0);
}

NodeId Graph::sum(NodeId a, NodeId b) {
  if (is_number(a)) std::swap(a, b);
  if (is_number(b) && !is_number(a)) return is_number(b, 0) ? a : add(Operation::shifted, a, a, (*this)[b].c);
  const Node& second = (*this)[b];
  if (second.operation == Operation::scaled && second.c == -1) return difference(a, second.a);
  if (b < a) std::swap(a, b);
  return add(Operation::sum, a, b);
}

NodeId Graph::difference(NodeId a, NodeId b) {
  if (a == b) return number(0);
  if (is_number(b) && !is_number(a)) return sum(a, number(-(*this)[b].c));
  if (is_number(a, 0)) return negative(b);
  if (is_number(a) && !is_number(b)) return sum(negative(b), a);
  const Node second = (*this)[b];
  if (second.operation == Operation::scaled && second.c == -1) return sum(a, second.a);
  return add(Operation::difference, a, b);
}

NodeId Graph::negative(NodeId a) { return product(number(-1), a); }

NodeId Graph::product(NodeId a, NodeId b) {
  if (is_number(b)) std::swap(a, b);
  if (!is_number(a) || is_number(b)) {
    if (b < a) std::swap(a, b);
    return add(Operation::product, a, b);
  }
  const double c = (*this)[a].c;
  if (c == 0) return a;
  if (c == 1) return b;
  const Node factor = (*this)[b];
  if (factor.operation == Operation::scaled && (c == -1 || factor.c == -1))
    return product(number(c * factor.c), factor.a);
  if (factor.operation == Operation::difference && c == -1) return difference(factor.b, factor.a);
  return add(Operation::scaled, b, b, c);
}

NodeId Graph::quotient(NodeId a, NodeId b) {
  if (is_number(a) && is_number(b)) return add(Operation::quotient, a, b);
  if (is_number(a)) return is_number(a, 0) ? a : add(Operation::reciprocal, b, b, (*this)[a].c);
  if (!is_number(b)) return add(Operation::quotient, a, b);
  const double c = (*this)[b].c;
  return has_exact_reciprocal(c) ? product(number(1 / c), a) : add(Operation::divided, a, a, c);
}

NodeId Graph::power(NodeId a, NodeId b) {
  if (!is_number(b)) return add(Operation::any_power, a, b);
  const double p = (*this)[b].c;
  constexpr int most = 64;  // beyond, a library's power has fewer roundings
  if (is_number(a)) return number(std::pow((*this)[a].c, p));
  if (p == 0.5) return call(Function::sqrt, a, a);
  if (p == std::floor(p) && std::abs(p) <= most) {
    const NodeId whole = whole_power(a, static_cast<int>(std::abs(p)));
    return p < 0 ? quotient(number(1), whole) : whole;
  }
  return add(Operation::power, a, a, p);
}

// Repeated squaring.
NodeId Graph::whole_power(NodeId a, int p) {
  NodeId result = number(1), square = a;
  for (; p > 0; p /= 2) {
    if (p % 2 == 1) result = product(result, square);
    if (p > 1) square = product(square, square);
  }
  return result;
}

NodeId Graph::call(Function function, NodeId a, NodeId b) {
  switch (function) {
    case Function::abs: return choice(a, a, negative(a));
    case Function::sign: return is_number(a, 0) ? a : choice(a, number(1), number(-1));
    case Function::max: return choice(difference(a, b), a, b);
    case Function::min: return choice(difference(a, b), b, a);
    case Function::atan2: return add(Operation::atan2, a, b);
    default: return add(Operation::function, a, a, 0, function);
  }
}

NodeId Graph::choice(NodeId decides, NodeId yes, NodeId no) {
  if (is_number(decides)) return (*this)[decides].c >= 0 ? yes : no;
  if (yes == no) return yes;
  return add(Operation::choice, yes, no, 0, {}, decides);
}

NodeId Graph::again(const Node& node, NodeId a, NodeId b) {
  switch (node.operation) {
    case Operation::number: return number(node.c);
    case Operation::variable: return a;
    case Operation::sum: return sum(a, b);
    case Operation::difference: return difference(a, b);
    case Operation::shifted: return sum(a, number(node.c));
    case Operation::scaled: return product(number(node.c), a);
    case Operation::divided: return quotient(a, number(node.c));
    case Operation::product: return product(a, b);
    case Operation::quotient: return quotient(a, b);
    case Operation::reciprocal: return quotient(number(node.c), a);
    case Operation::power: return power(a, number(node.c));
    case Operation::any_power: return power(a, b);
    case Operation::function: return call(node.function, a, a);
    case Operation::atan2: return call(Function::atan2, a, b);
    case Operation::choice: return choice(node.decides, a, b);
  }
  return a;
}

namespace {

/// Derivatives of one variable, each node's once.
class Derivatives {
 public:
  Derivatives(Graph& graph, int by) : graph_(graph), by_(by) {}

  // Operands have smaller numbers: one pass upwards over the nodes that are needed, without recursion.
  NodeId of(NodeId id) {
    std::vector<bool> needed(static_cast<std::size_t>(id) + 1);
    needed.back() = true;
    for (NodeId i = id; i > graph_.size(); --i) {
      if (!needed[index(i)] || graph_.is_number(i)) continue;
      needed[index(graph_[i].a)] = true;
      if (has_two_operands(graph_[i].operation)) needed[index(graph_[i].b)] = true;
    }
    known_.assign(needed.size(), 0);
    for (NodeId i = 0; i <= id; ++i) {
      if (needed[index(i)]) known_[index(i)] = rule(i);
    }
    return known_.back();
  }

 private:
  static std::size_t index(NodeId id) { return static_cast<std::size_t>(id); }

  NodeId rule(NodeId id) {
    const Node n = graph_[id];
    Graph& g = graph_;
    if (n.operation == Operation::number) return g.number(0);
    if (n.operation == Operation::variable) return g.number(n.a == by_ ? 1 : 0);
    const NodeId a = n.a, b = n.b, da = known_[index(a)], db = known_[index(b)];
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
      default: return g.product(slope(n.function, id, a), da);
    }
  }

  NodeId slope(Function function, NodeId value, NodeId a) {
    Graph& g = graph_;
    const NodeId one = g.number(1), square = g.product(a, a);
    switch (function) {
      case Function::sqrt: return g.quotient(g.number(0.5), value);
      case Function::exp: return value;
      case Function::log: return g.quotient(one, a);
      case Function::sin: return g.call(Function::cos, a, a);
      case Function::cos: return g.negative(g.call(Function::sin, a, a));
      case Function::tan: return g.sum(one, g.product(value, value));
      case Function::asin: return g.quotient(one, g.call(Function::sqrt, g.difference(one, square), one));
      case Function::acos:
        return g.quotient(g.number(-1), g.call(Function::sqrt, g.difference(one, square), one));
      case Function::atan: return g.quotient(one, g.sum(one, square));
      case Function::sinh: return g.call(Function::cosh, a, a);
      case Function::cosh: return g.call(Function::sinh, a, a);
      case Function::tanh: return g.difference(one, g.product(value, value));
      default:  // erf: 2/sqrt(pi) exp(-a^2)
        return g.product(g.number(2 / std::sqrt(std::acos(-1.0))),
                         g.call(Function::exp, g.negative(square), one));
    }
  }

  Graph& graph_;
  int by_;
  std::vector<NodeId> known_;
};

}  // namespace

NodeId derivative(Graph& graph, NodeId id, int by) { return Derivatives(graph, by).of(id); }

}  // namespace nlmech::expression

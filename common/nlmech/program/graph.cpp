#include "nlmech/program/graph.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace nlmech::program {
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
    case Function::asinh: return std::asinh(a);
    default: return std::erf(a);
  }
}

// Is the reciprocal exact, so that a multiplication may replace the division?
bool has_exact_reciprocal(double c) {
  int exponent = 0;
  return std::abs(std::frexp(c, &exponent)) == 0.5 && std::abs(exponent) < 1000;
}

}  // namespace

std::vector<bool> parts_of(const Graph& graph, const std::vector<NodeId>& ids) {
  std::vector<bool> part(index(graph.nodes()));
  for (const NodeId id : ids) part[index(id)] = true;
  for (NodeId i = graph.nodes() - 1; i > graph.size(); --i) {
    const Node& n = graph[i];
    if (!part[index(i)] || n.operation == Operation::number) continue;
    part[index(n.a)] = true;
    if (has_two_operands(n.operation)) part[index(n.b)] = true;
    if (n.operation == Operation::choice) part[index(n.decides)] = true;
  }
  return part;
}

bool has_two_operands(Operation operation) {
  switch (operation) {
    case Operation::sum:
    case Operation::difference:
    case Operation::product:
    case Operation::quotient:
    case Operation::any_power:
    case Operation::atan2:
    case Operation::choice:
    case Operation::combined: return true;
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
    case Operation::floor: return std::floor(a);
    case Operation::table: return std::numeric_limits<double>::quiet_NaN();  // a function of time only
    case Operation::combined: return a + node.c * b;
  }
  return 0;
}

Graph::Graph(int size) : size_(size) {
  for (int i = 0; i <= size; ++i) nodes_.push_back({Operation::variable, {}, i, i, 0, 0});
  drifts_.assign(nodes_.size(), std::numeric_limits<double>::quiet_NaN());
  drifts_[0] = 1;
  stepwise_.assign(nodes_.size(), false);
}

double Graph::drift_of(const Node& n) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (n.operation == Operation::number) return 0;
  const double a = drift(n.a), b = has_two_operands(n.operation) ? drift(n.b) : 0;
  switch (n.operation) {
    case Operation::sum: return a + b;
    case Operation::difference: return a - b;
    case Operation::shifted: return a;
    case Operation::scaled: return n.c * a;
    case Operation::divided: return a / n.c;
    case Operation::floor: return 0 * a;
    case Operation::choice: return a == b && !std::isnan(drift(n.decides)) ? a : none;
    default: return a == 0 && b == 0 ? 0 : none;
  }
}

bool Graph::is_stepwise_of(const Node& n) const {
  if (n.operation == Operation::number || n.operation == Operation::floor) return true;
  if (n.operation == Operation::table) return tables_[static_cast<std::size_t>(n.c)]->stepped;
  return is_stepwise(n.a) && is_stepwise(n.b);
}

NodeId Graph::add(Operation operation, NodeId a, NodeId b, double c, Function function, NodeId decides) {
  const Node node{operation, function, a, b, decides, c};
  const bool leaf = operation == Operation::number;
  const bool known_operands = !leaf && is_number(a) && (!has_two_operands(operation) || is_number(b)) &&
                              operation != Operation::choice;
  if (known_operands) return number(evaluate(node, (*this)[a].c, (*this)[b].c));
  // NaN cannot be a key: it always makes a new node.
  const auto id = std::isnan(c) ? nodes() : known_.try_emplace(node.key(), nodes()).first->second;
  if (id == nodes()) {
    nodes_.push_back(node);
    drifts_.push_back(drift_of(node));
    stepwise_.push_back(is_stepwise_of(node));
  }
  return id;
}

// Zero has one sign: -0 becomes 0.
NodeId Graph::number(double c) { return add(Operation::number, 0, 0, c + 0.0); }

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
  constexpr int most = 64;  // above it, std::pow has fewer roundings
  if (is_number(a)) return number(std::pow((*this)[a].c, p));
  if (p == 0.5) return call(Function::sqrt, a, a);
  if (p == std::floor(p) && std::abs(p) <= most) return power_by_products(a, static_cast<int>(p));
  return add(Operation::power, a, a, p);
}

NodeId Graph::power_by_products(NodeId a, int p) {
  NodeId result = number(1), square = a;
  for (int rest = std::abs(p); rest > 0; rest /= 2) {
    if (rest % 2 == 1) result = product(result, square);
    if (rest > 1) square = product(square, square);
  }
  return p < 0 ? quotient(number(1), result) : result;
}

NodeId Graph::call(Function function, NodeId a, NodeId b) {
  const NodeId one = number(1);
  switch (function) {
    case Function::abs: return by_sign(a, a, negative(a));
    case Function::sign: return sign_of(a);
    case Function::heaviside: return where(a, false, one, number(0));
    case Function::max: return by_sign(difference(a, b), a, b);
    case Function::min: return by_sign(difference(a, b), b, a);
    case Function::floor: return rounded_down(a);
    case Function::ceil: return rounded_up(a);
    case Function::round: return rounded_down(sum(a, number(0.5)));
    case Function::frac: return difference(a, rounded_down(a));
    case Function::mod: return difference(a, product(b, rounded_down(quotient(a, b))));
    case Function::atan2: return add(Operation::atan2, a, b);
    case Function::log10:
      if (is_number(a)) return number(std::log10((*this)[a].c));
      return quotient(call(Function::log, a, a), number(std::numbers::ln10));
    case Function::log2:
      if (is_number(a)) return number(std::log2((*this)[a].c));
      return quotient(call(Function::log, a, a), number(std::numbers::ln2));
    case Function::sec: return quotient(one, call(Function::cos, a, a));
    case Function::csc: return quotient(one, call(Function::sin, a, a));
    case Function::cot: return quotient(call(Function::cos, a, a), call(Function::sin, a, a));
    case Function::acosh: {  // cosh(2 u) = 1 + 2 sinh^2(u): no cancellation near 1
      const NodeId half = quotient(difference(a, one), number(2)), root = call(Function::sqrt, half, half);
      return product(number(2), call(Function::asinh, root, root));
    }
    case Function::atanh: {  // for a = tanh(u), a/sqrt(1 - a^2) is sinh(u)
      const NodeId square = product(difference(one, a), sum(one, a));
      const NodeId sine = quotient(a, call(Function::sqrt, square, square));
      return call(Function::asinh, sine, sine);
    }
    default: return add(Operation::function, a, a, 0, function);
  }
}

// An expression that is constant between jumps may be zero over an interval.
NodeId Graph::sign_of(NodeId a) {
  if (!is_stepwise(a)) return by_sign(a, number(1), number(-1));
  return choice(a, choice(negative(a), number(0), number(1)), number(-1));
}
NodeId Graph::where(NodeId a, bool strict, NodeId yes, NodeId no) {
  if (!is_stepwise(a)) return by_sign(a, yes, no);
  return strict ? choice(negative(a), no, yes) : choice(a, yes, no);
}

// At a jump the value just after it; for decreasing a that is the integer reached minus one.
NodeId Graph::rounded_down(NodeId a) {
  if (drift(a) < 0) return difference(negative(add(Operation::floor, negative(a))), number(1));
  return add(Operation::floor, a);
}
NodeId Graph::rounded_up(NodeId a) {
  if (drift(a) > 0) return sum(add(Operation::floor, a), number(1));
  return negative(add(Operation::floor, negative(a)));
}

// A choice by the sign of @p a with an arbitrary value at 0: one switching function for all multiples of a,
// and for a - b and b - a. A function of time only is made to rise through 0, so the choice at 0 is that of
// the later side.
NodeId Graph::by_sign(NodeId a, NodeId positive, NodeId negative) {
  while ((*this)[a].operation == Operation::scaled || (*this)[a].operation == Operation::divided) {
    if ((*this)[a].c < 0) std::swap(positive, negative);
    a = (*this)[a].a;
  }
  const Node n = (*this)[a];
  const bool reversed = n.operation == Operation::shifted && (*this)[n.a].operation == Operation::scaled &&
                        (*this)[n.a].c == -1,  // c - x
      is_difference = n.operation == Operation::difference;
  const bool by_time = drift(a) > 0 || drift(a) < 0;
  if (by_time ? drift(a) < 0 : reversed || (is_difference && n.b < n.a)) {
    std::swap(positive, negative);
    a = reversed        ? sum((*this)[n.a].a, number(-n.c))
        : is_difference ? difference(n.b, n.a)
                        : this->negative(a);
  }
  return choice(a, positive, negative);
}

NodeId Graph::table(const Table& table) {
  const auto known = std::ranges::find_if(tables_, [&](const auto& other) { return *other == table; });
  const auto number = static_cast<double>(known - tables_.begin());
  if (known == tables_.end()) tables_.push_back(std::make_shared<const Table>(table));
  return add(Operation::table, time(), time(), number);
}

NodeId Graph::choice(NodeId decides, NodeId yes, NodeId no) {
  if (is_number(decides))
    return std::isnan((*this)[decides].c) ? decides : (*this)[decides].c >= 0 ? yes : no;
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
    case Operation::floor: return add(Operation::floor, a);
    case Operation::table: return add(Operation::table, a, a, node.c);
    case Operation::combined: return sum(a, product(number(node.c), b));
  }
  return a;
}

}  // namespace nlmech::program

#include "nlmech/program/tape.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/program/expansion_errors.hpp"
#include "nlmech/program/tape_values.hpp"

namespace nlmech {

using program::Function;
using program::Graph;
using program::index;
using program::Node;
using program::NodeId;
using Step = program::Operation;
using tape::Instruction;
using tape::Operation;

namespace {

bool is_sum(Step step) { return step == Step::sum || step == Step::difference; }
bool is_linear(Step step) {
  return is_sum(step) || step == Step::scaled || step == Step::divided || step == Step::shifted;
}

/// Degree of an expression that is not a polynomial of the time.
constexpr int not_polynomial = 1 << 20;

/// The degree of a result as a polynomial of the time.
int degree(Step step, int a, int b) {
  switch (step) {
    case Step::number: return 0;
    case Step::sum:
    case Step::difference: return std::max(a, b);
    case Step::scaled:
    case Step::divided:
    case Step::shifted: return a;
    case Step::product: return std::min(not_polynomial, a + b);
    default: return not_polynomial;
  }
}

/// Is the series of the function the integral of its derivative times that of the argument?
bool is_integral(const Node& n) {
  if (n.operation != Step::function) return false;
  return n.function == Function::asin || n.function == Function::acos || n.function == Function::atan ||
         n.function == Function::asinh || n.function == Function::erf;
}

}  // namespace

namespace detail {

/// The part of a graph that outputs need, in operations with a recurrence.
struct Recurrences {
  Graph graph;
  std::vector<NodeId> outputs;

  Recurrences(const Graph& from, const std::vector<NodeId>& ids) : graph(from.size()) {
    const std::vector<bool> part = parts_of(from, ids);
    std::vector<NodeId> made(part.size());
    for (NodeId i = 0; i < from.nodes(); ++i) {
      if (!part[index(i)]) continue;
      made[index(i)] = i <= from.size() ? i : copy(from[i], made[index(from[i].a)], made[index(from[i].b)]);
    }
    for (const NodeId id : ids) outputs.push_back(made[index(id)]);
  }

 private:
  NodeId copy(const Node& n, NodeId a, NodeId b) {
    if (n.operation == Step::choice || n.operation == Step::floor || n.operation == Step::table)
      throw_unannounced_branch(false);
    if (n.operation == Step::any_power) {
      const NodeId exponent = graph.product(b, graph.call(Function::log, a, a));
      return graph.call(Function::exp, exponent, exponent);
    }
    // Products are valid also for a zero or negative base.
    if (n.operation == Step::power && n.c == std::floor(n.c) && std::abs(n.c) <= 1024)
      return graph.power_by_products(a, static_cast<int>(n.c));
    if (is_integral(n)) static_cast<void>(derivative(graph, n.function, a, a));  // before the function itself
    return graph.again(n, a, b);
  }
};

}  // namespace detail

/// Makes the instructions of a tape.
class TapeCompiler {
 public:
  TapeCompiler(const Graph& graph, const std::vector<NodeId>& outputs, Tape& tape)
      : needed_(graph, outputs),
        graph_(needed_.graph),
        tape_(tape),
        slope_(nodes()),
        uses_(nodes()),
        degree_(nodes(), not_polynomial),
        absorbed_(nodes()),
        series_(nodes(), -1) {}

  void compile() {
    const int size = graph_.size();
    for (NodeId i = 0; i <= size; ++i) series_[index(i)] = i;
    tape_.series_ = size + 1;
    find_slopes_and_degrees();
    count_uses();
    absorb();
    for (NodeId i = size + 1; i < graph_.nodes(); ++i) {
      if (uses_[index(i)] > 0 && !absorbed_[index(i)] && series_[index(i)] < 0) emit(i);
    }
    for (const NodeId id : needed_.outputs) {
      const bool number = graph_.is_number(id);
      tape_.outputs_.push_back({number ? -1 : series_[index(id)], number ? graph_[id].c : 0});
    }
  }

 private:
  [[nodiscard]] std::size_t nodes() const { return index(graph_.nodes()); }
  [[nodiscard]] const Node& node(NodeId i) const { return graph_[i]; }

  void find_slopes_and_degrees() {
    degree_[0] = 1;
    // All nodes exist already: nothing is added.
    for (NodeId i = graph_.size() + 1; i < static_cast<NodeId>(degree_.size()); ++i) {
      const Node n = node(i);
      degree_[index(i)] = degree(n.operation, degree_[index(n.a)], degree_[index(n.b)]);
      if (is_integral(n)) slope_[index(i)] = derivative(needed_.graph, n.function, i, n.a);
    }
  }

  template <class Visit>
  void for_operands(NodeId i, Visit visit) const {
    if (node(i).operation == Step::number) return;
    visit(node(i).a);
    if (program::has_two_operands(node(i).operation)) visit(node(i).b);
    if (is_integral(node(i))) visit(slope_[index(i)]);
  }

  // Counts the uses of nodes. An output counts twice, so that its series exists. A number as operand has its
  // own series.
  void count_uses() {
    for (const NodeId id : needed_.outputs) {
      if (!graph_.is_number(id)) uses_[index(id)] += 2;
    }
    for (NodeId i = graph_.nodes() - 1; i > graph_.size(); --i) {
      if (uses_[index(i)] > 0) for_operands(i, [this](NodeId operand) { ++uses_[index(operand)]; });
    }
  }

  // Merges sums and multiples into larger linear combinations, without series of their own. The second
  // operand of a sum is not merged if it is a sum: a - (b - c) and a - b + c differ in rounding.
  void absorb() {
    for (NodeId i = graph_.nodes() - 1; i > graph_.size(); --i) {
      const Step step = node(i).operation;
      if (uses_[index(i)] == 0 || !is_linear(step)) continue;
      const bool is_term = absorbed_[index(i)] && !is_sum(step);
      if (is_term) continue;
      take(node(i).a, true);
      if (is_sum(step)) take(node(i).b, false);
    }
  }
  void take(NodeId i, bool sums_too) {
    const Step step = node(i).operation;
    if (i > graph_.size() && uses_[index(i)] == 1 && (step == Step::scaled || (sums_too && is_sum(step))))
      absorbed_[index(i)] = true;
  }

  void add_terms(NodeId i, double sign) {
    const Node& n = node(i);
    if (!absorbed_[index(i)]) {
      tape_.terms_.push_back({sign, series_[index(i)]});
    } else if (n.operation == Step::scaled) {
      tape_.terms_.push_back({sign * n.c, series_[index(n.a)]});
    } else {
      add_sum(n, sign);
    }
  }
  void add_sum(const Node& n, double sign) {
    add_terms(n.a, sign);
    add_terms(n.b, n.operation == Step::sum ? sign : -sign);
  }

  int new_series(int count = 1) {
    const int first = tape_.series_;
    tape_.series_ += count;
    return first;
  }
  Instruction instruction(Operation operation, int a, int b, int count = 1) {
    return {operation, false, new_series(count), a, b, a, 0, 0, 1, 1, 0};
  }

  // The series t a'(t) of the argument of a function, shared by all functions of the argument.
  int slope_of(NodeId i) {
    const int a = series_[index(i)];
    for (const Instruction& known : tape_.instructions_) {
      if (known.operation == Operation::slope && known.a == a) return known.r;
    }
    const Instruction slope = instruction(Operation::slope, a, a);
    tape_.instructions_.push_back(slope);
    return slope.r;
  }

  void emit(NodeId i) {
    const Node& n = node(i);
    Instruction made = n.operation == Step::number                                ? number(n.c)
                       : is_linear(n.operation)                                   ? linear(n)
                       : program::has_two_operands(n.operation) || is_integral(n) ? of_two(i)
                                                                                  : of_one(i);
    tape_.instructions_.push_back(made);
    series_[index(i)] = made.r;
    if (made.operation != Operation::circular && made.operation != Operation::hyperbolic) return;
    // Sine and cosine of one argument are computed together; either may come first.
    const bool cosine = n.function == Function::cos || n.function == Function::cosh;
    series_[index(i)] = cosine ? made.r + 1 : made.r;
    for (NodeId j = i + 1; j < graph_.nodes(); ++j) {
      if (node(j).operation == Step::function && node(j).function == partner(n.function) && node(j).a == n.a)
        series_[index(j)] = cosine ? made.r : made.r + 1;
    }
  }
  static Function partner(Function function) {
    switch (function) {
      case Function::sin: return Function::cos;
      case Function::cos: return Function::sin;
      case Function::sinh: return Function::cosh;
      default: return Function::sinh;
    }
  }

  // A constant series: the number plus 0 times the time.
  Instruction number(double c) {
    const auto first = static_cast<int>(tape_.terms_.size());
    tape_.terms_.push_back({0, 0});
    return {Operation::linear, false, new_series(), 0, 0, 0, first, 1, 1, 1, c};
  }

  Instruction linear(const Node& n) {
    const auto first = static_cast<int>(tape_.terms_.size());
    Instruction made{Operation::linear, false, 0, 0, 0, 0, first, 0, 1, 1, 0};
    if (is_sum(n.operation)) {
      add_sum(n, 1);
    } else if (n.operation == Step::scaled && !absorbed_[index(n.a)]) {
      tape_.terms_.push_back({n.c, series_[index(n.a)]});
    } else {
      add_terms(n.a, 1);
      if (n.operation == Step::scaled) made.factor = n.c;
      if (n.operation == Step::divided) made.divisor = n.c;
      if (n.operation == Step::shifted) made.shift = n.c;
    }
    made.count = static_cast<int>(tape_.terms_.size()) - first;
    made.r = new_series();
    return made;
  }

  Instruction of_two(NodeId i) {
    const Node& n = node(i);
    NodeId a = n.a, b = n.b;
    if (n.operation == Step::quotient)
      return instruction(Operation::quotient, series_[index(a)], series_[index(b)]);
    if (n.operation == Step::function || n.operation == Step::atan2) return of_integral(i);
    if (degree_[index(b)] == 1) std::swap(a, b);
    const Operation operation = degree_[index(a)] == 1 ? Operation::product_by_line
                                : a == b               ? Operation::square
                                                       : Operation::product;
    return instruction(operation, series_[index(a)], series_[index(b)]);
  }

  // A function as the integral of its slope.
  Instruction of_integral(NodeId i) {
    const Node& n = node(i);
    const int slope = n.operation == Step::atan2
                          ? slope_of_angle(n)
                          : emitted(Operation::product, slope_of(n.a), series_[index(slope_[index(i)])]);
    Instruction made = instruction(kernel(n), series_[index(n.a)], series_[index(n.b)]);
    made.extra = slope;
    return made;
  }
  // Slope of atan2(y, x): (x y' - y x')/(x^2 + y^2).
  int slope_of_angle(const Node& n) {
    const int y = series_[index(n.a)], x = series_[index(n.b)];
    const int up = emitted(Operation::product, x, slope_of(n.a)),
              down = emitted(Operation::product, y, slope_of(n.b));
    const int squares = combined(emitted(Operation::square, x, x), 1, emitted(Operation::square, y, y));
    return emitted(Operation::quotient, combined(up, -1, down), squares);
  }
  int emitted(Operation operation, int a, int b) {
    tape_.instructions_.push_back(instruction(operation, a, b));
    return tape_.instructions_.back().r;
  }
  int combined(int a, double factor, int b) {
    const auto first = static_cast<int>(tape_.terms_.size());
    tape_.terms_.push_back({1, a});
    tape_.terms_.push_back({factor, b});
    tape_.instructions_.push_back({Operation::linear, false, new_series(), 0, 0, 0, first, 2, 1, 1, 0});
    return tape_.instructions_.back().r;
  }

  Instruction of_one(NodeId i) {
    const Node& n = node(i);
    const int a = series_[index(n.a)];
    const bool function = n.operation == Step::function;
    if (function && n.function == Function::sqrt) return instruction(Operation::root, a, a);
    if (function && n.function == Function::log) return instruction(Operation::logarithm, a, a, 2);
    if (n.operation == Step::reciprocal) {
      Instruction made = instruction(Operation::reciprocal, a, a);
      made.factor = n.c;
      return made;
    }
    const int slope = slope_of(n.a);
    Instruction made = instruction(kernel(n), a, a, kernel(n) == Operation::exponential ? 1 : 2);
    made.extra = slope;
    made.factor = n.c;
    made.line = degree_[index(n.a)] == 1;
    return made;
  }
  static Operation kernel(const Node& n) {
    if (n.operation == Step::atan2) return Operation::angle;
    if (n.operation == Step::power) return Operation::power;
    switch (n.function) {
      case Function::exp: return Operation::exponential;
      case Function::sin:
      case Function::cos: return Operation::circular;
      case Function::sinh:
      case Function::cosh: return Operation::hyperbolic;
      case Function::tan: return Operation::tangent;
      case Function::tanh: return Operation::hyperbolic_tangent;
      case Function::asin: return Operation::arc_sine;
      case Function::acos: return Operation::arc_cosine;
      case Function::atan: return Operation::arc_tangent;
      case Function::asinh: return Operation::area_sine;
      default: return Operation::error_function;
    }
  }

  detail::Recurrences needed_;
  const Graph& graph_;
  Tape& tape_;
  std::vector<NodeId> slope_;  // derivative of each function that is an integral
  std::vector<int> uses_, degree_;
  std::vector<bool> absorbed_;
  std::vector<int> series_;  // series of each node; -1: none yet
};

Tape::Tape(const Graph& graph, const std::vector<NodeId>& outputs) {
  TapeCompiler(graph, outputs, *this).compile();
}

bool Tape::depends_on_time() const {
  // Series 0 is the time, 1 to size() the state.
  std::vector<bool> is_time(outputs_.size() + 1);
  is_time[0] = true;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    is_time[i + 1] = outputs_[i].series < 0 && outputs_[i].constant != 0;
  const auto timed = [&](int series) {
    const auto at = static_cast<std::size_t>(series);
    return series >= 0 && at < is_time.size() && is_time[at];
  };
  // The operands of a linear combination are terms.
  return std::ranges::any_of(instructions_,
                             [&](const Instruction& i) {
                               return i.operation != Operation::linear && (timed(i.a) || timed(i.b));
                             }) ||
         std::ranges::any_of(terms_, [&](const tape::Term& t) { return timed(t.series); }) ||
         std::ranges::any_of(outputs_, [&](const tape::Output& o) { return timed(o.series); });
}

bool Tape::depends(int output, int component) const {
  std::vector<bool> touched(index(series_));
  for (int i = component; i < size(); ++i) touched[index(i + 1)] = true;
  for (const Instruction& i : instructions_) {
    bool any = touched[index(i.a)] || touched[index(i.b)] || touched[index(i.extra)];
    if (i.operation == Operation::linear) {
      any = false;
      for (int m = i.first; m < i.first + i.count; ++m) any = any || touched[index(terms_[index(m)].series)];
    }
    touched[index(i.r)] = any;
    if (tape::has_companion(i.operation)) touched[index(i.r + 1)] = any;
  }
  return std::any_of(outputs_.begin() + output, outputs_.end(),
                     [&](const tape::Output& o) { return o.series >= 0 && touched[index(o.series)]; });
}

tape::Program Tape::program() const {
  return {instructions_.data(), static_cast<int>(instructions_.size()),
          terms_.data(),        static_cast<int>(terms_.size()),
          outputs_.data(),      size()};
}

}  // namespace nlmech

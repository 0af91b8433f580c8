/// @file
/// Expressions of time and state as a graph of operations without duplicates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "nlmech/program/functions.hpp"
#include "nlmech/program/interval.hpp"
#include "nlmech/program/value_of.hpp"

namespace nlmech::program {

/// Operation of a node on its operands a, b and its number c.
enum class Operation : std::uint8_t {
  number,      ///< c
  variable,    ///< the time (a = 0), component a - 1 of the state
  sum,         ///< a + b
  difference,  ///< a - b
  shifted,     ///< a + c
  scaled,      ///< c a
  divided,     ///< a / c
  product,     ///< a b
  quotient,    ///< a / b
  reciprocal,  ///< c / a
  power,       ///< a^c
  any_power,   ///< a^b
  function,    ///< function of a
  atan2,       ///< atan2(a, b)
  choice,      ///< a where the switching function is not negative, otherwise b
  floor,       ///< floor(a)
  table,       ///< value of table number c at the time a
  combined     ///< a + c b; in Program only
};

/// Number of a node of the graph.
using NodeId = int;

/// Index of node @p id >= 0 in a vector with one entry per node.
[[nodiscard]] inline std::size_t index(NodeId id) { return static_cast<std::size_t>(id); }

/// An operation with its operands, whose numbers are smaller than that of the node.
struct Node {
  Operation operation;  ///< the operation
  Function function;    ///< for Operation::function
  NodeId a;             ///< first operand
  NodeId b;             ///< second operand
  NodeId decides;       ///< for a choice: the switching function
  double c;             ///< a number

  /// Key for the search of an existing node.
  [[nodiscard]] auto key() const { return std::tuple(operation, function, a, b, decides, c); }
};

/// Tabulated function of time.
struct Table {
  std::vector<double> times;   ///< time of each row; two or more, ascending
  std::vector<double> values;  ///< value of each row
  bool stepped = false;        ///< is the function piecewise constant? Otherwise piecewise linear

  /// Are all members equal?
  bool operator==(const Table&) const = default;
  /// The value at time @p t; NaN outside the times of the table.
  template <class T>
  [[nodiscard]] T at(const T& t) const {
    const auto now = value_of(t);
    const auto after =
        std::upper_bound(times.begin(), times.end(), now, [](const auto& a, double b) { return a < b; });
    if (after == times.begin() || now > times.back()) return T(std::numeric_limits<double>::quiet_NaN());
    const auto row = static_cast<std::size_t>(after - times.begin()) - 1;
    if (stepped) return T(values[row]);
    const std::size_t i = std::min(row, times.size() - 2);
    return values[i] + slope(i) * (t - times[i]);
  }
  /// Bounds on the values at all times of @p t; the whole line outside the times of the table.
  [[nodiscard]] Interval bounds(const Interval& t) const {
    const double first = std::max(t.low, times.front()), last = std::min(t.high, times.back());
    if (!(first <= last)) return {};
    double low = std::min(at(first), at(last)), high = std::max(at(first), at(last));
    for (auto row = std::ranges::lower_bound(times, first) - times.begin();
         row < std::ssize(times) && times[static_cast<std::size_t>(row)] <= last; ++row) {
      low = std::min(low, values[static_cast<std::size_t>(row)]);
      high = std::max(high, values[static_cast<std::size_t>(row)]);
    }
    return Interval::outwards(low, high);
  }
  /// Slope between row @p i and the next.
  [[nodiscard]] double slope(std::size_t i) const {
    return (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
  }
};

/// Builds nodes. Operations on numbers are evaluated, those without effect (x + 0, 1 x) are omitted.
/// Expressions that are zero as formulas (0 x, 0/x, x - x) are the number 0 for any state, so terms with the
/// factor 0 vanish. Likewise x^0 is 1.
class Graph {
 public:
  /// @param size components of the state
  explicit Graph(int size);

  /// Components of the state.
  [[nodiscard]] int size() const { return size_; }
  /// A number.
  [[nodiscard]] NodeId number(double c);
  /// The time.
  [[nodiscard]] static NodeId time() { return 0; }
  /// Component @p i of the state, from 0.
  [[nodiscard]] static NodeId state(int i) { return i + 1; }
  /// a + b
  [[nodiscard]] NodeId sum(NodeId a, NodeId b);
  /// a - b
  [[nodiscard]] NodeId difference(NodeId a, NodeId b);
  /// -a
  [[nodiscard]] NodeId negative(NodeId a);
  /// a b
  [[nodiscard]] NodeId product(NodeId a, NodeId b);
  /// a / b
  [[nodiscard]] NodeId quotient(NodeId a, NodeId b);
  /// a^b
  [[nodiscard]] NodeId power(NodeId a, NodeId b);
  /// a^p by repeated squaring; valid also for zero and negative a.
  [[nodiscard]] NodeId power_by_products(NodeId a, int p);
  /// Any function but `choose`; @p b is the second argument of functions of two. abs, sign, heaviside, min
  /// and max become choices, with one switching function if they change on the same surface: abs(x), sign(-2
  /// x) and max(0, x) all have x. On the surface sign and heaviside have the value of one side; of the number
  /// 0, sign is 0 and heaviside 1. floor, ceil, frac and mod of an expression linear in time between jumps,
  /// see drift(), have the value just after a jump at the jump.
  [[nodiscard]] NodeId call(Function function, NodeId a, NodeId b);
  /// @p yes where @p a >= 0 (@p strict: > 0), otherwise @p no. On a surface of the state it has the value of
  /// one side.
  [[nodiscard]] NodeId where(NodeId a, bool strict, NodeId yes, NodeId no);
  /// @p yes where @p decides is not negative, otherwise @p no; NaN where it is NaN.
  [[nodiscard]] NodeId choice(NodeId decides, NodeId yes, NodeId no);

  /// A table as a function of time.
  [[nodiscard]] NodeId table(const Table& table);
  /// The tables, by number.
  [[nodiscard]] const std::vector<std::shared_ptr<const Table>>& tables() const { return tables_; }

  /// The time derivative of an expression that depends on time only and is linear in it between jumps: 2 t -
  /// 1, mod(t, 3). NaN for other expressions.
  [[nodiscard]] double drift(NodeId id) const { return drifts_[static_cast<std::size_t>(id)]; }

  /// Does an expression change at jumps only, as floor(x) and sign(x) do?
  [[nodiscard]] bool is_stepwise(NodeId id) const { return stepwise_[static_cast<std::size_t>(id)]; }

  /// The operation of @p node on other operands.
  [[nodiscard]] NodeId again(const Node& node, NodeId a, NodeId b);

  /// A node.
  [[nodiscard]] const Node& operator[](NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  /// Number of nodes.
  [[nodiscard]] int nodes() const { return static_cast<int>(nodes_.size()); }
  /// Is node @p id the number @p c?
  [[nodiscard]] bool is_number(NodeId id, double c) const { return is_number(id) && (*this)[id].c == c; }
  /// Is node @p id a number?
  [[nodiscard]] bool is_number(NodeId id) const { return (*this)[id].operation == Operation::number; }

 private:
  NodeId add(Operation operation, NodeId a, NodeId b = 0, double c = 0, Function function = {},
             NodeId decides = 0);
  NodeId by_sign(NodeId a, NodeId positive, NodeId negative);
  NodeId sign_of(NodeId a);
  NodeId rounded_down(NodeId a);
  NodeId rounded_up(NodeId a);
  [[nodiscard]] double drift_of(const Node& node) const;
  [[nodiscard]] bool is_stepwise_of(const Node& node) const;

  int size_;
  std::vector<Node> nodes_;
  std::vector<double> drifts_;  // drift() of each node
  std::vector<bool> stepwise_;  // is_stepwise() of each node
  std::vector<std::shared_ptr<const Table>> tables_;
  std::map<decltype(Node{}.key()), NodeId> known_;
};

/// Has the operation a second operand?
[[nodiscard]] bool has_two_operands(Operation operation);

/// The value of the operation of @p node for numbers as operands.
[[nodiscard]] double evaluate(const Node& node, double a, double b);

/// The time derivatives of @p ids along a solution with the slopes @p slopes. A choice has the derivative of
/// the chosen operand.
[[nodiscard]] std::vector<NodeId> rates(Graph& graph, const std::vector<NodeId>& ids,
                                        const std::vector<NodeId>& slopes);

/// The derivative of a function with respect to its argument @p a, where it has the value @p value.
[[nodiscard]] NodeId derivative(Graph& graph, Function function, NodeId value, NodeId a);

/// Marks the nodes on which @p ids depend, including @p ids, by their numbers.
[[nodiscard]] std::vector<bool> parts_of(const Graph& graph, const std::vector<NodeId>& ids);

}  // namespace nlmech::program

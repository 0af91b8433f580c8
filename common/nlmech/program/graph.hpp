/// @file
/// Expressions of the time and the state as a graph of operations in which nothing stands twice.
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

/// What a node computes from its operands a, b and its number c.
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
  choice,      ///< a where the function of the switch is not negative, else b
  floor,       ///< greatest whole number up to a, which depends on the time alone
  table,       ///< value of table number c at the time a
  combined     ///< a + c b; in programs alone
};

/// A node of the graph, by its number.
using NodeId = int;

/// Where a vector with an entry a node has the one of @p id, not negative.
[[nodiscard]] inline std::size_t index(NodeId id) { return static_cast<std::size_t>(id); }

/// An operation with its operands, which have smaller numbers.
struct Node {
  Operation operation;  ///< what
  Function function;    ///< of Operation::function
  NodeId a;             ///< first operand
  NodeId b;             ///< second operand
  NodeId decides;       ///< of a choice: the function whose sign decides
  double c;             ///< a number

  /// For finding a node that is there already.
  [[nodiscard]] auto key() const { return std::tuple(operation, function, a, b, decides, c); }
};

/// Values at times.
struct Table {
  std::vector<double> times;   ///< of each row; two or more, which ascend
  std::vector<double> values;  ///< there
  bool stepped = false;        ///< the values hold up to the next row; else straight between two rows

  /// Are all members equal?
  bool operator==(const Table&) const = default;
  /// The value at time @p t; not a number outside of the times.
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
  /// Bounds on the values at all times of @p t; the whole line outside of the times.
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
  /// Between row @p i and the next.
  [[nodiscard]] double slope(std::size_t i) const {
    return (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
  }
};

/// Builds nodes. Operations on numbers are carried out, and those without effect (x + 0, 1 x) left out. What
/// is zero as a formula is the number 0, whatever the state: 0 x, 0/x, x - x; so a term with the factor 0 is
/// not there. For the same reason x^0 is 1.
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
  /// a^p by repeated squaring: right also where a is zero or negative.
  [[nodiscard]] NodeId power_by_products(NodeId a, int p);
  /// A function but `choose`; @p b is the second argument of those that have two. abs, sign, heaviside, min
  /// and max become choices, by one function where they change on one surface: abs(x), sign(-2 x) and
  /// max(0, x) all look at x. On the surface itself sign and heaviside are those of a side; sign(0) of the
  /// number is 0, heaviside(0) is 1. floor, ceil, frac and mod are known of numbers and of what is linear in
  /// the time between its jumps: see drift(). At a jump they have the value just after it.
  [[nodiscard]] NodeId call(Function function, NodeId a, NodeId b);
  /// @p yes where @p a >= 0 (@p strict: > 0), else @p no. On a surface of the state it is that of a side.
  [[nodiscard]] NodeId where(NodeId a, bool strict, NodeId yes, NodeId no);
  /// @p yes where @p decides is not negative, else @p no; not a number where it is none.
  [[nodiscard]] NodeId choice(NodeId decides, NodeId yes, NodeId no);

  /// The values of a table by the time.
  [[nodiscard]] NodeId table(const Table& table);
  /// The tables, by number.
  [[nodiscard]] const std::vector<std::shared_ptr<const Table>>& tables() const { return tables_; }

  /// The derivative by the time of what depends on the time alone and is linear in it between jumps: 2 t - 1,
  /// mod(t, 3). NaN of all else.
  [[nodiscard]] double drift(NodeId id) const { return drifts_[static_cast<std::size_t>(id)]; }

  /// The operation of @p node on other operands.
  [[nodiscard]] NodeId again(const Node& node, NodeId a, NodeId b);

  /// A node.
  [[nodiscard]] const Node& operator[](NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  /// How many nodes there are.
  [[nodiscard]] int nodes() const { return static_cast<int>(nodes_.size()); }
  /// Is it that number?
  [[nodiscard]] bool is_number(NodeId id, double c) const { return is_number(id) && (*this)[id].c == c; }
  /// Is it a number?
  [[nodiscard]] bool is_number(NodeId id) const { return (*this)[id].operation == Operation::number; }

 private:
  NodeId add(Operation operation, NodeId a, NodeId b = 0, double c = 0, Function function = {},
             NodeId decides = 0);
  NodeId by_sign(NodeId a, NodeId positive, NodeId negative);
  NodeId sign_of(NodeId a);
  NodeId rounded_down(NodeId a);
  NodeId rounded_up(NodeId a);
  [[nodiscard]] double drift_of(const Node& node) const;

  int size_;
  std::vector<Node> nodes_;
  std::vector<double> drifts_;  // of each node
  std::vector<std::shared_ptr<const Table>> tables_;
  std::map<decltype(Node{}.key()), NodeId> known_;
};

/// Has the operation a second operand?
[[nodiscard]] bool has_two_operands(Operation operation);

/// The value of an operation on numbers.
[[nodiscard]] double evaluate(const Node& node, double a, double b);

/// The derivatives of @p ids by the time along a solution whose slopes are @p slopes. A choice has the
/// derivative of what is chosen.
[[nodiscard]] std::vector<NodeId> rates(Graph& graph, const std::vector<NodeId>& ids,
                                        const std::vector<NodeId>& slopes);

/// The derivative of a function by its argument @p a, where it has the value @p value.
[[nodiscard]] NodeId derivative(Graph& graph, Function function, NodeId value, NodeId a);

/// Which nodes @p ids are made of, by their numbers.
[[nodiscard]] std::vector<bool> parts_of(const Graph& graph, const std::vector<NodeId>& ids);

}  // namespace nlmech::program

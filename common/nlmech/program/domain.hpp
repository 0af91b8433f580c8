/// @file
/// Domain of equations: arguments of roots that must not become negative, and denominators that must not
/// become zero.
#pragma once

#include <optional>
#include <vector>

#include "nlmech/program/equations.hpp"
#include "nlmech/program/graph.hpp"

namespace nlmech::program {

/// Domain conditions of equations, as expressions of one graph.
struct Domain {
  /// Domain conditions of @p equations.
  explicit Domain(const Equations& equations);

  Graph graph;  ///< the graph of the equations with additional nodes
  /// Expressions that must not become negative: arguments a of square roots and of powers with a fraction,
  /// and 1 - a^2 of asin and acos. Only those that depend on the state and whose bounds include negative
  /// values.
  std::vector<NodeId> arguments;
  /// Expressions a of the state in roots of max(a, 0) and abs(a), which are defined on both sides of a = 0
  /// and steep there.
  std::vector<NodeId> corners;
  /// Factors of denominators that depend on the state and may become zero: x of 1/x^2; cos(a) of tan(a).
  std::vector<NodeId> denominators;
  std::vector<NodeId> timed;       ///< such factors that depend on time only
  std::vector<NodeId> logarithms;  ///< arguments of logarithms that may become zero
  /// Expressions of time only that must not become negative, also arguments of logarithms.
  std::vector<NodeId> timed_arguments;
  /// The derivatives of the state with max(a, 0) for each argument a: the same equations within the domain,
  /// and finite beyond its boundary. Empty without arguments and corners.
  std::vector<NodeId> beyond;

 private:
  void add_conditions(NodeId id);
};

/// The expression that must not be negative for a node to be defined; none if there is none. May add nodes to
/// the graph.
[[nodiscard]] std::optional<NodeId> needs_positive(Graph& graph, const Node& node);

/// Functions of time and state that are zero where the expression @p id may jump: at a condition of `if`,
/// `sign` and `step` (abs, min and max do not jump), a rounded value, the cut of atan2, a table by steps. May
/// add nodes to the graph.
[[nodiscard]] std::vector<NodeId> jumps_of(Graph& graph, NodeId id);

/// Is an argument never negative by its form: abs(x), max(x, 0)?
[[nodiscard]] bool is_never_negative(const Graph& graph, NodeId argument);

}  // namespace nlmech::program

/// @file
/// Where equations cease to hold: arguments of roots that become negative, and denominators that become zero.
#pragma once

#include <optional>
#include <vector>

#include "nlmech/program/equations.hpp"
#include "nlmech/program/graph.hpp"

namespace nlmech::program {

/// What equations need, as expressions of one graph.
struct Domain {
  /// Of these equations.
  explicit Domain(const Equations& equations);

  Graph graph;  ///< that of the equations, and what is added here
  /// What must not become negative: arguments a of square roots, of powers with a fraction, and 1 - a^2 of
  /// asin and acos. Those that depend on the state, and can be negative by the way they are written.
  std::vector<NodeId> arguments;
  std::vector<NodeId> denominators;  ///< what must not become zero, if it can, and depends on the state
  std::vector<NodeId> timed;         ///< the same of the time alone
  /// The derivatives of the state where each argument is max(a, 0): the same equations within the domain, and
  /// such as stay finite beyond its ends. Empty without arguments.
  std::vector<NodeId> beyond;
};

/// What a node needs to be positive or zero; nothing if it needs nothing. May add to the graph.
[[nodiscard]] std::optional<NodeId> needs_positive(Graph& graph, const Node& node);

/// Is an argument never negative by the way it is written: abs(x), max(x, 0)?
[[nodiscard]] bool is_never_negative(const Graph& graph, NodeId argument);

}  // namespace nlmech::program

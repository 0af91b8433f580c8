/// @file
/// Partial derivatives of expressions as expressions, and expressions of other variables.
#pragma once

#include <vector>

#include "nlmech/program/graph.hpp"

namespace nlmech::program {

/// The partial derivatives of @p id with respect to components @p first to @p first + @p count - 1 of the
/// state. A choice has the derivative of the chosen operand.
[[nodiscard]] std::vector<NodeId> partials(Graph& graph, NodeId id, int first, int count);

/// The derivative of the operation @p id from those of its operands, @p da and @p db.
[[nodiscard]] NodeId derivative_of(Graph& graph, NodeId id, NodeId da, NodeId db);

/// The expressions @p ids of the graph @p from as nodes of the graph @p to, with nodes of @p to in place of
/// the time (@p variables[0]) and of each component i (@p variables[i + 1]). A table needs the time of @p to
/// as time.
[[nodiscard]] std::vector<NodeId> substituted(const Graph& from, const std::vector<NodeId>& ids, Graph& to,
                                              const std::vector<NodeId>& variables);

}  // namespace nlmech::program

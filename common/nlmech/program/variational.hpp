/// @file
/// Variational equations: the derivatives of a solution by its initial values and parameters solve them.
#pragma once

#include <vector>

#include "nlmech/program/graph.hpp"

namespace nlmech::program {

/// Places of a state x of n components and of p columns S_k of its derivatives in one extended state: x, S_1,
/// ..., S_p; in second-order equations the positions of all of them, then their velocities, so that the
/// extended equations are of second order too.
struct VariationalLayout {
  int size;                   ///< n
  int columns = 0;            ///< p
  bool second_order = false;  ///< is the state positions, then velocities?

  /// Components of the extended state.
  [[nodiscard]] int all() const { return size * (1 + columns); }
  /// Places from a component of x to the same one of column @p column, from 1; 0: x itself.
  [[nodiscard]] int shift(int column) const { return column * (second_order ? size / 2 : size); }
  /// Place of component @p i, from 0, of column @p column, from 1; 0: of x.
  [[nodiscard]] int place(int i, int column = 0) const {
    return shift(column) + i + (second_order && i >= size / 2 ? shift(columns) : 0);
  }
  /// The extended equations' variables in place of the time and of each component of x.
  [[nodiscard]] std::vector<NodeId> variables() const;
};

/// Expressions of an extended state, with the derivatives of all its components.
struct VariationalEquations {
  Graph graph;                 ///< all expressions
  std::vector<NodeId> slopes;  ///< one per component of the extended state
};

/// The equations x' = f, S_k' = f_x S_k + q_k for given @p slopes f. With S_k = dx/dx_j(t0), q_k = 0 and S_k
/// starts as column j of the identity; with S_k = dx/da, q_k = f_a and S_k starts as dx(t0)/da. Applied to
/// its own result it gives the derivatives of second order.
/// @param forcing q_k for each column; empty: all are 0
[[nodiscard]] VariationalEquations variational_equations(
    const Graph& graph, const std::vector<NodeId>& slopes, const VariationalLayout& layout,
    const std::vector<std::vector<NodeId>>& forcing = {});

/// The derivatives of @p ids along each column of an extended state with @p layout, at a fixed time: the sum
/// of d id/dx_i S_ik over i, for each k. Factors that columns share are computed once.
[[nodiscard]] std::vector<std::vector<NodeId>> along_columns(Graph& graph, const std::vector<NodeId>& ids,
                                                             const VariationalLayout& layout);

}  // namespace nlmech::program

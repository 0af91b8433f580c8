/// @file
/// What a method may solve exactly: the linear terms of equations, and their loads.
#pragma once

#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/harmonic.hpp"

namespace nlmech::program {

/// The terms of dx/dt that are a number times a component, and those that are a number or a number times
/// sin(w t + p) or cos(w t + p). Sums, and products with what is a number up to further terms, are expanded:
/// mu (1 - x^2) x' has the linear term mu x'. What depends on the state in any other way, or on the time, has
/// none.
struct LinearTerms {
  /// A number times a component.
  struct Term {
    int row, column;  ///< dx_row/dt has factor x_column
    double factor;    ///< the number
  };
  std::vector<Term> terms;     ///< those of one row and column add up
  std::vector<Harmonic> load;  ///< of frequency 0: a number
};

/// Those of @p slopes, the derivatives of all components of the state.
[[nodiscard]] LinearTerms linear_terms(const Graph& graph, const std::vector<NodeId>& slopes);

}  // namespace nlmech::program

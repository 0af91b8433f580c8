/// @file
/// Sequence of arcs of an optimal control, from a direct method.
#pragma once

#include "nlmech/bvp/optimal_control/arcs.hpp"
#include "nlmech/bvp/optimal_control/direct_start.hpp"

namespace nlmech::bvp {

/// Arcs and the junctions between them.
struct ArcStructure {
  std::vector<Arc> arcs;            ///< K
  std::vector<Junction> junctions;  ///< K - 1
};

/// Sequences of arcs that the result of direct_start() suggests, the likeliest first. Short runs on a bound
/// on states may be arcs or contacts.
[[nodiscard]] std::vector<ArcStructure> arc_structures(const NecessaryConditions& conditions,
                                                       const DirectResult& direct);

}  // namespace nlmech::bvp

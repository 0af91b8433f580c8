/// @file
/// Damped Newton on one mesh.
#pragma once

#include "nlmech/bvp/newton/newton_system.hpp"
#include "nlmech/bvp/solve.hpp"

namespace nlmech::bvp {

/// Newton's iteration from @p y, which becomes the root or the last iterate. Counts its work in
/// @p statistics and sets @p pivot_ratio; see Options for tolerances and solve() for outcomes.
[[nodiscard]] Status iterate(NewtonSystem& system, Unknowns& y, const Options& options,
                             Statistics& statistics, double& pivot_ratio);

}  // namespace nlmech::bvp

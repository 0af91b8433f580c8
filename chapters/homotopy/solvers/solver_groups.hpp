/// @file
/// Kinds of solvers, as diagrams of all of them set them apart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/scene/cost/lines.hpp"

namespace nlmech::chapters::homotopy {

/// Kinds with their members, the last that of all solvers that are members of none.
using SolverGroups = std::vector<std::pair<scene::MethodGroup, std::vector<std::string>>>;

/// Newton's kind, those made safe by |F|, descent, path followers and homotopies, and before the latter @p
/// own.
[[nodiscard]] inline SolverGroups solver_groups(const SolverGroups::value_type& own) {
  return {{{"Newton's kind", 2}, {"newton", "least-squares", "continuous-newton", "broyden"}},
          {{"made safe by |F|", 5}, {"damped-newton", "kinsol", "levenberg-marquardt", "dogleg"}},
          {{"descent", 6}, {"steepest-descent", "fictitious-time", "optimal-iterative"}},
          own,
          {{"path following", 4}, {"riks", "crisfield", "gdc"}},
          {{"homotopy", 1}, {}}};
}

/// Index of the kind of a solver.
[[nodiscard]] inline std::size_t group_of(const SolverGroups& groups, const std::string& solver) {
  const auto has = [&](const auto& group) { return std::ranges::count(group.second, solver) > 0; };
  return std::min(static_cast<std::size_t>(std::ranges::find_if(groups, has) - groups.begin()),
                  groups.size() - 1);
}

/// How they look.
[[nodiscard]] inline std::vector<scene::MethodGroup> looks_of(const SolverGroups& groups) {
  std::vector<scene::MethodGroup> looks;
  for (const auto& [look, members] : groups) looks.push_back(look);
  return looks;
}

}  // namespace nlmech::chapters::homotopy

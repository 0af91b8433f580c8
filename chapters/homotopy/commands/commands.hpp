/// @file
/// The chapter's commands: toggles and frames of the user's own.
#pragma once

#include <optional>
#include <string>

#include "nlmech/scene/program/options.hpp"

namespace nlmech::chapters::homotopy {

/// A toggle as both commands take it.
struct TypedToggle {
  double height = 0;
  std::string model = "element";
  std::optional<int> elements;
};

/// Options --height, --model and --elements.
void declare_toggle(scene::Options& options, TypedToggle& toggle, const std::string& about_elements);

/// Beam-columns a member: 4 if nothing was said, because one does not bow, and limit points of four are
/// within 1e-3 of those of many. Williams' equation has 1.
/// @throws InputError if it is given others
[[nodiscard]] int elements_of(const TypedToggle& toggle);

void add_limit_points_command(scene::Commands& all);  ///< `homotopy limit-points`
void add_solve_command(scene::Commands& all);         ///< `homotopy solve`
void add_frame_command(scene::Commands& all);         ///< `homotopy frame`

}  // namespace nlmech::chapters::homotopy

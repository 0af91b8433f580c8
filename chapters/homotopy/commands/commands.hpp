/// @file
/// The commands of the chapter: typed equations, toggles, user-defined frames.
#pragma once

#include <optional>
#include <string>

#include "nlmech/scene/program/options.hpp"

namespace nlmech::chapters::homotopy {

/// Options of a toggle, common to `limit-points` and `toggle`.
struct TypedToggle {
  double height = 0;
  std::string model = "element";
  std::optional<int> elements;
};

/// Declares --height, --model and --elements.
void declare_toggle(scene::Options& options, TypedToggle& toggle, const std::string& about_elements);

/// Beam-columns per member. Default 4: one element does not bow, and limit points of four are within 1e-3 of
/// the converged ones. Williams' equation has 1.
/// @throws InputError for another number with Williams' equation
[[nodiscard]] int elements_of(const TypedToggle& toggle);

void add_limit_points_command(scene::Commands& all);  ///< `homotopy limit-points`
void add_toggle_command(scene::Commands& all);        ///< `homotopy toggle`
void add_solve_command(scene::Commands& all);         ///< `homotopy solve`
void add_compare_command(scene::Commands& all);       ///< `homotopy compare`
void add_path_command(scene::Commands& all);          ///< `homotopy path`
void add_frame_command(scene::Commands& all);         ///< `homotopy frame`

}  // namespace nlmech::chapters::homotopy

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>

#include "chapters/homotopy/commands/commands.hpp"
#include "nlmech/frames/named/mesh_error.hpp"
#include "nlmech/frames/toggle_path.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {
namespace {

void declare(scene::Options& options, TypedToggle& toggle) {
  declare_toggle(options, toggle, "one element cannot bow, and exits with 1 for heights above 0.75 in");
}

frames::TogglePath path_of(const TypedToggle& typed) {
  const frames::Toggle toggle{.height = typed.height, .elements = elements_of(typed)};
  if (typed.model == "element") return critical_points(toggle);
  static_cast<void>(frames::make_frame(toggle));  // throws if the toggle is not valid
  return critical_points(frames::Williams{.height = typed.height});
}

/// Prints the mesh error estimated from the critical points of a second mesh.
void print_mesh_error(const TypedToggle& typed, const frames::TogglePath& path) {
  const int elements = elements_of(typed),
            second = frames::second_mesh(elements, 2 * static_cast<std::size_t>(elements));
  const frames::TogglePath other =
      critical_points(frames::Toggle{.height = typed.height, .elements = second});
  const auto is_same = [](const frames::ToggleEvent& a, const frames::ToggleEvent& b) {
    return a.kind == b.kind && a.is_symmetric == b.is_symmetric;
  };
  if (!other.status.ok() || !std::ranges::equal(path.events, other.events, is_same)) {
    scene::print_message(
        fmt::format("limit-points: the mesh error is unknown: with {} elements a member in place of {} {}",
                    second, elements, other.status.ok() ? "the points differ" : other.status.sentence()));
    return;
  }
  double worst = 0;
  for (std::size_t i = 0; i < path.events.size(); ++i)
    worst = std::max(worst, std::abs(1 - other.events[i].load / path.events[i].load));
  if (!path.events.empty())
    scene::print_message(
        fmt::format("limit-points: mesh error of the loads up to {:.2g}, relative, estimated from {} and {} "
                    "elements a member",
                    std::min(1., worst * frames::mesh_factor(elements, second)), elements, second));
}

//! [rows of the toggle]
void limit_points(const TypedToggle& typed) {
  frames::TogglePath path;
  try {
    path = path_of(typed);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("--height {}: {}", typed.height, error.what()));
  }
  if (!path.status.ok())
    throw Failure(Status::failure(
        path.status.outcome(),
        fmt::format("limit-points: the path was followed only to a drop of {:.6g} in and {} critical points; "
                    "take another number of elements a member, 4 or more: {}",
                    path.drop, path.events.size(), path.status.sentence())));
  std::string text = "kind,load,deflection,motion\n";
  for (const frames::ToggleEvent& e : path.events)
    text += fmt::format("{},{:.12g},{:.12g},{}\n", to_string(e.kind), e.load, e.drop,
                        e.is_symmetric ? "symmetric" : "antisymmetric");
  if (typed.model == "element") print_mesh_error(typed, path);
  scene::print_last_result(text);
  if (path.drop < 2.2 * typed.height)
    std::cerr << fmt::format(
        "limit-points: Williams' equation ends at a drop of {:.6g} in, at the pole of d_5, where its load "
        "falls without bound; --model element follows the path further\n",
        path.drop);
}
//! [rows of the toggle]

}  // namespace

void add_limit_points_command(scene::Commands& all) {
  all.add("limit-points",
          "Print the limit points and bifurcations of a toggle on its symmetric path from rest as CSV: "
          "kind,load,deflection,motion; only the header if there are none. kind: maximum, minimum, "
          "bifurcation; motion: symmetric or antisymmetric, the motion of the whole toggle with zero "
          "stiffness there. Members, inch and pound as in Table 2.1",
          declare, limit_points);
}

}  // namespace nlmech::chapters::homotopy

#include "chapters/homotopy/commands/commands.hpp"

#include <fmt/format.h>

#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {

void commands(scene::Commands& all) {
  add_solve_command(all);
  add_compare_command(all);
  add_path_command(all);
  add_limit_points_command(all);
  add_toggle_command(all);
  add_frame_command(all);
}

void declare_toggle(scene::Options& options, TypedToggle& toggle, const std::string& about_elements) {
  options.add("--height", toggle.height, "height of the apex over the bases, inch").required();
  options.add("--model", toggle.model, "element: beam-columns; williams: Eq. 2.21")
      .one_of({"element", "williams"});
  options.add("--elements", toggle.elements, "beam-columns a member (default 4); " + about_elements)
      .range(1, 10'000);
}

int elements_of(const TypedToggle& toggle) {
  if (toggle.model == "element") return toggle.elements.value_or(4);
  if (toggle.elements.value_or(1) != 1)
    throw InputError(fmt::format("--elements {}: Williams' equation has no elements; use --model element",
                                 *toggle.elements));
  return 1;
}

}  // namespace nlmech::chapters::homotopy

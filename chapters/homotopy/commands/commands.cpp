#include "chapters/homotopy/commands/commands.hpp"

#include <fmt/format.h>

#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {

void commands(CLI::App& app) {
  add_limit_points_command(app);
  add_solve_command(app);
}

int elements_of(const std::string& typed, const std::string& model) {
  if (model != "element" && model != "williams")
    throw InputError(fmt::format("--model {}: there are element and williams", model));
  if (typed.empty()) return model == "element" ? 4 : 1;
  const int elements = scene::typed_whole("--elements", typed, 1, 10'000);
  if (model == "williams" && elements != 1)
    throw InputError(fmt::format("--elements {}: Williams' equation has none; use --model element", typed));
  return elements;
}

}  // namespace nlmech::chapters::homotopy

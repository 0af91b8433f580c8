#include "nlmech/scene/program/toml_text.hpp"

#include <algorithm>

#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {

void require_shallow_toml(std::string_view text, const std::string& name) {
  constexpr std::ptrdiff_t most = 2000;
  const std::ptrdiff_t dots = std::count(text.begin(), text.end(), '.');
  if (dots > most)
    throw input_error("{}: {} dots, where {} are more than enough for its few numbers", name, dots, most);
}

}  // namespace nlmech::scene

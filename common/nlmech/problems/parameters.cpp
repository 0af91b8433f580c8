#include "nlmech/problems/parameters.hpp"

#include <stdexcept>

namespace nlmech::problems {

void throw_unknown_parameter(std::string_view problem, std::string_view name,
                             std::span<const std::string_view> known) {
  std::string text(problem);
  text.append(": there is no parameter '").append(name).append("'; there is");
  const char* separator = " ";
  for (const std::string_view each : known) {
    text.append(separator).append(each);
    separator = ", ";
  }
  throw std::invalid_argument(text);
}

}  // namespace nlmech::problems

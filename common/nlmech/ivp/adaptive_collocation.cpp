#include "nlmech/ivp/adaptive_collocation.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nlmech::ivp {

void check_options(const AdaptiveCollocation& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  require_within(method.name, "relative_tolerance", method.relative_tolerance, 0, 0.1);
  require_within(method.name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(method.name, "largest_step", method.largest_step, 0, largest);
  if (method.nodes != 0 && method.nodes != 9 && method.nodes != 13 && method.nodes != 17)
    throw std::invalid_argument(
        fmt::format("{}: nodes must be 9, 13 or 17 (0: by the tolerance), is {}", method.name, method.nodes));
}

namespace adaptive {

int nodes_for(double relative_tolerance) {
  if (relative_tolerance > 3e-7) return 9;
  return relative_tolerance > 3e-12 ? 13 : 17;
}

}  // namespace adaptive
}  // namespace nlmech::ivp

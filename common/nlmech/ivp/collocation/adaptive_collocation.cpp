#include "nlmech/ivp/collocation/adaptive_collocation.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nlmech::ivp {

void check_options(const AdaptiveCollocation& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  require_within(method.name, "relative_tolerance", method.relative_tolerance, 0, 0.1);
  require_within(method.name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(method.name, "largest_step", method.largest_step, 0, largest);
  require_within(method.name, "shape", method.shape, 0, largest);
  if (method.nodes != 0 && method.nodes != 9 && method.nodes != 13 && method.nodes != 17)
    throw std::invalid_argument(
        fmt::format("{}: nodes must be 9, 13 or 17 (0: by the tolerance), is {}", method.name, method.nodes));
}

namespace adaptive {

int first_order(const AdaptiveCollocation& method) {
  if (method.nodes > 0) return (method.nodes - 9) / 4;
  // Where 13 and 17 nodes begin to be cheaper, on problems of a few components.
  if (method.relative_tolerance > 3e-6) return 0;
  return method.relative_tolerance > 3e-11 ? 1 : 2;
}

}  // namespace adaptive

}  // namespace nlmech::ivp

#include "nlmech/spacecraft/assumed_modes.hpp"

#include <stdexcept>

namespace nlmech::spacecraft {
DiscreteModel assumed_modes(const Parameters&, int, ModeFunctions) {
  throw std::logic_error("assumed_modes");
}
}  // namespace nlmech::spacecraft

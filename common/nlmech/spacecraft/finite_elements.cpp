#include "nlmech/spacecraft/finite_elements.hpp"

#include <stdexcept>

namespace nlmech::spacecraft {
DiscreteModel finite_elements(const Parameters&, int) { throw std::logic_error("finite_elements"); }
}  // namespace nlmech::spacecraft

#include "nlmech/spacecraft/poles.hpp"

#include <stdexcept>

namespace nlmech::spacecraft {
Frequencies poles(const Plant&, int) { throw std::logic_error("poles"); }
Frequencies hub_zeros(const Plant&, int) { throw std::logic_error("hub_zeros"); }
Zeros deflection_zeros(const Plant&, double, double) { throw std::logic_error("deflection_zeros"); }
}  // namespace nlmech::spacecraft

#include "nlmech/spacecraft/timoshenko.hpp"

#include <stdexcept>

namespace nlmech::spacecraft {
ShearBeam solid_section(const Parameters&, double, double, double) {
  throw std::logic_error("solid_section");
}
TimoshenkoPlant::TimoshenkoPlant(const Parameters& p, const ShearBeam& b) : parameters_(p), beam_(b) {}
Response TimoshenkoPlant::response(Complex, double) const { throw std::logic_error("TimoshenkoPlant"); }
Complex TimoshenkoPlant::inertia(Complex) const { throw std::logic_error("TimoshenkoPlant"); }
double TimoshenkoPlant::cutoff() const { throw std::logic_error("TimoshenkoPlant"); }
std::vector<double> TimoshenkoPlant::poles(int, double) const { throw std::logic_error("TimoshenkoPlant"); }
}  // namespace nlmech::spacecraft

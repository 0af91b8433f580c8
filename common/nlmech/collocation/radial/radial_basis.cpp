#include "nlmech/collocation/radial/radial_basis.hpp"

#include <cmath>
#include <sstream>

namespace nlmech::collocation {

template class RadialBasis<double>;

void require_shape(const char* what, double shape) {
  if (shape > 0 && std::isfinite(shape)) return;
  std::ostringstream text;
  text << what << ": the shape must be positive and finite, is " << shape;
  throw std::invalid_argument(text.str());
}

}  // namespace nlmech::collocation

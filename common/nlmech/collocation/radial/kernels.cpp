#include "nlmech/collocation/radial/kernels.hpp"

namespace nlmech::collocation {

std::string_view to_string(Kernel kernel) {
  switch (kernel) {
    case Kernel::gaussian: return "gaussian";
    case Kernel::inverse_quadratic: return "inverse-quadratic";
    case Kernel::multiquadric: return "multiquadric";
    case Kernel::inverse_multiquadric: return "inverse-multiquadric";
  }
  throw std::invalid_argument("to_string: no such kernel");
}

}  // namespace nlmech::collocation

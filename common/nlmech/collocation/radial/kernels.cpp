#include "nlmech/collocation/radial/kernels.hpp"

#include <string>

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

Kernel kernel_from_string(std::string_view name) {
  std::string known;
  for (const Kernel kernel :
       {Kernel::gaussian, Kernel::inverse_quadratic, Kernel::multiquadric, Kernel::inverse_multiquadric}) {
    if (name == to_string(kernel)) return kernel;
    known += (known.empty() ? "" : ", ") + std::string(to_string(kernel));
  }
  throw std::invalid_argument("there is no kernel '" + std::string(name) + "'; there is " + known);
}

}  // namespace nlmech::collocation

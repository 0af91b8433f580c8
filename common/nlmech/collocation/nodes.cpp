#include "nlmech/collocation/nodes.hpp"

namespace nlmech::collocation {

template Vector<double> jacobi_zeros(int m, int a, int b);

std::string_view to_string(NodeFamily family) {
  switch (family) {
    case NodeFamily::legendre_gauss_lobatto: return "legendre-gauss-lobatto";
    case NodeFamily::left_end_and_radau: return "left-end-and-radau";
    case NodeFamily::chebyshev_gauss_lobatto: return "chebyshev-gauss-lobatto";
  }
  throw std::invalid_argument("to_string: no such family of nodes");
}

}  // namespace nlmech::collocation

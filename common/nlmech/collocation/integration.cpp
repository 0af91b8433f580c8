#include "nlmech/collocation/integration.hpp"

#include <string>

namespace nlmech::collocation {

void require_chebyshev_degree(int n, int degree) {
  if (degree >= 0 && degree < n) return;
  throw std::invalid_argument("chebyshev_picard_matrix: the degree must lie between 0 and " +
                              std::to_string(n - 1) + " for " + std::to_string(n) + " nodes, is " +
                              std::to_string(degree));
}

}  // namespace nlmech::collocation

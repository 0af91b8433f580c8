// Lobatto's three nodes.
#include <cmath>

#include "nlmech/collocation/nodes.hpp"

int main() {
  const Eigen::VectorXd nodes = nlmech::collocation::legendre_gauss_lobatto(3);
  return std::abs(nodes[0] + 1) + std::abs(nodes[1]) + std::abs(nodes[2] - 1) < 1e-15 ? 0 : 1;
}

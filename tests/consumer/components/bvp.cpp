// Three of Lobatto's nodes on [0, 1] and Simpson's weights.
#include <cmath>

#include "nlmech/bvp/scheme.hpp"

int main() {
  using namespace nlmech::bvp;
  const SchemeOrStatus made = make_scheme(Family::lobatto, 3, 1);
  return made.status.ok() && std::abs(made.scheme.weights[1] - 2 / 3.0) < 1e-15 ? 0 : 1;
}

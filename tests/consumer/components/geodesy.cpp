// The pole is at a latitude of a right angle.
#include <cmath>
#include <numbers>

#include "nlmech/geodesy/perturbation.hpp"

int main() {
  using namespace nlmech::geodesy;
  const auto found = reverse({0, 0, 6356752.314245}, Ellipsoid::wgs84(), PerturbationSeries{.order = 4});
  return std::abs(found.position.latitude - std::numbers::pi / 2) < 1e-12 ? 0 : 1;
}

#include <cmath>
#include <cstdio>

#include "nlmech/geodesy/perturbation.hpp"

// The same point there and back; 0 if the height returns to a tenth of a millimetre.
int main() {
  using namespace nlmech::geodesy;
  const Ellipsoid earth = Ellipsoid::wgs84();
  const Geodetic given{0.7, -1.2, 400e3};
  const auto found = reverse(forward(given, earth), earth, PerturbationSeries{.order = 4});
  std::printf("%s, height %.6f m\n", nlmech::to_string(found.outcome).data(), found.position.height);
  return std::abs(found.position.height - given.height) < 1e-4 ? 0 : 1;
}

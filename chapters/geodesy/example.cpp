/// @example chapters/geodesy/example.cpp
/// A satellite's latitude, longitude and height from its Cartesian position.
//! [example]
#include <cstdio>
#include <numbers>

#include "nlmech/geodesy/perturbation.hpp"

int main() {
  using namespace nlmech::geodesy;
  const Cartesian satellite{4510731, 4510731, 2500000};  // metres
  const auto found = reverse(satellite, Ellipsoid::wgs84(), PerturbationSeries{.order = 5});
  const double degree = std::numbers::pi / 180;
  std::printf("%s: latitude %.10f, longitude %.10f, height %.3f\n", to_string(found.outcome).data(),
              found.position.latitude / degree, found.position.longitude / degree, found.position.height);
}
//! [example]

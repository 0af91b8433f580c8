/// @example chapters/geodesy/example.cpp
/// A satellite's latitude, longitude and height from its Cartesian position.
//! [example]
#include <cstdio>
#include <numbers>

#include "nlmech/geodesy/reverse_transform.hpp"

int main() {
  using namespace nlmech::geodesy;
  const ReverseTransform reverse(Ellipsoid::wgs84());                              // reusable for many points
  const auto [position, outcome] = reverse(Cartesian{4510731, 4510731, 2500000});  // metres
  const double degree = std::numbers::pi / 180;
  std::printf("%s: latitude %.12f, longitude %.12f, height %.6f\n", to_string(outcome).data(),
              position.latitude / degree, position.longitude / degree, position.height);
}
//! [example]

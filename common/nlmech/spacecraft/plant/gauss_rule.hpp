/// @file
/// Gauss-Legendre quadrature with ten points. Internal to the component.
#pragma once

#include <array>
#include <boost/math/quadrature/gauss.hpp>

namespace nlmech::spacecraft {

/// Quadrature point on [-1, 1].
struct GaussPoint {
  double place;   ///< abscissa
  double weight;  ///< quadrature weight
};

/// Gauss-Legendre rule with ten points: exact for polynomials of degree 19.
inline const std::array<GaussPoint, 10> gauss_rule = [] {
  using Rule = boost::math::quadrature::gauss<double, 10>;
  std::array<GaussPoint, 10> rule;
  for (std::size_t i = 0; i < 5; ++i) {
    rule[2 * i] = {-Rule::abscissa()[i], Rule::weights()[i]};
    rule[2 * i + 1] = {Rule::abscissa()[i], Rule::weights()[i]};
  }
  return rule;
}();

}  // namespace nlmech::spacecraft

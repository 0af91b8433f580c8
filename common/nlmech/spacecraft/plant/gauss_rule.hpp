/// @file
/// Gauss and Legendre's rule of ten points. Internal to the component.
#pragma once

#include <array>

namespace nlmech::spacecraft {

/// A pair of points of a symmetric rule on [-1, 1].
struct GaussPair {
  double place;   ///< of the right one; the other is its mirror image
  double weight;  ///< of each
};

/// The five pairs of the rule of ten points: exact for polynomials of degree 19.
inline constexpr std::array<GaussPair, 5> gauss_rule = {{{0.14887433898163121, 0.29552422471475287},
                                                         {0.43339539412924719, 0.26926671930999636},
                                                         {0.67940956829902441, 0.21908636251598204},
                                                         {0.86506336668898451, 0.14945134915058059},
                                                         {0.97390652851717172, 0.066671344308688138}}};

}  // namespace nlmech::spacecraft

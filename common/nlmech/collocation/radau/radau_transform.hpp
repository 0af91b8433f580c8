/// @file
/// The method Radau IIA in the coordinates in which its stages decouple.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "nlmech/collocation/radau/radau.hpp"

namespace nlmech::collocation {

/// T^-1 A^-1 T = Lambda for the A of s Radau nodes, s odd: one real eigenvalue and pairs of complex ones. In
/// w = T^-1 z the linear equations of all stages fall apart into one real system and (s - 1)/2 complex ones
/// of the size of the state (E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, section
/// IV.8). A pair of rows of T^-1 z is the real and the imaginary part of one complex component.
template <int s>
struct RadauTransform {
  static_assert(s % 2 == 1, "an even number of stages has no real eigenvalue");
  static constexpr int pairs = (s - 1) / 2;  ///< of complex eigenvalues

  double real;                                      ///< the real eigenvalue of A^-1
  std::array<std::complex<double>, pairs> complex;  ///< one of each pair, with positive imaginary part
  typename Radau<s>::Square to;                     ///< T^-1: row 0 real; rows 2p + 1 and 2p + 2 the parts
  typename Radau<s>::Square from;                   ///< T
};

/// The tables, made at the first call, with an error of a few ulps times the condition of T. @tparam s 3, 5
/// or 7
template <int s>
[[nodiscard]] const RadauTransform<s>& radau_transform();

/// @cond instances compiled in the library
extern template const RadauTransform<3>& radau_transform<3>();
extern template const RadauTransform<5>& radau_transform<5>();
extern template const RadauTransform<7>& radau_transform<7>();
/// @endcond

}  // namespace nlmech::collocation

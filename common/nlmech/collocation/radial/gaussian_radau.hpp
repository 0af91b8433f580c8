/// @file
/// Radau's nodes with Gaussian functions in place of polynomials.
#pragma once

#include "nlmech/collocation/radau/radau.hpp"

namespace nlmech::collocation {

/// Tables for a slope that is the derivative of a sum of s + 1 Gaussians exp(-c^2 (t - t_k)^2), at the begin
/// and the s Radau nodes of the unit interval, that vanishes at the begin. Computed by StableGaussian, so
/// that wide functions lose no digits; as c goes to 0 they are those of radau<s>(), by c^2 off.
///
/// Gaussians do not contain the constants: a constant slope is integrated with an error that falls with c
/// (Elgohary 2015, section 4.3, leaves that out), and the end is not of order 2s - 1.
/// @param shape  c times the length of the step, from 0 to StableGaussian::largest_shape
/// @param tables integral, twice and left are set; nodes and legendre are those of the polynomials
/// @returns false if the matrix of derivatives at the nodes has no inverse in double precision
/// @throws std::invalid_argument if the shape is out of range
template <int s>
[[nodiscard]] bool gaussian_radau(double shape, Radau<s>& tables);

/// @cond instances compiled in the library
extern template bool gaussian_radau<8>(double, Radau<8>&);
extern template bool gaussian_radau<12>(double, Radau<12>&);
extern template bool gaussian_radau<16>(double, Radau<16>&);
/// @endcond

}  // namespace nlmech::collocation

/// @file
/// Collocation at Radau nodes as matrices on [0, 1]: the method Radau IIA, and Gaussian functions in place of
/// polynomials.
#pragma once

#include <Eigen/Core>

namespace nlmech::collocation {

/// Collocation at the s Radau nodes of the unit interval, the last of which is its end, for a slope that is
/// polynomial of degree s - 1. With F the values of the slope at the nodes, x_i = x_0 + h sum_j A_ij F_j; the
/// last row of A are the weights of the quadrature. Order 2s - 1 at the end, s + 1 between (E. Hairer and
/// G. Wanner, Solving Ordinary Differential Equations II, section IV.5). For accelerations the positions
/// follow by A A. Computed with 64 digits of mantissa and rounded: within an ulp of the largest entry.
template <int s>
struct Radau {
  static constexpr int stages = s;             ///< number of nodes
  using Column = Eigen::Matrix<double, s, 1>;  ///< a number for each node
  using Square = Eigen::Matrix<double, s, s>;  ///< a number for each pair

  Column nodes;     ///< c_i, ascending, in (0, 1]
  Square integral;  ///< A
  Square twice;     ///< A A
  Column left;      ///< l_j(0): from values at the nodes to the value at the start
  Square legendre;  ///< row k: from values at the nodes to the coefficient of P_k(2 c - 1)
};

/// The tables, made at the first call. @tparam s 3 to 16
template <int s>
[[nodiscard]] const Radau<s>& radau();

/// @cond instances compiled in the library
extern template const Radau<3>& radau<3>();
extern template const Radau<5>& radau<5>();
extern template const Radau<7>& radau<7>();
extern template const Radau<8>& radau<8>();
extern template const Radau<12>& radau<12>();
extern template const Radau<16>& radau<16>();
/// @endcond

/// Tables for a slope that is the derivative of a sum of s + 1 Gaussians exp(-c^2 (t - t_k)^2), at the start
/// and the s Radau nodes of the unit interval, that vanishes at the start. Computed by StableGaussian, so
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

/// @file
/// Matrices of collocation at Radau nodes on [0, 1]: Radau IIA, and Gaussian functions in place of
/// polynomials.
#pragma once

#include <Eigen/Core>

namespace nlmech::collocation {

/// Radau IIA: collocation at the s Radau nodes of the unit interval, the last of which is 1, with a slope
/// that is a polynomial of degree s - 1. With the values F of the slope at the nodes, x_i = x_0 + h sum_j
/// A_ij F_j; the last row of A holds the quadrature weights. Order 2s - 1 at the end of the step, s + 1
/// between (E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, section IV.5). For
/// accelerations the positions follow by A A. Computed with a 64-bit mantissa and rounded: errors within an
/// ulp of the largest entry.
template <int s>
struct Radau {
  static constexpr int stages = s;             ///< number of nodes
  using Column = Eigen::Matrix<double, s, 1>;  ///< one number per node
  using Square = Eigen::Matrix<double, s, s>;  ///< one number per pair of nodes

  Column nodes;     ///< c_i, ascending, in (0, 1]
  Square integral;  ///< A
  Square twice;     ///< A A, for second-order equations
  Column left;      ///< l_j(0): from values at the nodes to the value at the start
  Square legendre;  ///< row k: from values at the nodes to the coefficient of P_k(2 c - 1)
};

/// The tables, computed at the first call. @tparam s 3 to 16
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

/// Tables for Gaussian trial functions: the slope is the derivative of a sum of s + 1 Gaussians exp(-c^2 (t -
/// t_k)^2), centred at the start and the s Radau nodes of the unit interval, and the sum vanishes at the
/// start. Computed by StableGaussian without loss of digits for wide functions. For c -> 0 they tend to
/// radau<s>(), with a difference of order c^2.
///
/// Gaussians do not reproduce constants: a constant slope is integrated with an error that decreases with c
/// (not mentioned in Elgohary 2015, section 4.3), and the order at the end is not 2s - 1.
/// @param shape  c times the step size, from 0 to StableGaussian::largest_shape
/// @param tables receives all tables; nodes and legendre are those of radau<s>()
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

/// @file
/// Numbers of 50 digits in Eigen's matrices, and what the studies compute of collocation with them.
#pragma once

#include <boost/multiprecision/eigen.hpp>
#include <complex>
#include <vector>

#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/kernels.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::rbf_ivp {

/// 50 decimal digits. Without expression templates, which Eigen does not expect.
using Digits50 = ExtendedReal<50>;

/// The nodes of a family on the unit interval.
[[nodiscard]] collocation::Vector<Digits50> unit_nodes(collocation::NodeFamily family, int n);

/// The differentiation matrix of polynomials at these nodes, on the unit interval.
[[nodiscard]] collocation::Matrix<Digits50> polynomial_derivative(collocation::NodeFamily family, int n);

/// The same of Gaussians with the shape @p relative_shape, c times the length of the interval.
[[nodiscard]] collocation::Matrix<Digits50> radial_derivative(collocation::NodeFamily family, int n,
                                                              double relative_shape);

/// The stability function of collocation: x1 = R(z) x0 for x' = lambda x with z = lambda h, when the equation
/// holds at all nodes but the first.
/// @param derivative on the unit interval, the first node at its begin, the last one at its end
[[nodiscard]] Digits50 stability_function(const collocation::Matrix<Digits50>& derivative, const Digits50& z);

/// The same in double for a complex z. Its error is 1e-13 for polynomials of 35 nodes and |z| < 1000.
[[nodiscard]] std::complex<double> stability_function(const Eigen::MatrixXd& derivative,
                                                      std::complex<double> z);

/// The same for polynomials, from the nodes alone: M^(s)(1) + M^(s-1)(1) z + ... + M(1) z^s over the same
/// with 0 for 1, where M has the s nodes but the first as its zeros (E. Hairer, G. Wanner, Solving Ordinary
/// Differential Equations II, 1996, Theorem IV.3.9). Shares nothing with the matrices.
/// @param nodes on the unit interval, the first one 0
/// @return |R(iy)|, computed with 50 digits, of which it loses one or so for each node
[[nodiscard]] double polynomial_amplification(const collocation::Vector<Digits50>& nodes, double y);

/// The order of consistency for linear equations: R(z) - exp(z) = O(z^(order + 1)), from the two values at
/// @p z and z/2; off by O(z).
[[nodiscard]] double linear_order(const collocation::Matrix<Digits50>& derivative, const Digits50& z);

/// A window of the imaginary axis on which a method amplifies oscillations.
struct Window {
  double begin;    ///< first y with |R(iy)| above the threshold
  double end;      ///< last one
  double largest;  ///< of |R(iy)| in between, refined between the samples
  double place;    ///< y of the largest
};

/// The windows in 0 < y <= last with |R(iy)| > threshold, sampled @p per_unit times a unit of y.
[[nodiscard]] std::vector<Window> windows_above(const Eigen::MatrixXd& derivative, double last,
                                                double threshold, int per_unit);

}  // namespace nlmech::chapters::rbf_ivp

/// @file
/// Stability of collocation on the imaginary axis: windows in which an undamped oscillation is amplified.
#pragma once

#include <complex>
#include <vector>

#include "nlmech/collocation/nodes.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Stability function of collocation at all nodes except the first: x1 = R(z) x0 for x' = lambda x with z =
/// lambda h. The error is 1e-13 for polynomials of 35 nodes and |z| < 1000.
/// @param derivative matrix on the unit interval; first node 0, last node 1
[[nodiscard]] std::complex<double> stability_function(const Eigen::MatrixXd& derivative,
                                                      std::complex<double> z);

/// |R(iy)| of polynomial collocation from the nodes, without matrices: R(z) is
/// M^(s)(1) + M^(s-1)(1) z + ... + M(1) z^s over the same with 0 for 1. The zeros of M are the s nodes after
/// the first (E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 1996, Theorem IV.3.9).
/// Computed with 50 digits; about one digit per node is lost.
[[nodiscard]] double polynomial_amplification(collocation::NodeFamily family, int nodes, double y);

/// A window of the imaginary axis on which a method amplifies oscillations.
struct Window {
  double start;    ///< first sampled y with |R(iy)| above the threshold
  double end;      ///< last sampled y above the threshold
  double largest;  ///< maximum of |R(iy)|, refined between the samples
  double place;    ///< y of the maximum
};

/// Windows in 0 < y <= @p last with |R(iy)| > @p threshold, from @p per_unit samples per unit of y.
[[nodiscard]] std::vector<Window> windows_above(const Eigen::MatrixXd& derivative, double last,
                                                double threshold, int per_unit);

}  // namespace nlmech::chapters::rbf_ivp

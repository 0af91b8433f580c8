/// @file
/// Stability of collocation on the imaginary axis: where an undamped oscillation grows from step to step.
#pragma once

#include <complex>
#include <vector>

#include "nlmech/collocation/nodes.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::rbf_ivp {

/// The stability function of collocation: x1 = R(z) x0 for x' = lambda x with z = lambda h, when the equation
/// holds at all nodes but the first. Its error is 1e-13 for polynomials of 35 nodes and |z| < 1000.
/// @param derivative on the unit interval, the first node at its start, the last one at its end
[[nodiscard]] std::complex<double> stability_function(const Eigen::MatrixXd& derivative,
                                                      std::complex<double> z);

/// |R(iy)| of polynomials from the nodes alone: R(z) is M^(s)(1) + M^(s-1)(1) z + ... + M(1) z^s over the
/// same with 0 for 1, where M has the s nodes but the first as its zeros (E. Hairer, G. Wanner, Solving
/// Ordinary Differential Equations II, 1996, Theorem IV.3.9). Shares nothing with the matrices. Computed with
/// 50 digits, of which it loses about one for each node.
[[nodiscard]] double polynomial_amplification(collocation::NodeFamily family, int nodes, double y);

/// A window of the imaginary axis on which a method amplifies oscillations.
struct Window {
  double start;    ///< first y with |R(iy)| above the threshold
  double end;      ///< last one
  double largest;  ///< of |R(iy)| in between, refined between the samples
  double place;    ///< y of the largest
};

/// The windows in 0 < y <= last with |R(iy)| > threshold, sampled @p per_unit times a unit of y.
[[nodiscard]] std::vector<Window> windows_above(const Eigen::MatrixXd& derivative, double last,
                                                double threshold, int per_unit);

}  // namespace nlmech::chapters::rbf_ivp

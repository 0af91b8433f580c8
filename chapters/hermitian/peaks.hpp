/// @file
/// First peak of the response, as printed in Tables 4 and 5 of the paper.
#pragma once

#include "nlmech/ivp/hermitian/hermitian.hpp"

namespace nlmech::chapters::hermitian {

/// An oscillator of one degree of freedom with its initial state and the sign of its first peak.
struct Case {
  ivp::System system;  ///< equation
  ivp::State x0;       ///< initial position and velocity
  double sign;         ///< 1: a maximum; -1: a minimum
};

/// Equation (11) from rest; the paper states no initial state.
[[nodiscard]] Case duffing_case();
/// Van der Pol oscillator from (0.01, 0), which fits the printed values; the paper states no initial state.
[[nodiscard]] Case van_der_pol_case();

/// First peak: the first zero of the velocity with a change of sign from Case::sign.
struct Peak {
  Status status;       ///< success, or why there is no peak
  double t = 0;        ///< time, by the dense output of the step
  double x = 0;        ///< position at the peak
  double on_grid = 0;  ///< larger of the positions (times sign) at both ends of the step
};

/// Finds the first peak before @p end. @param method operators and step size
[[nodiscard]] Peak first_peak(const Case& what, const ivp::Hermitian& method, double end);

}  // namespace nlmech::chapters::hermitian

/// @file
/// The first peak of the response, which is what the paper's tables 4 and 5 print.
#pragma once

#include "nlmech/ivp/hermitian/hermitian.hpp"

namespace nlmech::chapters::hermitian {

/// What starts an oscillator of one degree of freedom, and which way it peaks.
struct Case {
  ivp::System system;  ///< equation
  ivp::State x0;       ///< position and velocity at first
  double sign;         ///< 1: a maximum; -1: a minimum
};

/// Equation (11) from rest; the paper names no start.
[[nodiscard]] Case duffing_case();
/// Van der Pol's oscillator from (0.01, 0), the start that fits; the paper names none.
[[nodiscard]] Case van_der_pol_case();

/// Where the velocity first passes zero against the sign after the start.
struct Peak {
  Status status;       ///< success, or why there is none
  double t = 0;        ///< time, by the dense output of the step
  double x = 0;        ///< position there
  double on_grid = 0;  ///< position at the end of a step that is furthest out
};

/// The first peak before @p end. @param method operators and step
[[nodiscard]] Peak first_peak(const Case& what, const ivp::Hermitian& method, double end);

}  // namespace nlmech::chapters::hermitian

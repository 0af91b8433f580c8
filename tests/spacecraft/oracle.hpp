/// @file
/// What the tests of the spacecraft judge by: the boundary value problem of Eqs. 3.15-3.16 in 110 digits, two
/// ways, in physical units, sharing nothing with the library.
#pragma once

#include <complex>

#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::spacecraft::oracle {

using Complex = std::complex<double>;

/// Both transfer functions rounded to double, and their conditions |s G'/G|.
struct Exact {
  Complex theta, deflection;
  double theta_condition, deflection_condition;
};

/// w = y + (r + x) theta as a sum of decaying exponentials from root and tip: any s.
[[nodiscard]] Exact by_exponentials(const Parameters& parameters, Complex s, double x);

/// w as a sum of cos, sin, cosh and sinh: up to |beta|^(1/4) L of about 60.
[[nodiscard]] Exact by_hyperbolics(const Parameters& parameters, Complex s, double x);

}  // namespace nlmech::spacecraft::oracle

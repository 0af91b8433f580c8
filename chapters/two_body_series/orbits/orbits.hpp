/// @file
/// The two orbits of the dissertation.
#pragma once

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/state.hpp"

namespace nlmech::chapters::two_body_series {

/// An orbit with its settings in the dissertation; SI units.
struct Orbit {
  const char* name;    ///< "LEO" or "HEO"
  orbit::State start;  ///< initial state, Eq. 3.71 or 3.73
  int steps;           ///< steps of Analytic-Cont per orbit
  int order;           ///< "Deriv Order"
};

/// mu of WGS 84. The dissertation prints no mu; its states fit 3.98600433e14 to their last digit.
inline constexpr double earth_mu = 3.986004418e14;

/// Low orbit, e = 0.1 (Eqs. 3.71, 3.72).
[[nodiscard]] inline Orbit low_orbit() {
  return {"LEO",
          {{1.702547136867679e6, 6.353992417071098e6, 0}, {-7.886014053829254e3, 2.113051097224035e3, 0}},
          25,
          10};
}
/// High eccentric orbit, e = 0.7 (Eqs. 3.73, 3.74).
[[nodiscard]] inline Orbit high_orbit() {
  return {"HEO",
          {{2.096434265330419e6, 7.823999192941453e6, 0}, {-8.834757074967362e3, 2.367266023562654e3, 0}},
          100,
          30};
}

}  // namespace nlmech::chapters::two_body_series

/// @file
/// Exact transfer functions on the imaginary axis in 100 digits, by decaying waves and Gaussian elimination:
/// a reference independent of the library.
#pragma once

#include <array>

#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters::gss_control {

/// theta/u and y/u at one frequency, rounded to double, with their condition numbers |omega G'/G| with
/// respect to the frequency.
struct Extended {
  std::array<double, 3> value{};      ///< theta/u, y(L/2)/u, y(L)/u
  std::array<double, 3> condition{};  ///< |omega G'/G| of each value
};

/// Reference values at s = j omega.
/// @param omega rad/s, positive
[[nodiscard]] Extended extended_response(const spacecraft::Parameters& parameters, double omega);

}  // namespace nlmech::chapters::gss_control

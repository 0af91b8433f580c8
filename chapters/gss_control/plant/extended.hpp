/// @file
/// The exact transfer functions on the imaginary axis in 100 digits, by decaying waves and an elimination: an
/// oracle that shares nothing with the library.
#pragma once

#include <array>

#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::chapters::gss_control {

/// theta/u and y/u at one frequency, rounded to double, and how much a relative change of the frequency
/// changes them: |omega G'/G|.
struct Extended {
  std::array<double, 3> value{};      ///< theta/u, y(L/2)/u, y(L)/u
  std::array<double, 3> condition{};  ///< of each
};

/// @param omega rad/s, positive
[[nodiscard]] Extended extended_response(const spacecraft::Parameters& parameters, double omega);

}  // namespace nlmech::chapters::gss_control

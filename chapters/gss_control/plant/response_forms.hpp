/// @file
/// Three evaluations of the exact transfer functions, for the scenes that compare them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nlmech/spacecraft/plant/plant.hpp"

namespace nlmech::chapters::gss_control {

/// Form of evaluation.
enum class Form : std::uint8_t {
  closed,  ///< closed form with f and its derivatives (3.28, 3.33, 3.42), misprints corrected
  krylov,  ///< power series in beta, without cancellation at small s
  scaled   ///< series at small s, decaying waves at large s, as in the library
};
inline constexpr std::size_t form_count = 3;

/// Name of the form for legends.
[[nodiscard]] const char* form_name(Form form);

/// theta/u and y(x)/u at s = j omega.
struct FormValue {
  double theta = 0, deflection = 0;
};
[[nodiscard]] FormValue evaluate(const spacecraft::Plant& plant, Form form, double omega, double x);

}  // namespace nlmech::chapters::gss_control

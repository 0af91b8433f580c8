/// @file
/// Three ways to evaluate the exact transfer functions, for the scenes that compare them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nlmech/spacecraft/plant/plant.hpp"

namespace nlmech::chapters::gss_control {

/// Which evaluation.
enum class Form : std::uint8_t {
  closed,  ///< f and its derivatives (3.28, 3.33, 3.42), misprints corrected
  krylov,  ///< power series in beta, nothing subtracted at small s
  scaled   ///< series at small s, decaying waves at large: what the library uses
};
inline constexpr std::size_t form_count = 3;

/// For legends.
[[nodiscard]] const char* form_name(Form form);

/// Values at s = j omega.
struct FormValue {
  double theta = 0, deflection = 0;
};
[[nodiscard]] FormValue evaluate(const spacecraft::Plant& plant, Form form, double omega, double x);

}  // namespace nlmech::chapters::gss_control

/// @file
/// The oscillators of Laier's paper with its parameters and starts.
#pragma once

#include <string_view>

#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::problems {

/// Duffing's oscillator with damping and a force, from rest.
struct LaierDuffing : DrivenDuffing {
  static constexpr std::string_view name = "laier-duffing";  ///< on command lines
  /// The paper's parameters.
  LaierDuffing()
      : DrivenDuffing{.damping = 0.4, .stiffness = 1, .hardening = 0.5, .force = 0.5, .frequency = 0.5} {}
  /// At rest.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {0, 0}; }
};

/// Van der Pol's oscillator, begun near its unstable rest.
struct LaierVanDerPol : VanDerPol {
  static constexpr std::string_view name = "laier-van-der-pol";  ///< on command lines
  /// The paper's parameter.
  LaierVanDerPol() : VanDerPol{.mu = 1.5} {}
  /// Near rest.
  [[nodiscard]] static Vector<double, 2> initial_state() { return {0.01, 0}; }
};

}  // namespace nlmech::problems

/// @file
/// The backward Euler method.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Backward Euler, x1 = x0 + h f(t1, x1) (Elgohary 2015, Eq. 4.5): order 1, A- and L-stable; oscillations are
/// damped by 1/sqrt(1 + (h omega)^2) per step. Solved by Newton's iteration with the exact Jacobian, from x1
/// = x0. Dense output: linear interpolation, order 1.
///
/// Tests assert its closed form on the linear oscillator for h omega from 0.1 to 100 (1e-13), order 1 at and
/// within steps (observed within 0.1), and a loss of energy in every step.
struct BackwardEuler {
  static constexpr std::string_view name = "backward-euler";  ///< on command lines and in tables
  double step = 0.01;                                         ///< step size, positive
  algebraic::Newton newton = {};                              ///< solves each step's equations for x1
};

/// See integrate().
[[nodiscard]] Solution run(const InitialValueProblem& problem, const BackwardEuler& method);

}  // namespace nlmech::ivp

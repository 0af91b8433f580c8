/// @file
/// CVODE of SUNDIALS behind our interface, if this build has it.
#pragma once

#include <string_view>

#include "nlmech/peers/ivp/run_peer.hpp"

namespace nlmech::peers {

/// CVODE (S. D. Cohen, A. C. Hindmarsh, CVODE, a stiff/nonstiff ODE solver in C, Computers in Physics 10
/// (1996) 138-143): multistep formulas of variable order and step. Adams solves its formula by fixed-point
/// iteration, BDF by Newton's with the exact Jacobian and dense factorisation. Dense output is CVODE's own
/// interpolant, of the order of the formula.
struct Cvode {
  /// Which family of formulas.
  enum class Formula {
    adams,  ///< orders 1 to 12, for problems that are not stiff
    bdf     ///< orders 1 to 5, for stiff ones
  };
  Formula formula = Formula::bdf;    ///< family
  double relative_tolerance = 1e-9;  ///< of a step's error, root mean square; zero or more
  double absolute_tolerance = 1e-9;  ///< added to it; positive

  /// "cvode-adams" or "cvode-bdf".
  [[nodiscard]] std::string_view name() const {
    return formula == Formula::adams ? "cvode-adams" : "cvode-bdf";
  }
};

/// Was the library found when this program was built?
[[nodiscard]] bool cvode_available() noexcept;

/// Runs CVODE on arrays. @throws std::logic_error if the build has no CVODE
/// @throws std::invalid_argument for tolerances out of range
[[nodiscard]] Status integrate_by(Run& run, const Cvode& method);

}  // namespace nlmech::peers

/// @file
/// CVODE of SUNDIALS as a peer; optional.
#pragma once

#include <string_view>

#include "nlmech/peers/ivp/run_peer.hpp"

namespace nlmech::peers {

/// CVODE (S. D. Cohen, A. C. Hindmarsh, CVODE, a stiff/nonstiff ODE solver in C, Computers in Physics 10
/// (1996) 138-143): multistep formulas of variable order and step size. Adams formulas are solved by
/// fixed-point iteration, BDF by Newton's method with the exact Jacobian and dense factorisation. Dense
/// output is CVODE's own interpolant, of the order of the formula.
struct Cvode {
  /// Families of formulas.
  enum class Formula {
    adams,  ///< Adams formulas of orders 1 to 12, for non-stiff problems
    bdf     ///< backward differentiation formulas of orders 1 to 5, for stiff problems
  };
  Formula formula = Formula::bdf;    ///< family
  double relative_tolerance = 1e-9;  ///< relative tolerance of a step's error, root mean square; >= 0
  double absolute_tolerance = 1e-9;  ///< absolute tolerance of a step's error; positive

  /// "cvode-adams" or "cvode-bdf".
  [[nodiscard]] std::string_view name() const {
    return formula == Formula::adams ? "cvode-adams" : "cvode-bdf";
  }
};

/// Does this build have CVODE?
[[nodiscard]] bool cvode_available() noexcept;

/// Runs CVODE on arrays. @throws std::logic_error if the build has no CVODE
/// @throws std::invalid_argument for tolerances out of range
[[nodiscard]] Status integrate_by(Run& run, const Cvode& method);

}  // namespace nlmech::peers

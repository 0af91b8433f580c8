/// @file
/// ARKODE of SUNDIALS behind our interface, if this build has it.
#pragma once

#include <string_view>

#include "nlmech/peers/ivp/run_peer.hpp"

namespace nlmech::peers {

/// ARKODE (D. R. Reynolds, D. J. Gardner, C. S. Woodward, R. Chinomona, ARKODE: A flexible IVP solver
/// infrastructure for one-step methods, ACM Trans. Math. Softw. 49 (2023) 19) with its default tables, both
/// of order 4: an explicit method, and a diagonally implicit one with Newton's iteration, the exact Jacobian
/// and dense factorisation. Dense output is ARKODE's own, a cubic through both ends of the step: its error,
/// h^4/384 max |x''''|, is no part of the step control.
struct Arkode {
  /// Which kind of Runge-Kutta method.
  enum class Formula {
    erk,  ///< explicit
    dirk  ///< diagonally implicit, for stiff problems
  };
  Formula formula = Formula::dirk;   ///< kind
  double relative_tolerance = 1e-9;  ///< of a step's error, root mean square; zero or more
  double absolute_tolerance = 1e-9;  ///< added to it; positive

  /// "arkode-erk" or "arkode-dirk".
  [[nodiscard]] std::string_view name() const {
    return formula == Formula::erk ? "arkode-erk" : "arkode-dirk";
  }
};

/// Was the library found when this program was built?
[[nodiscard]] bool arkode_available() noexcept;

/// Runs ARKODE on arrays. @throws std::logic_error if the build has no ARKODE
/// @throws std::invalid_argument for tolerances out of range
[[nodiscard]] Status integrate_by(Run& run, const Arkode& method);

}  // namespace nlmech::peers

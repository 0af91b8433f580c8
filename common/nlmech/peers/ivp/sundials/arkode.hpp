/// @file
/// ARKODE of SUNDIALS as a peer; optional.
#pragma once

#include <string_view>

#include "nlmech/peers/ivp/run_peer.hpp"

namespace nlmech::peers {

/// ARKODE (D. R. Reynolds, D. J. Gardner, C. S. Woodward, R. Chinomona, ARKODE: A flexible IVP solver
/// infrastructure for one-step methods, ACM Trans. Math. Softw. 49 (2023) 19) with its default tables, both
/// of order 4: an explicit method, and a diagonally implicit one with Newton's method, the exact Jacobian and
/// dense factorisation. Dense output is ARKODE's own, a cubic through both ends of the step. The step-size
/// control does not include its error, h^4/384 max |x''''|.
struct Arkode {
  /// Kinds of Runge-Kutta methods.
  enum class Formula {
    erk,  ///< explicit
    dirk  ///< diagonally implicit, for stiff problems
  };
  Formula formula = Formula::dirk;   ///< kind
  double relative_tolerance = 1e-9;  ///< relative tolerance of a step's error, root mean square; >= 0
  double absolute_tolerance = 1e-9;  ///< absolute tolerance of a step's error; positive

  /// "arkode-erk" or "arkode-dirk".
  [[nodiscard]] std::string_view name() const {
    return formula == Formula::erk ? "arkode-erk" : "arkode-dirk";
  }
};

/// Does this build have ARKODE?
[[nodiscard]] bool arkode_available() noexcept;

/// Runs ARKODE on arrays. @throws std::logic_error if the build has no ARKODE
/// @throws std::invalid_argument for tolerances out of range
[[nodiscard]] Status integrate_by(Run& run, const Arkode& method);

}  // namespace nlmech::peers

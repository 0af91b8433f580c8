/// @file
/// The integrators of the GNU Scientific Library behind our interface, if this build has it.
#pragma once

#include <string_view>

#include "nlmech/peers/ivp/run_peer.hpp"

namespace nlmech::peers {

/// gsl_odeiv2 of the GNU Scientific Library (M. Galassi et al., GNU Scientific Library Reference Manual) with
/// its standard step control. bsimp and msbdf get the exact Jacobian and df/dt. Dense output is a step of the
/// same formula from the start of the latest one, under the same error control. The multistep formulas give
/// no access to their interpolant: it is a step of rk8pd for msadams, of bsimp for msbdf.
struct Gsl {
  /// Which formula.
  enum class Formula {
    rkf45,    ///< Runge-Kutta-Fehlberg, order 4(5)
    rk8pd,    ///< Prince-Dormand, order 8(9)
    bsimp,    ///< extrapolated linearly implicit midpoint rule of Bader and Deuflhard, for stiff problems
    msadams,  ///< Adams formulas of orders 1 to 12 in Nordsieck form
    msbdf     ///< backward differentiation formulas of orders 1 to 5 in Nordsieck form, for stiff problems
  };
  Formula formula = Formula::rk8pd;  ///< formula
  double relative_tolerance = 1e-9;  ///< of a step's error, maximum norm; zero or more
  double absolute_tolerance = 1e-9;  ///< added to it; positive

  /// "gsl-rkf45", "gsl-rk8pd", "gsl-bsimp", "gsl-msadams" or "gsl-msbdf".
  [[nodiscard]] std::string_view name() const {
    switch (formula) {
      case Formula::rkf45: return "gsl-rkf45";
      case Formula::bsimp: return "gsl-bsimp";
      case Formula::msadams: return "gsl-msadams";
      case Formula::msbdf: return "gsl-msbdf";
      case Formula::rk8pd: break;
    }
    return "gsl-rk8pd";
  }
};

/// Was the library found when this program was built?
[[nodiscard]] bool gsl_available() noexcept;

/// Runs GSL on arrays. @throws std::logic_error if the build has no GSL
/// @throws std::invalid_argument for tolerances out of range
[[nodiscard]] Status integrate_by(Run& run, const Gsl& method);

}  // namespace nlmech::peers

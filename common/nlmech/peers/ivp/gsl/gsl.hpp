/// @file
/// Integrators of the GNU Scientific Library as peers; optional.
#pragma once

#include <string_view>

#include "nlmech/peers/ivp/run_peer.hpp"

namespace nlmech::peers {

/// gsl_odeiv2 of the GNU Scientific Library (M. Galassi et al., GNU Scientific Library Reference Manual) with
/// its standard step-size control. bsimp and msbdf use the exact Jacobian and df/dt. Dense output is a step
/// from the start of the latest one under the same error control, by the same formula or, because GSL hides
/// the interpolant of the multistep formulas, by rk8pd for msadams and bsimp for msbdf.
struct Gsl {
  /// Formulas.
  enum class Formula {
    rkf45,    ///< Runge-Kutta-Fehlberg, order 4(5)
    rk8pd,    ///< Prince-Dormand, order 8(9)
    bsimp,    ///< extrapolated linearly implicit midpoint rule of Bader and Deuflhard, for stiff problems
    msadams,  ///< Adams formulas of orders 1 to 12 in Nordsieck form
    msbdf     ///< backward differentiation formulas of orders 1 to 5 in Nordsieck form, for stiff problems
  };
  Formula formula = Formula::rk8pd;  ///< formula
  double relative_tolerance = 1e-9;  ///< relative tolerance of a step's error, maximum norm; >= 0
  double absolute_tolerance = 1e-9;  ///< absolute tolerance of a step's error; positive

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

/// Does this build have GSL?
[[nodiscard]] bool gsl_available() noexcept;

/// Runs GSL on arrays. @throws std::logic_error if the build has no GSL
/// @throws std::invalid_argument for tolerances out of range
[[nodiscard]] Status integrate_by(Run& run, const Gsl& method);

}  // namespace nlmech::peers

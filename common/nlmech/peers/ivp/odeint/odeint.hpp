/// @file
/// Boost.Odeint as a peer; optional.
#pragma once

#include <string_view>

#include "nlmech/peers/ivp/run_peer.hpp"

namespace nlmech::peers {

/// Boost.Odeint (K. Ahnert, M. Mulansky, Odeint - Solving ordinary differential equations in C++, AIP Conf.
/// Proc. 1389 (2011) 1586-1589) with its standard step-size control. rosenbrock4 uses the exact Jacobian and
/// df/dt. Dense output of dopri5 and rosenbrock4 is the library's own, of order 4 and 3. That of the others
/// is an integration by the same formula from the start of the step, as accurate as the steps themselves.
struct Odeint {
  /// Formulas.
  enum class Formula {
    dopri5,          ///< Dormand-Prince, order 5(4)
    fehlberg78,      ///< Runge-Kutta-Fehlberg, order 8(7)
    bulirsch_stoer,  ///< extrapolated midpoint rule, orders 4 to 18
    rosenbrock4      ///< Rosenbrock method of order 4(3), for stiff problems
  };
  Formula formula = Formula::dopri5;  ///< formula
  double relative_tolerance =
      1e-9;  ///< relative tolerance of a step's error, maximum norm (rosenbrock4: RMS)
  double absolute_tolerance = 1e-9;  ///< absolute tolerance of a step's error; positive

  /// "odeint-dopri5", "odeint-fehlberg78", "odeint-bulirsch-stoer" or "odeint-rosenbrock4".
  [[nodiscard]] std::string_view name() const {
    switch (formula) {
      case Formula::fehlberg78: return "odeint-fehlberg78";
      case Formula::bulirsch_stoer: return "odeint-bulirsch-stoer";
      case Formula::rosenbrock4: return "odeint-rosenbrock4";
      case Formula::dopri5: break;
    }
    return "odeint-dopri5";
  }
};

/// Does this build have Odeint?
[[nodiscard]] bool odeint_available() noexcept;

/// Runs Odeint on arrays of any size. @throws std::logic_error if the build has no Odeint
/// @throws std::invalid_argument for tolerances out of range
[[nodiscard]] Status integrate_by(Run& run, const Odeint& method);

}  // namespace nlmech::peers

/// @file
/// The integrators of other authors by name: their rows of the registry of methods (ivp/named).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::peers {

/// All peers that integrate: "cvode-adams cvode-bdf arkode-erk arkode-dirk gsl-rkf45 gsl-rk8pd gsl-bsimp
/// gsl-msadams gsl-msbdf odeint-dopri5 odeint-fehlberg78 odeint-bulirsch-stoer odeint-rosenbrock4", in this
/// order, in this build or not. Their only settings are tolerances.
[[nodiscard]] std::span<const ivp::MethodInfo> peer_methods();

/// The peer of that name. @throws std::invalid_argument listing all, if there is none
[[nodiscard]] const ivp::MethodInfo& peer_info(std::string_view name);

/// Names of the peers that this build has.
[[nodiscard]] std::vector<std::string> peer_names();

/// Names of all of them.
[[nodiscard]] std::vector<std::string> all_peer_names();

/// The peer by its name with a relative and an absolute tolerance.
/// @throws std::invalid_argument if there is none of that name, a tolerance is not positive, or this build
/// does not have the peer
[[nodiscard]] ivp::NamedIntegrator peer_integrator(std::string_view name, double relative, double absolute);
/// The same with one tolerance for both.
[[nodiscard]] inline ivp::NamedIntegrator peer_integrator(std::string_view name, double tolerance) {
  return peer_integrator(name, tolerance, tolerance);
}

}  // namespace nlmech::peers

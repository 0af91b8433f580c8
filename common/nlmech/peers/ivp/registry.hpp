/// @file
/// Registry of the peers that integrate (see ivp/named for nlmech methods).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::peers {

/// All integrating peers, also those that this build lacks: "cvode-adams cvode-bdf arkode-erk arkode-dirk
/// gsl-rkf45 gsl-rk8pd gsl-bsimp gsl-msadams gsl-msbdf odeint-dopri5 odeint-fehlberg78 odeint-bulirsch-stoer
/// odeint-rosenbrock4", in this order. Their only settings are tolerances.
[[nodiscard]] std::span<const ivp::MethodInfo> peer_methods();

/// The peer of that name. @throws std::invalid_argument listing all peers for an unknown name
[[nodiscard]] const ivp::MethodInfo& peer_info(std::string_view name);

/// Names of the peers in this build.
[[nodiscard]] std::vector<std::string> peer_names();

/// Names of all peers.
[[nodiscard]] std::vector<std::string> all_peer_names();

/// Integrator of a peer with a relative and an absolute tolerance.
/// @throws std::invalid_argument for an unknown name, a tolerance that is not positive, or a peer that this
/// build lacks
[[nodiscard]] ivp::NamedIntegrator peer_integrator(std::string_view name, double relative, double absolute);
/// Integrator of a peer with the same relative and absolute tolerance.
[[nodiscard]] inline ivp::NamedIntegrator peer_integrator(std::string_view name, double tolerance) {
  return peer_integrator(name, tolerance, tolerance);
}

}  // namespace nlmech::peers

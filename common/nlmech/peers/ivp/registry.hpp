/// @file
/// The integrators of other authors by name: for command lines and for tables of all methods.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::peers {

/// A peer with its tolerance: what is left is the problem.
using PeerIntegrator = ivp::NamedIntegrator;

/// What kind of formula a peer has.
enum class Family {
  runge_kutta,    ///< explicit, one step
  extrapolation,  ///< explicit, one step
  adams,          ///< several steps, not for stiff problems
  implicit        ///< equations are solved in each step, so that stiff problems do not slow it down
};

/// All peers that integrate: "cvode-adams cvode-bdf arkode-erk arkode-dirk gsl-rkf45 gsl-rk8pd gsl-bsimp
/// gsl-msadams gsl-msbdf odeint-dopri5 odeint-fehlberg78 odeint-bulirsch-stoer odeint-rosenbrock4", in this
/// order.
[[nodiscard]] std::vector<std::string> all_peer_names();

/// Those of them that this build has.
[[nodiscard]] std::vector<std::string> peer_names();

/// Is @p name one of all_peer_names()?
[[nodiscard]] bool is_peer(std::string_view name);

/// What there is to know of it; its meaning is the library. @throws std::invalid_argument if @p name is not
/// one of all_peer_names()
[[nodiscard]] ivp::MethodInfo peer_info(std::string_view name);

/// Does this build have it? @throws std::invalid_argument if @p name is not one of all_peer_names()
[[nodiscard]] bool peer_available(std::string_view name);

/// Its kind. @throws std::invalid_argument if @p name is not one of all_peer_names()
[[nodiscard]] Family peer_family(std::string_view name);

/// Is it Family::implicit? @throws std::invalid_argument if @p name is not one of all_peer_names()
[[nodiscard]] bool peer_is_implicit(std::string_view name);

/// "cvode-bdf is not in this build: configure with CVODE (NLMECH_PEERS)": for where an absent peer would
/// stand.
/// @throws std::invalid_argument if @p name is not one of all_peer_names()
[[nodiscard]] std::string absent_peer_sentence(std::string_view name);

/// The peer by its name with a relative and an absolute tolerance.
/// @throws std::invalid_argument if @p name is not one of all_peer_names(), or a tolerance is not positive
/// @throws std::logic_error if this build does not have the peer
[[nodiscard]] PeerIntegrator peer_integrator(std::string_view name, double relative, double absolute);
/// The same with one tolerance for both.
[[nodiscard]] inline PeerIntegrator peer_integrator(std::string_view name, double tolerance) {
  return peer_integrator(name, tolerance, tolerance);
}

}  // namespace nlmech::peers

#include "nlmech/peers/ivp/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <variant>

#include "nlmech/peers/ivp/gsl/gsl.hpp"
#include "nlmech/peers/ivp/odeint/odeint.hpp"
#include "nlmech/peers/ivp/sundials/arkode.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::peers {
namespace {

using Method = std::variant<Cvode, Arkode, Gsl, Odeint>;

struct Peer {
  std::string_view library;
  bool (*available)() noexcept;
  Family family;
  Method method;
  bool estimate_misses_time = false;
  [[nodiscard]] std::string_view name() const {
    return std::visit([](const auto& m) { return m.name(); }, method);
  }
};

const std::array<Peer, 13>& peers() {
  using C = Cvode::Formula;
  using A = Arkode::Formula;
  using G = Gsl::Formula;
  using O = Odeint::Formula;
  using F = Family;
  static const std::array<Peer, 13> all = {{
      {"CVODE", &cvode_available, F::adams, Cvode{.formula = C::adams}},
      {"CVODE", &cvode_available, F::implicit, Cvode{.formula = C::bdf}},
      {"ARKODE", &arkode_available, F::runge_kutta, Arkode{.formula = A::erk}},
      {"ARKODE", &arkode_available, F::implicit, Arkode{.formula = A::dirk}},
      {"GSL", &gsl_available, F::runge_kutta, Gsl{.formula = G::rkf45}},
      {"GSL", &gsl_available, F::runge_kutta, Gsl{.formula = G::rk8pd}},
      {"GSL", &gsl_available, F::implicit, Gsl{.formula = G::bsimp}},
      {"GSL", &gsl_available, F::adams, Gsl{.formula = G::msadams}},
      {"GSL", &gsl_available, F::implicit, Gsl{.formula = G::msbdf}},
      {"Odeint", &odeint_available, F::runge_kutta, Odeint{.formula = O::dopri5}},
      // Its estimate is 41/840 h (k1 + k11 - k12 - k13), and these stages lie at the times t, t + h, t, t + h
      // (E. Fehlberg, NASA TR R-287, 1968).
      {"Odeint", &odeint_available, F::runge_kutta, Odeint{.formula = O::fehlberg78}, true},
      {"Odeint", &odeint_available, F::extrapolation, Odeint{.formula = O::bulirsch_stoer}},
      {"Odeint", &odeint_available, F::implicit, Odeint{.formula = O::rosenbrock4}},
  }};
  return all;
}

const Peer& find(std::string_view name) {
  for (const Peer& peer : peers()) {
    if (peer.name() == name) return peer;
  }
  throw invalid_argument("there is no peer '{}'; there is {}", name, fmt::join(all_peer_names(), ", "));
}

}  // namespace

std::vector<std::string> all_peer_names() {
  std::vector<std::string> names;
  for (const Peer& peer : peers()) names.emplace_back(peer.name());
  return names;
}

std::vector<std::string> peer_names() {
  std::vector<std::string> names;
  for (const Peer& peer : peers()) {
    if (peer.available()) names.emplace_back(peer.name());
  }
  return names;
}

bool is_peer(std::string_view name) {
  return std::any_of(peers().begin(), peers().end(), [&](const Peer& peer) { return peer.name() == name; });
}

ivp::MethodInfo peer_info(std::string_view name) {
  const Peer& peer = find(name);
  return {.name = peer.name(),
          .meaning = peer.library,
          .steps = ivp::Steps::chosen,
          .estimate_misses_time = peer.estimate_misses_time};
}

bool peer_available(std::string_view name) { return find(name).available(); }

Family peer_family(std::string_view name) { return find(name).family; }

bool peer_is_implicit(std::string_view name) { return peer_family(name) == Family::implicit; }

std::string absent_peer_sentence(std::string_view name) {
  return fmt::format("{} is not in this build: configure with {} (NLMECH_PEERS)", name, find(name).library);
}

PeerIntegrator peer_integrator(std::string_view name, double relative, double absolute) {
  const Peer& peer = find(name);
  require_tolerances(name, {relative, absolute});
  if (!peer.available()) throw std::logic_error(absent_peer_sentence(name));
  return std::visit(
      [&](auto method) {
        method.relative_tolerance = relative;
        method.absolute_tolerance = absolute;
        return PeerIntegrator([method](const ivp::System& system, const ivp::State& x0, double t0, double t1,
                                       const ivp::Observer& observer, const ivp::Limits& limits) {
          return ivp::integrate(system, x0, t0, t1, method, observer, limits);
        });
      },
      peer.method);
}

}  // namespace nlmech::peers

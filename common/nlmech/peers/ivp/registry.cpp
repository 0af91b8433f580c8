#include "nlmech/peers/ivp/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/peers/ivp/gsl/gsl.hpp"
#include "nlmech/peers/ivp/odeint/odeint.hpp"
#include "nlmech/peers/ivp/sundials/arkode.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::peers {
namespace {

/// Registry entry of one formula of a library.
template <class Method, typename Method::Formula formula>
ivp::MethodInfo row(std::string_view library, ivp::Family family, bool (*is_built)() noexcept,
                    bool estimate_misses_time = false) {
  return {.name = Method{.formula = formula}.name(),
          .meaning = library,
          .family = family,
          .steps = ivp::Steps::adaptive,
          .make =
              [](const ivp::Settings& settings) {
                return ivp::named::by_tolerance(settings, Method{.formula = formula});
              },
          .estimate_misses_time = estimate_misses_time,
          .is_built = is_built};
}

std::array<ivp::MethodInfo, 13> rows() {
  using enum ivp::Family;
  using C = Cvode::Formula;
  using A = Arkode::Formula;
  using G = Gsl::Formula;
  using O = Odeint::Formula;
  return {row<Cvode, C::adams>("CVODE", adams, &cvode_available),
          row<Cvode, C::bdf>("CVODE", implicit, &cvode_available),
          row<Arkode, A::erk>("ARKODE", runge_kutta, &arkode_available),
          row<Arkode, A::dirk>("ARKODE", implicit, &arkode_available),
          row<Gsl, G::rkf45>("GSL", runge_kutta, &gsl_available),
          row<Gsl, G::rk8pd>("GSL", runge_kutta, &gsl_available),
          row<Gsl, G::bsimp>("GSL", implicit, &gsl_available),
          row<Gsl, G::msadams>("GSL", adams, &gsl_available),
          row<Gsl, G::msbdf>("GSL", implicit, &gsl_available),
          row<Odeint, O::dopri5>("Odeint", runge_kutta, &odeint_available),
          // Its estimate is 41/840 h (k1 + k11 - k12 - k13), and these stages lie at the times t, t + h, t, t
          // + h (E. Fehlberg, NASA TR R-287, 1968).
          row<Odeint, O::fehlberg78>("Odeint", runge_kutta, &odeint_available, true),
          row<Odeint, O::bulirsch_stoer>("Odeint", extrapolation, &odeint_available),
          row<Odeint, O::rosenbrock4>("Odeint", implicit, &odeint_available)};
}

}  // namespace

std::span<const ivp::MethodInfo> peer_methods() {
  static const auto all = rows();
  return all;
}

const ivp::MethodInfo& peer_info(std::string_view name) {
  for (const ivp::MethodInfo& peer : peer_methods()) {
    if (peer.name == name) return peer;
  }
  throw invalid_argument("there is no peer '{}'; choose one of {}", name, fmt::join(all_peer_names(), ", "));
}

std::vector<std::string> all_peer_names() {
  std::vector<std::string> names;
  for (const ivp::MethodInfo& peer : peer_methods()) names.emplace_back(peer.name);
  return names;
}

std::vector<std::string> peer_names() {
  std::vector<std::string> names = all_peer_names();
  std::erase_if(names, [](const std::string& name) { return !peer_info(name).is_available(); });
  return names;
}

ivp::NamedIntegrator peer_integrator(std::string_view name, double relative, double absolute) {
  return peer_info(name).with({.tolerance = relative, .absolute_tolerance = absolute});
}

}  // namespace nlmech::peers

#include "nlmech/comparison/any_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "nlmech/ivp/named/named_ensemble.hpp"
#include "nlmech/ivp/switching.hpp"
#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {

std::vector<std::string> any_method_names() {
  std::vector<std::string> names;
  for (const ivp::MethodInfo& info : ivp::named_methods()) names.emplace_back(info.name);
  for (const std::string& peer : peers::all_peer_names()) names.push_back(peer);
  return names;
}

std::vector<std::string> built_method_names() {
  std::vector<std::string> names;
  for (const ivp::MethodInfo& info : ivp::named_methods()) names.emplace_back(info.name);
  for (const std::string& peer : peers::peer_names()) names.push_back(peer);
  return names;
}

AnyMethod any_method(std::string_view name) {
  if (peers::is_peer(name)) return {std::string(name), true, peers::peer_info(name)};
  const auto names = any_method_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw invalid_argument("there is no method '{}'; there is {}", name, fmt::join(names, ", "));
  return {std::string(name), false, ivp::method_info(name)};
}

ivp::NamedIntegrator any_integrator(const AnyMethod& method, const ivp::Settings& settings) {
  if (!method.peer) return ivp::named_integrator(method.name, settings);
  if (!peers::peer_available(method.name))
    throw std::invalid_argument(peers::absent_peer_sentence(method.name));
  ivp::check_settings(method.info, settings);
  const double tolerance = settings.tolerance.value_or(ivp::default_tolerance);
  const ivp::NamedIntegrator smooth =
      peers::peer_integrator(method.name, tolerance, settings.absolute_tolerance.value_or(tolerance));
  return [smooth](const ivp::System& system, const ivp::State& x0, double t0, double t1,
                  const ivp::Observer& observer, const ivp::Limits& limits) {
    return system.switches() == 0 ? smooth(system, x0, t0, t1, observer, limits)
                                  : ivp::integrate_switching(system, x0, t0, t1, smooth, observer, limits);
  };
}

std::vector<ivp::Solution> integrate_all(const AnyMethod& method, const ivp::Settings& settings,
                                         std::span<const ivp::Start> starts, int threads) {
  if (!method.peer) return ivp::named_integrate_all(method.name, settings, starts, threads);
  return ivp::each_by(any_integrator(method, settings), starts, threads);
}

}  // namespace nlmech::comparison

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

ivp::Controlled controlled(const AnyMethod& method, const ivp::Settings& settings) {
  return method.peer ? ivp::Controlled::local_error
                     : ivp::controlled(ivp::method_info(method.name), settings);
}

AnyMethod any_method(std::string_view name) {
  if (peers::is_peer(name)) return {std::string(name), true, peers::peer_info(name)};
  const auto names = any_method_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw invalid_argument("there is no method '{}'; there is {}", name, fmt::join(names, ", "));
  return {std::string(name), false, ivp::method_info(name)};
}

template <int n>
ivp::NamedIntegrator<n> any_integrator(const AnyMethod& method, const ivp::Settings& settings) {
  if (!method.peer) return ivp::named_integrator<n>(method.name, settings);
  if (!peers::peer_available(method.name))
    throw std::invalid_argument(peers::absent_peer_sentence(method.name));
  ivp::check_settings(method.info, settings);
  const double tolerance = settings.tolerance.value_or(ivp::default_tolerance);
  const ivp::NamedIntegrator<n> smooth =
      peers::peer_integrator<n>(method.name, tolerance, settings.absolute_tolerance.value_or(tolerance));
  return [smooth](const ivp::System<n>& system, const ivp::State<n>& x0, double t0, double t1,
                  const ivp::Observer<n>& observer, const ivp::Limits& limits) {
    return system.switches() == 0 ? smooth(system, x0, t0, t1, observer, limits)
                                  : ivp::integrate_switching<n>(system, x0, t0, t1, smooth, observer, limits);
  };
}

template <int n>
std::vector<ivp::Solution<n>> integrate_all(const AnyMethod& method, const ivp::Settings& settings,
                                            std::span<const ivp::Start<n>> starts, int threads) {
  if (!method.peer) return ivp::named_integrate_all<n>(method.name, settings, starts, threads);
  return ivp::each_by<n>(any_integrator<n>(method, settings), starts, threads);
}

template ivp::NamedIntegrator<1> any_integrator<1>(const AnyMethod&, const ivp::Settings&);
template ivp::NamedIntegrator<2> any_integrator<2>(const AnyMethod&, const ivp::Settings&);
template ivp::NamedIntegrator<3> any_integrator<3>(const AnyMethod&, const ivp::Settings&);
template ivp::NamedIntegrator<4> any_integrator<4>(const AnyMethod&, const ivp::Settings&);
template ivp::NamedIntegrator<6> any_integrator<6>(const AnyMethod&, const ivp::Settings&);
template ivp::NamedIntegrator<Eigen::Dynamic> any_integrator<Eigen::Dynamic>(const AnyMethod&,
                                                                             const ivp::Settings&);

template std::vector<ivp::Solution<1>> integrate_all<1>(const AnyMethod&, const ivp::Settings&,
                                                        std::span<const ivp::Start<1>>, int);
template std::vector<ivp::Solution<2>> integrate_all<2>(const AnyMethod&, const ivp::Settings&,
                                                        std::span<const ivp::Start<2>>, int);
template std::vector<ivp::Solution<3>> integrate_all<3>(const AnyMethod&, const ivp::Settings&,
                                                        std::span<const ivp::Start<3>>, int);
template std::vector<ivp::Solution<4>> integrate_all<4>(const AnyMethod&, const ivp::Settings&,
                                                        std::span<const ivp::Start<4>>, int);
template std::vector<ivp::Solution<6>> integrate_all<6>(const AnyMethod&, const ivp::Settings&,
                                                        std::span<const ivp::Start<6>>, int);
template std::vector<ivp::Solution<Eigen::Dynamic>> integrate_all<Eigen::Dynamic>(
    const AnyMethod&, const ivp::Settings&, std::span<const ivp::Start<Eigen::Dynamic>>, int);

}  // namespace nlmech::comparison

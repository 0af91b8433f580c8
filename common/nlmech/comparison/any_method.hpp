/// @file
/// Our methods and the peers by name, side by side.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/ivp/ensemble/start.hpp"
#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::comparison {

/// A method of ours or a peer.
struct AnyMethod {
  std::string name;      ///< "rbf-coll", "cvode-bdf"
  bool peer = false;     ///< another author's: it chooses its steps, and has no settings of its own
  ivp::MethodInfo info;  ///< steps and settings
};

/// @throws std::invalid_argument listing all methods and peers, if there is none of that name
[[nodiscard]] AnyMethod any_method(std::string_view name);

/// Names of ours, then of the peers, built or not.
[[nodiscard]] std::vector<std::string> any_method_names();

/// Names of ours, then of the peers that this build has.
[[nodiscard]] std::vector<std::string> built_method_names();

/// Ready to run. Settings of @p settings that the method does not have are refused.
/// @throws std::invalid_argument for settings that cannot be meant, and for a peer that this build lacks
[[nodiscard]] ivp::NamedIntegrator any_integrator(const AnyMethod& method, const ivp::Settings& settings);

/// Many trajectories by it, each as by any_integrator(); see ivp::named_integrate_all().
[[nodiscard]] std::vector<ivp::Solution> integrate_all(const AnyMethod& method, const ivp::Settings& settings,
                                                       std::span<const ivp::Start> starts, int threads);

}  // namespace nlmech::comparison

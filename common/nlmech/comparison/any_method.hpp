/// @file
/// Registry of all methods: those of nlmech and the peers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::comparison {

/// The nlmech method or peer of that name, also a peer that this build lacks.
/// @throws std::invalid_argument listing all methods and peers for an unknown name
[[nodiscard]] const ivp::MethodInfo& any_method(std::string_view name);

/// Names of the nlmech methods, then of all peers, also those that this build lacks.
[[nodiscard]] std::vector<std::string> any_method_names();

/// Names of the nlmech methods, then of the peers in this build.
[[nodiscard]] std::vector<std::string> built_method_names();

}  // namespace nlmech::comparison

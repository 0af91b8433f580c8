/// @file
/// One registry of our methods and of peers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::comparison {

/// The method of that name, ours or a peer, in this build or not.
/// @throws std::invalid_argument listing all methods and peers, if there is none
[[nodiscard]] const ivp::MethodInfo& any_method(std::string_view name);

/// Names of ours, then of the peers, built or not.
[[nodiscard]] std::vector<std::string> any_method_names();

/// Names of ours, then of the peers that this build has.
[[nodiscard]] std::vector<std::string> built_method_names();

}  // namespace nlmech::comparison

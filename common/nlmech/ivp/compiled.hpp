/// @file
/// Definition of the library's instances, for the sources that CMakeLists.txt makes of them.
#pragma once

#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp::detail {

template <int n, class Method>
Solution<n> Instance<n, Method>::run(const Task<System<n>>& task, const Method& method) {
  return Integrator<System<n>, Method>::run(task, method);
}

}  // namespace nlmech::ivp::detail

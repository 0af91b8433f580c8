/// @file
/// Compiles the System of a problem that says `compiled_once`: included by the one source that does.
#pragma once

#include <memory>
#include <utility>

#include "nlmech/ivp/system.hpp"

/// @cond
namespace nlmech::ivp::detail {

template <int n, class Problem>
std::shared_ptr<const Face<n>> compiled_face(Problem problem) {
  return std::make_shared<const Compiled<n, Direct<Problem, n>>>(Direct<Problem, n>(std::move(problem)));
}

/// `template struct InSystem<Duffing>;` compiles it.
template <class Problem>
struct InSystem {
  static constexpr int n = compiled_dimension<Problem>;
  static constexpr auto face = &compiled_face<n, Problem>;
};

}  // namespace nlmech::ivp::detail
/// @endcond

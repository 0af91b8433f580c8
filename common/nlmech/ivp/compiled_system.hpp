/// @file
/// Compiles the System of a problem that says `compiled_once`: included by the one source that does.
#pragma once

#include <memory>
#include <utility>

#include "nlmech/ivp/system.hpp"

/// @cond
namespace nlmech::ivp::detail {

template <class Problem>
std::shared_ptr<const Face> compiled_face(Problem problem) {
  return std::make_shared<const Compiled<Direct<Problem, Eigen::Dynamic>>>(
      Direct<Problem, Eigen::Dynamic>(std::move(problem)));
}

/// `template struct InSystem<Duffing>;` compiles it.
template <class Problem>
struct InSystem {
  static constexpr auto face = &compiled_face<Problem>;
};

}  // namespace nlmech::ivp::detail
/// @endcond

/// @file
/// How a problem multiplies errors between t0 and t1, found by cheap runs.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::comparison {

/// A problem for which a method is to be chosen.
struct ChoiceRequest {
  ivp::System system;                                             ///< equations
  ivp::State x0;                                                  ///< state at t0
  double t0;                                                      ///< start
  double t1;                                                      ///< end
  double absolute = 1;                                            ///< absolute over relative tolerance
  std::vector<std::string> methods = {};                          ///< that may be chosen; empty: all
  double largest_step = std::numeric_limits<double>::infinity();  ///< bound on the steps

  /// Limits of a short run. @param steps with one component; fewer with more, at least 50
  [[nodiscard]] ivp::Limits limits(std::int64_t steps) const;
};

/// What a problem makes of errors.
struct Growth {
  double factor = 1;   ///< from one tolerance, absolute + relative, to the error by the size of a component
  double covered = 0;  ///< the share of the interval that it was found on, from 0 to 1; 0: it is not known
};

/// The greatest factor from six times to the last of them, by amplification() along a run; not known with
/// more than 64 components.
/// @param method by which it runs
[[nodiscard]] Growth growth_along(const ChoiceRequest& request, const std::string& method);

}  // namespace nlmech::comparison

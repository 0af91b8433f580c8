/// @file
/// Limits of steps and wall time.
#pragma once

#include <cmath>
#include <string_view>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/solution.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {

/// `step_limit` or `time_limit` at time @p t if @p done or @p watch has reached it; otherwise success.
[[nodiscard]] inline Status check_limits(std::string_view method, double t, const Statistics& done,
                                         const Limits& limits, const Stopwatch& watch) {
  if (done.steps + done.rejected >= limits.steps) return step_limit(method, t, limits.steps);
  if (std::isfinite(limits.seconds) && watch.seconds() > limits.seconds)
    return time_limit(method, t, limits.seconds);
  return {};
}

}  // namespace nlmech::ivp

/// @file
/// One of many trajectories: equations, initial state, end.
#pragma once

#include <algorithm>
#include <chrono>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// What integrate() takes for one trajectory.
struct Start {
  const System* system;  ///< outlives the integration; may be the same for many
  State x0;              ///< initial state
  double t0;             ///< begin
  double t1;             ///< end
  Observer observer;     ///< may be empty; called by the thread that has the trajectory
  Limits limits;         ///< bounds on its work, from its begin
  /// When all trajectories are to be over: one that begins late has less time, or none.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();

  /// The bounds on it if it begins now.
  [[nodiscard]] Limits limits_from_now() const {
    using std::chrono::steady_clock;
    Limits now = limits;
    if (deadline != steady_clock::time_point::max()) {
      const std::chrono::duration<double> left = deadline - steady_clock::now();
      now.seconds = std::min(now.seconds, std::max(0.0, left.count()));
    }
    return now;
  }
};

}  // namespace nlmech::ivp

/// @file
/// One of many trajectories: equations, initial state, end.
#pragma once

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// What integrate() takes for one trajectory.
template <int n>
struct Start {
  const System<n>* system;  ///< outlives the integration; may be the same for many
  State<n> x0;              ///< initial state
  double t0;                ///< begin
  double t1;                ///< end
  Observer<n> observer;     ///< may be empty; called by the thread that has the trajectory
  Limits limits;            ///< bounds on its work
};

}  // namespace nlmech::ivp

/// @file
/// What an integration of n components gives back, and what an observer sees of it on the way.
#pragma once

#include "nlmech/ivp/state.hpp"
#include "nlmech/support/solution.hpp"

namespace nlmech::ivp {

/// The end of an integration.
template <int n>
using Solution = BasicSolution<State<n>>;
/// The solution within one step.
template <int n>
using DenseOutput = BasicDenseOutput<State<n>>;
/// One accepted step; states are columns.
template <int n>
using Step = BasicStep<State<n>, Nodes<n>>;
/// Called after each accepted step.
template <int n>
using Observer = BasicObserver<Step<n>>;
using nlmech::Limits;  ///< bounds on the work

}  // namespace nlmech::ivp

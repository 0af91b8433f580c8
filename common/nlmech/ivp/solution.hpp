/// @file
/// Result of an integration, and the steps that an observer receives.
#pragma once

#include "nlmech/ivp/state.hpp"
#include "nlmech/support/solution.hpp"

namespace nlmech::ivp {

/// Result of an integration: final time and state, status, statistics.
using Solution = BasicSolution<State>;
/// The solution within one step.
using DenseOutput = BasicDenseOutput<State>;
/// One accepted step; states are columns.
using Step = BasicStep<State, Nodes>;
/// Called after each accepted step.
using Observer = BasicObserver<Step>;
using nlmech::Limits;  ///< limits of steps, wall time and step size

/// The same for a system @p S with states of its own type: System, or Direct with vectors of fixed size.
/// @{
template <class S>
using SolutionOf = BasicSolution<typename S::State>;
template <class S>
using DenseOutputOf = BasicDenseOutput<typename S::State>;
template <class S>
using StepOf = BasicStep<typename S::State, typename S::Nodes>;
template <class S>
using ObserverOf = BasicObserver<StepOf<S>>;
/// @}

}  // namespace nlmech::ivp

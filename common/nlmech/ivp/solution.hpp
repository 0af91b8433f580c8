/// @file
/// What an integration gives back, and what an observer sees of it on the way.
#pragma once

#include "nlmech/ivp/state.hpp"
#include "nlmech/support/solution.hpp"

namespace nlmech::ivp {

/// The end of an integration.
using Solution = BasicSolution<State>;
/// The solution within one step.
using DenseOutput = BasicDenseOutput<State>;
/// One accepted step; states are columns.
using Step = BasicStep<State, Nodes>;
/// Called after each accepted step.
using Observer = BasicObserver<Step>;
using nlmech::Limits;  ///< bounds on the work

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

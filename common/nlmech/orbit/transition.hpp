/// @file
/// State-transition matrices by Taylor series, for a point mass and zonal harmonics.
#pragma once

#include <functional>
#include <span>

#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/kepler.hpp"

namespace nlmech::orbit {

/// Result of propagate_transition().
struct TransitionSolution {
  Solution end;  ///< as of propagate(), with the same bits
  TransitionMatrix transition =
      TransitionMatrix::Identity();  ///< d(state at end.t)/d(initial state), also after a failure
};

/// Called with a time, the state there and d(that state)/d(initial state); false stops with `interrupted`.
using TransitionSink = std::function<bool(double t, const State& x, const TransitionMatrix& transition)>;

/// propagate() with the state-transition matrix, by Taylor series of the variational equation dr'' = A dr
/// with the gradient A of the acceleration: each step is multiplied by the matrix of the next one, whose
/// series is summed until its terms are below `method.tolerance`. Tests check relative errors of at most
/// n (tolerance + 4 eps) kappa against differences in 34 digits, for n steps and the condition number kappa
/// of the orbit.
/// @param times of further results for @p sink, from t0 to t1 in the direction of integration
/// @throws std::invalid_argument as propagate()
[[nodiscard]] TransitionSolution propagate_transition(
    const State& start, double t0, double t1, const Gravity& gravity, const AnalyticContinuation& method = {},
    std::span<const double> times = {}, const TransitionSink& sink = {}, const Limits& limits = {});

}  // namespace nlmech::orbit

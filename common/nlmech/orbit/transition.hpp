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
  Solution end;                                                ///< as of propagate(), with the same bits
  TransitionMatrix transition = TransitionMatrix::Identity();  ///< d(state at end.t)/d(initial state)
};

/// Called with a time, the state there and d(that state)/d(initial state); false stops with `interrupted`.
using TransitionSink = std::function<bool(double t, const State& x, const TransitionMatrix& transition)>;

/// propagate() with the state-transition matrix: in a zonal field by Taylor series of the variational
/// equation dr'' = A dr with the gradient A of the acceleration, which each step sums until the terms are
/// below `method.tolerance`, and multiplies by the matrix before it; about a point mass by
/// kepler_transition(). Tests check relative errors of 4 (n + 4) eps kappa after n steps, with the condition
/// number kappa of the orbit, and compare with differences in 34 digits. After a failure about a point mass
/// the matrix is 1.
/// @param times of further results for @p sink, from t0 to t1 in the direction of integration
/// @throws std::invalid_argument as propagate()
[[nodiscard]] TransitionSolution propagate_transition(
    const State& start, double t0, double t1, const Gravity& gravity, const AnalyticContinuation& method = {},
    std::span<const double> times = {}, const TransitionSink& sink = {}, const Limits& limits = {});

}  // namespace nlmech::orbit

/// @file
/// Values of an event function at and near its zero, for the boundary of the domain of equations.
#pragma once

#include "nlmech/ivp/events.hpp"

namespace nlmech::ivp {

/// @p bounds at a point for states with errors up to error.absolute + error.relative |x_i|.
[[nodiscard]] program::Interval at_point(const BoundsOver& bounds, double t, const State& x,
                                         StateAccuracy error);

/// dg/dt; zero where its bounds include zero.
[[nodiscard]] double rate_at(const Event& g, double t, const State& x);

/// The state nearest to @p x at which g is @p value, or less by rounding: at most 8 steps along the gradient.
[[nodiscard]] State moved_to(const Event& g, double t, State x, double value);

/// Do the equations lead away from the zero of an argument at @p x, with a rate per distance that grows
/// towards it? @param near distance of g from zero, on the side of its sign
[[nodiscard]] bool repels(const Event& g, double t, const State& x, double near, int direction);

/// May a solution stay at the zero of the argument of max or abs under a root at @p x, or leave it?
[[nodiscard]] bool stays_or_leaves(const Event& g, double t, const State& x, double near, int direction);

}  // namespace nlmech::ivp

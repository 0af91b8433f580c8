/// @file
/// Adapters: propagators of the component orbit as ivp::NamedIntegrator, for comparisons.
#pragma once

#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/orbit/continuation.hpp"

namespace nlmech::chapters::two_body_series {

/// Analytic continuation about a point mass @p mu; ignores the system passed to it.
/// Statistics::right_hand_sides counts orders, as for the method `series`.
[[nodiscard]] ivp::NamedIntegrator continuation_integrator(const orbit::AnalyticContinuation& method,
                                                           double mu);
/// Analytic continuation with fixed order and step size.
[[nodiscard]] ivp::NamedIntegrator continuation_integrator(const orbit::FixedContinuation& method, double mu);

/// Kepler's solution at the final time; iterations count as right-hand sides. An observer receives 16
/// equidistant times in the last tenth of the interval, each solved from the start.
[[nodiscard]] ivp::NamedIntegrator kepler_integrator(double mu);

/// Position and velocity as one vector.
[[nodiscard]] ivp::State joined(const orbit::State& s);
/// Inverse of joined().
[[nodiscard]] orbit::State parted(const ivp::State& x);

}  // namespace nlmech::chapters::two_body_series

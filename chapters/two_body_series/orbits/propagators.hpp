/// @file
/// The propagators of the component orbit in the shape of integrators in general, to stand beside them.
#pragma once

#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/orbit/continuation.hpp"

namespace nlmech::chapters::two_body_series {

/// Analytic continuation about a point mass @p mu; of the system that it is given it takes nothing.
/// Statistics::right_hand_sides counts orders, as for the method `series`.
[[nodiscard]] ivp::NamedIntegrator continuation_integrator(const orbit::AnalyticContinuation& method,
                                                           double mu);
/// The same with fixed order and step.
[[nodiscard]] ivp::NamedIntegrator continuation_integrator(const orbit::FixedContinuation& method, double mu);

/// Kepler's equation, solved once; its evaluations count as right-hand sides. An observer sees 16 equidistant
/// times in the last tenth of the way, each solved from the start.
[[nodiscard]] ivp::NamedIntegrator kepler_integrator(double mu);

/// (r, v) as one vector.
[[nodiscard]] ivp::State joined(const orbit::State& s);
/// The other way.
[[nodiscard]] orbit::State parted(const ivp::State& x);

}  // namespace nlmech::chapters::two_body_series

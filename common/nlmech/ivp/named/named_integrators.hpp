/// @file
/// Construction of the methods of named_integrator(), with fixed and with adaptive steps.
#pragma once

#include <utility>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/series/series.hpp"

namespace nlmech::ivp::named {

/// The integrator of a method with all its options.
template <class Method>
[[nodiscard]] NamedIntegrator with_options(const Method& method) {
  return [method](const System& system, const State& x0, double t0, double t1, const Observer& observer,
                  const Limits& limits) { return integrate(system, x0, t0, t1, method, observer, limits); };
}

/// Sets the tolerances of a method with adaptive steps; its other options are those of @p method.
template <class Method>
[[nodiscard]] Method with_tolerances_of(const Settings& settings, Method method) {
  method.relative_tolerance = settings.tolerance.value_or(default_tolerance);
  method.absolute_tolerance = settings.absolute_tolerance.value_or(method.relative_tolerance);
  if constexpr (requires { check_options(method); }) check_options(method);  // peers check their own options
  return method;
}
/// The integrator of a method with adaptive steps and the tolerances of @p settings.
template <class Method>
NamedIntegrator by_tolerance(const Settings& settings, Method method = {}) {
  return with_options(with_tolerances_of(settings, std::move(method)));
}

/// The method `series` with the settings.
[[nodiscard]] inline Series series_of(const Settings& settings) {
  const int order = settings.order.value_or(settings.step ? published_order : 0);
  return with_tolerances_of(settings, Series{.order = order, .step = settings.step.value_or(0)});
}

}  // namespace nlmech::ivp::named

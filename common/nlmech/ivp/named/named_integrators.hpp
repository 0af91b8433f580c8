/// @file
/// How named_integrator() makes its methods: those of fixed step, with a step or in search of one, and those
/// that choose their steps.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/named/step_search.hpp"
#include "nlmech/ivp/series/series.hpp"

namespace nlmech::ivp::named {

/// Relative error of the rate at which a method of fixed step moves along x' = const, for a step; empty if
/// there is none.
using RateError = std::function<double(double step)>;

/// A method of fixed step for a step.
using OfStep = std::function<NamedIntegrator(double step)>;

/// A method with all its options.
template <class Method>
[[nodiscard]] NamedIntegrator with_options(const Method& method) {
  return [method](const System& system, const State& x0, double t0, double t1, const Observer& observer,
                  const Limits& limits) { return integrate(system, x0, t0, t1, method, observer, limits); };
}

/// A method of fixed step in search of its step.
/// @param rate of the method; may be empty
/// @param rate_is_fixed the same for every step
[[nodiscard]] NamedIntegrator searching(const StepSearch& search, const OfStep& make, const RateError& rate,
                                        bool rate_is_fixed);

/// A method of fixed step. @param make the aggregate for a step
template <class Make>
NamedIntegrator fixed_step(const MethodInfo& info, const Settings& settings, std::optional<int> order,
                           Make make, const RateError& rate = {}) {
  const OfStep of_step = [make](double step) -> NamedIntegrator { return with_options(make(step)); };
  if (settings.step) return of_step(*settings.step);
  StepSearch search{std::string(info.name), order, settings.tolerance.value_or(default_tolerance)};
  // The step of a collocation costs as many steps of another method as there are unknowns in its matrix.
  if (info.has(nodes_setting))
    search.most_steps /= std::int64_t{1} * settings.nodes.value_or(7) * settings.nodes.value_or(7);
  return searching(search, of_step, rate, rate && !settings.shape);
}

/// A method that chooses its steps, with the tolerances set; @p method has all else.
template <class Method>
[[nodiscard]] Method with_tolerances_of(const Settings& settings, Method method) {
  method.relative_tolerance = settings.tolerance.value_or(default_tolerance);
  method.absolute_tolerance = settings.absolute_tolerance.value_or(method.relative_tolerance);
  check_options(method);
  return method;
}
/// The same, ready to run.
template <class Method>
NamedIntegrator by_tolerance(const Settings& settings, Method method = {}) {
  return with_options(with_tolerances_of(settings, std::move(method)));
}

/// Taylor series.
[[nodiscard]] inline Series series_of(const Settings& settings) {
  const int order = settings.order.value_or(settings.step ? published_order : 0);
  return with_tolerances_of(settings, Series{.order = order, .step = settings.step.value_or(0)});
}

}  // namespace nlmech::ivp::named

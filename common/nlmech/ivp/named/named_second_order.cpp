#include <fmt/format.h>

#include <stdexcept>

#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/ivp/structural/central_difference.hpp"
#include "nlmech/ivp/structural/generalized_alpha.hpp"
#include "nlmech/ivp/structural/hht.hpp"
#include "nlmech/ivp/structural/newmark.hpp"

namespace nlmech::ivp::named {
namespace {

/// Hermitian operators, which have an estimate of their error: with a tolerance they choose their steps.
template <int n>
NamedIntegrator<n> by_operators(const HermitianPair& pair, const Settings& settings) {
  if (!settings.step) return by_tolerance<n>(settings, Hermitian{.operators = pair});
  const Hermitian method{.operators = pair, .step = *settings.step};
  return with_options<n>(method);
}

template <int n>
NamedIntegrator<n> nystroem(const Settings& settings) {
  const double tolerance = settings.tolerance.value_or(default_tolerance);
  const Rkn1210 method{.relative_tolerance = tolerance,
                       .absolute_tolerance = settings.absolute_tolerance.value_or(tolerance)};
  check_options(method);
  return with_options<n>(method);
}

}  // namespace

template <int n>
NamedIntegrator<n> for_accelerations(const MethodInfo& info, const Settings& settings) {
  if constexpr (has_halves<n>) {
    const auto with = [&](auto make) { return fixed_step<n>(info, settings, info.order, make); };
    if (info.name == Rkn1210::name) return nystroem<n>(settings);
    if (info.name == CentralDifference::name)
      return with([](double step) { return CentralDifference{.step = step}; });
    if (info.name == Newmark::name) return with([](double step) { return Newmark{.step = step}; });
    if (info.name == Hht::name) return with([](double step) { return Hht{.step = step}; });
    if (info.name == GeneralizedAlpha::name)
      return with([](double step) { return GeneralizedAlpha{.step = step}; });
    for (const HermitianPair& pair : {laier, argyris, hoff, bazzi}) {
      if (info.name == pair.name) return by_operators<n>(pair, settings);
    }
  } else if (info.second_order_only) {
    throw std::invalid_argument(fmt::format(
        "{}: it needs positions and as many velocities; a state of {} components has none", info.name, n));
  }
  return {};
}

template NamedIntegrator<1> for_accelerations(const MethodInfo&, const Settings&);
template NamedIntegrator<2> for_accelerations(const MethodInfo&, const Settings&);
template NamedIntegrator<3> for_accelerations(const MethodInfo&, const Settings&);
template NamedIntegrator<4> for_accelerations(const MethodInfo&, const Settings&);
template NamedIntegrator<6> for_accelerations(const MethodInfo&, const Settings&);
template NamedIntegrator<Eigen::Dynamic> for_accelerations(const MethodInfo&, const Settings&);

}  // namespace nlmech::ivp::named

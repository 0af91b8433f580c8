#include "nlmech/ivp/named/named_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/implicit/backward_euler.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/ivp/runge_kutta/dop853.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/ivp/structural/alpha_family.hpp"
#include "nlmech/ivp/structural/central_difference.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::ivp {
namespace {

using named::by_tolerance;
using named::with_options;

constexpr MethodInfo for_accelerations(MethodInfo method) {
  method.second_order_only = true;
  return method;
}

/// Makes a method with a step size and no other setting.
template <class Method>
constexpr auto with_step =
    [](const Settings& settings) { return with_options(Method{.step = *settings.step}); };

/// Makes a method with tolerances and no other setting.
template <class Method>
constexpr auto with_tolerances = [](const Settings& settings) { return by_tolerance<Method>(settings); };

/// Makes a method of Hermitian operators: fixed steps with a step size, adaptive steps with a tolerance.
template <const HermitianPair& pair>
constexpr auto with_operators = [](const Settings& settings) {
  if (!settings.step) return by_tolerance(settings, Hermitian{.operators = pair});
  return with_options(Hermitian{.operators = pair, .step = *settings.step});
};

constexpr auto taylor_series = [](const Settings& settings) {
  return with_options(named::series_of(settings));
};

constexpr auto transversal = [](const Settings& settings) {
  return with_options(Mtl{.step = *settings.step, .points = settings.points.value_or(Mtl{}.points)});
};

constexpr auto picard = [](const Settings& settings) {
  const int order = settings.nodes ? *settings.nodes - 1 : Mcpi{}.order;
  return with_options(Mcpi{.step = *settings.step, .order = order});
};

template <collocation::NodeFamily points>
constexpr auto by_polynomials = [](const Settings& settings) {
  const int nodes = settings.nodes.value_or(PolynomialCollocation{}.nodes);
  return with_options(PolynomialCollocation{.step = *settings.step, .nodes = nodes, .points = points});
};

constexpr auto gaussians = [](const Settings& settings) {
  return with_options(RbfCollocation{.step = *settings.step,
                                     .nodes = settings.nodes.value_or(RbfCollocation{}.nodes),
                                     .shape = settings.shape.value_or(0)});
};

constexpr auto adaptive_collocation = [](const Settings& settings) {
  return by_tolerance<AdaptiveCollocation>(
      settings, {.nodes = settings.nodes.value_or(0), .shape = settings.shape.value_or(0)});
};

using enum Steps;
using enum Family;
using collocation::NodeFamily;
constexpr std::array<const SettingInfo*, 2> nodes_only = {&nodes_setting},
                                            nodes_and_shape = {&nodes_setting, &shape_setting};
static_assert(nodes_setting.most == collocation::max_nodes);

constexpr std::array methods = {
    MethodInfo{Euler::name, "forward Euler", classical, fixed, with_step<Euler>},
    MethodInfo{BackwardEuler::name, "backward Euler", classical, fixed, with_step<BackwardEuler>},
    for_accelerations(
        {CentralDifference::name, "central differences", classical, fixed, with_step<CentralDifference>}),
    MethodInfo{Rk4::name, "the classical Runge-Kutta method", classical, fixed, with_step<Rk4>},
    MethodInfo{Rk6::name, "Butcher's Runge-Kutta method of 7 stages", classical, fixed, with_step<Rk6>},
    MethodInfo{Ode45::name, "Dormand and Prince's pair, controlled as MATLAB does", runge_kutta, adaptive,
               with_tolerances<Ode45>},
    MethodInfo{Dop853::name,
               "Dormand and Prince's method of order 8, controlled by estimates of orders 5 and 3",
               runge_kutta, adaptive, with_tolerances<Dop853>},
    for_accelerations({Rkn1210::name,
                       "Dormand, El-Mikkawy and Prince's pair for accelerations without velocities",
                       runge_kutta, adaptive, with_tolerances<Rkn1210>}),
    MethodInfo{Series::name,
               "Taylor series, order and steps by the radius of convergence",
               Family::series,
               both,
               taylor_series,
               {&order_setting}},
    for_accelerations({Newmark::name, "Newmark's method, constant average acceleration", classical, fixed,
                       with_step<Newmark>}),
    for_accelerations(
        {Hht::name, "Hilber, Hughes and Taylor's method, alpha = -0.1", classical, fixed, with_step<Hht>}),
    for_accelerations({GeneralizedAlpha::name, "the generalised alpha method, rho = 0.8", classical, fixed,
                       with_step<GeneralizedAlpha>}),
    for_accelerations(
        {laier.name, "Laier's Hermitian operators, with jerks", classical, both, with_operators<laier>}),
    for_accelerations({argyris.name, "Argyris and Mlejnek's Hermitian operators, stable in part", classical,
                       both, with_operators<argyris>}),
    for_accelerations({hoff.name, "Hoff and Pahl's operators without dissipation: newmark", classical, both,
                       with_operators<hoff>}),
    for_accelerations({bazzi.name, "Bazzi and Anderheggen's operators without dissipation: newmark",
                       classical, both, with_operators<bazzi>}),
    MethodInfo{Mtl::name,
               "multi-step transversal linearisation over p = 3 steps: order p + 1 (odd p) or p + 2",
               classical,
               fixed,
               transversal,
               {&points_setting}},
    MethodInfo{Mcpi::name, "modified Chebyshev-Picard iteration, 9 nodes", polynomials, fixed, picard,
               nodes_only},
    MethodInfo{RbfCollocation::name, "collocation by Gaussians at 7 Legendre-Gauss-Lobatto nodes",
               polynomials, fixed, gaussians, nodes_and_shape},
    MethodInfo{PolynomialCollocation::lobatto_name,
               "collocation by polynomials at 7 Legendre-Gauss-Lobatto nodes: order N - 1", polynomials,
               fixed, by_polynomials<NodeFamily::legendre_gauss_lobatto>, nodes_only},
    MethodInfo{PolynomialCollocation::radau_name,
               "collocation by polynomials at the left end and 6 Radau nodes: order 2 N - 3", polynomials,
               fixed, by_polynomials<NodeFamily::left_end_and_radau>, nodes_only},
    MethodInfo{AdaptiveCollocation::name,
               "collocation at Radau nodes with control of steps, order (nodes 9, 13 or 17) and solver",
               Family::collocation, adaptive, adaptive_collocation, nodes_and_shape}};

void check_positive(std::string_view name, std::string_view what, const std::optional<double>& value) {
  if (value && (!(*value > 0) || !std::isfinite(*value)))
    throw invalid_argument("{}: the {} must be positive and finite, not {}", name, what, *value);
}

/// @throws std::invalid_argument for settings that the method does not have or that are out of range, with
/// their names
void check_settings(const MethodInfo& method, const Settings& settings) {
  const auto refuse = [&](std::string_view why) { throw invalid_argument("{}: {}", method.name, why); };
  check_positive(method.name, "step", settings.step);
  check_positive(method.name, "tolerance", settings.tolerance);
  check_positive(method.name, "absolute tolerance", settings.absolute_tolerance);
  if (settings.step && settings.tolerance) refuse("give a step or a tolerance, not both");
  if (settings.step && method.steps == Steps::adaptive)
    refuse("its steps are adaptive; give a tolerance, not a step");
  if (settings.absolute_tolerance && (method.fixed_step() || settings.step))
    refuse("an absolute tolerance needs a method with adaptive steps");
  for (const SettingInfo* setting : own_settings) {
    const std::optional<double> value = setting->value(settings);
    if (!value) continue;
    if (!method.has(*setting)) refuse(fmt::format("it has no setting {}", setting->name));
    if (setting->most == 0)
      check_positive(method.name, setting->name, value);
    else if (!(*value >= setting->least && *value <= setting->most))
      refuse(fmt::format("the {} must be from {} to {}, not {}", setting->name, setting->least, setting->most,
                         *value));
  }
  if (method.fixed_step() && !settings.step)
    refuse("it takes equal steps: give a step, or a method with adaptive steps, as series or dop853");
}

}  // namespace

std::string MethodInfo::absent_sentence() const {
  return fmt::format("{} is not in this build: configure with {} (NLMECH_PEERS)", name, meaning);
}

NamedIntegrator MethodInfo::with(const Settings& chosen) const {
  if (!is_available()) throw std::invalid_argument(absent_sentence());
  check_settings(*this, chosen);
  return make(chosen);
}

std::span<const MethodInfo> named_methods() { return methods; }

const MethodInfo& method_info(std::string_view name) {
  const auto* const found =
      std::find_if(methods.begin(), methods.end(), [name](const MethodInfo& m) { return m.name == name; });
  if (found != methods.end()) return *found;
  std::vector<std::string_view> known;
  for (const MethodInfo& m : methods) known.push_back(m.name);
  throw invalid_argument("there is no method '{}'; choose one of {}", name, fmt::join(known, ", "));
}

NamedIntegrator named_integrator(std::string_view name, const Settings& settings) {
  return method_info(name).with(settings);
}

}  // namespace nlmech::ivp

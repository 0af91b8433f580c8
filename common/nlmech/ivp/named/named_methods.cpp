#include "nlmech/ivp/named/named_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/collocation/matrix.hpp"
#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/collocation/collocation.hpp"
#include "nlmech/ivp/collocation/picard.hpp"
#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/ivp/implicit/backward_euler.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/ivp/structural/central_difference.hpp"
#include "nlmech/ivp/structural/generalized_alpha.hpp"
#include "nlmech/ivp/structural/hht.hpp"
#include "nlmech/ivp/structural/newmark.hpp"
#include "nlmech/ivp/transversal/mtl.hpp"

namespace nlmech::ivp {
namespace {

/// A row of Hermitian operators: steps by an estimate of their error, or as given.
constexpr MethodInfo hermitian_info(const HermitianPair& pair, int order, std::string_view meaning) {
  MethodInfo info{pair.name, false, order, meaning, true, false, false};
  info.takes_step = true;
  return info;
}

// name, fixed step, order, meaning, for accelerations, nodes, shape
constexpr std::array methods = {
    MethodInfo{Euler::name, true, 1, "forward Euler", false, false, false},
    MethodInfo{BackwardEuler::name, true, 1, "backward Euler", false, false, false},
    MethodInfo{CentralDifference::name, true, 2, "central differences", true, false, false},
    MethodInfo{Rk4::name, true, 4, "the classical Runge-Kutta method", false, false, false},
    MethodInfo{Rk6::name, true, 6, "Butcher's Runge-Kutta method of 7 stages", false, false, false},
    MethodInfo{Ode45::name, false, 5, "Dormand and Prince's pair, controlled as MATLAB does", false, false,
               false},
    MethodInfo{Rkn1210::name, false, 12,
               "Dormand, El-Mikkawy and Prince's pair for accelerations without velocities", true, false,
               false},
    MethodInfo{Series::name,
               false,
               {},
               "Taylor series, order and steps by the radius of convergence",
               false,
               false,
               false,
               true},
    MethodInfo{Newmark::name, true, 2, "Newmark's method, constant average acceleration", true, false, false},
    MethodInfo{Hht::name, true, 2, "Hilber, Hughes and Taylor's method, alpha = -0.1", true, false, false},
    MethodInfo{GeneralizedAlpha::name, true, 2, "the generalised alpha method, rho = 0.8", true, false,
               false},
    hermitian_info(laier, 4, "Laier's Hermitian operators, with jerks"),
    hermitian_info(argyris, 4, "Argyris and Mlejnek's Hermitian operators, stable in part"),
    hermitian_info(hoff, 2, "Hoff and Pahl's operators without dissipation: newmark"),
    hermitian_info(bazzi, 2, "Bazzi and Anderheggen's operators without dissipation: newmark"),
    MethodInfo{Mtl::name,
               true,
               {},
               "multi-step transversal linearisation over p = 3 steps: order p + 1 (odd p) or p + 2",
               false,
               false,
               false,
               false,
               true},
    MethodInfo{Mcpi::name, true, {}, "modified Chebyshev-Picard iteration, 9 nodes", false, true, false},
    MethodInfo{RbfCollocation::name,
               true,
               {},
               "collocation by Gaussians at 7 Legendre-Gauss-Lobatto nodes",
               false,
               true,
               true},
    MethodInfo{named::lgl_name,
               true,
               {},
               "collocation by polynomials at 7 Legendre-Gauss-Lobatto nodes: order N - 1",
               false,
               true,
               false},
    MethodInfo{named::radau_name,
               true,
               {},
               "collocation by polynomials at the left end and 6 Radau nodes: order 2 N - 3",
               false,
               true,
               false},
    MethodInfo{AdaptiveCollocation::name,
               false,
               {},
               "collocation at Radau nodes with control of steps, order (nodes 9, 13 or 17) and solver",
               false,
               true,
               true}};

void check_positive(std::string_view name, std::string_view what, const std::optional<double>& value) {
  if (value && (!(*value > 0) || !std::isfinite(*value)))
    throw std::invalid_argument(
        fmt::format("{}: the {} must be positive and finite, not {}", name, what, *value));
}

void check(const MethodInfo& method, const Settings& settings) {
  const auto refuse = [&](std::string_view why) {
    throw std::invalid_argument(fmt::format("{}: {}", method.name, why));
  };
  check_positive(method.name, "step", settings.step);
  check_positive(method.name, "tolerance", settings.tolerance);
  check_positive(method.name, "absolute tolerance", settings.absolute_tolerance);
  check_positive(method.name, "shape", settings.shape);
  if (settings.step && settings.tolerance) refuse("give a step or a tolerance, not both");
  if (settings.step && !method.fixed_step && !method.has_order && !method.takes_step)
    refuse("it chooses its steps itself; give a tolerance, not a step");
  if (settings.absolute_tolerance && (method.fixed_step || settings.step))
    refuse("an absolute tolerance is for methods that choose their steps");
  if (settings.nodes && !method.has_nodes) refuse("it has no nodes to choose");
  if (settings.shape && !method.has_shape) refuse("it has no shape to choose");
  if (settings.order && !method.has_order) refuse("it has no order to choose");
  if (settings.points && !method.has_points) refuse("it has no points to choose");
  if (settings.nodes && (*settings.nodes < 2 || *settings.nodes > collocation::max_nodes))
    refuse(fmt::format("the nodes must be from 2 to {}, not {}", collocation::max_nodes, *settings.nodes));
}

template <int n>
NamedIntegrator<n> transversal(const MethodInfo& info, const Settings& settings) {
  const int points = settings.points.value_or(Mtl{}.points);
  const auto make = [points](double step) { return Mtl{.step = step, .points = points}; };
  check_options(make(1));
  return named::fixed_step<n>(info, settings, mtl_order(MtlBasis::lagrange, points), make);
}

}  // namespace

std::span<const MethodInfo> named_methods() { return methods; }

const MethodInfo& method_info(std::string_view name) {
  const auto* const found =
      std::find_if(methods.begin(), methods.end(), [name](const MethodInfo& m) { return m.name == name; });
  if (found != methods.end()) return *found;
  std::vector<std::string_view> known;
  for (const MethodInfo& m : methods) known.push_back(m.name);
  throw std::invalid_argument(
      fmt::format("there is no method '{}'; there is {}", name, fmt::join(known, ", ")));
}

std::string_view to_string(Controlled controlled) {
  switch (controlled) {
    case Controlled::step_size: return "step_size";
    case Controlled::local_error: return "local_error";
    case Controlled::difference_of_runs: break;
  }
  return "difference_of_runs";
}

Controlled controlled(const MethodInfo& method, const Settings& settings) {
  if (settings.step) return Controlled::step_size;
  return method.fixed_step ? Controlled::difference_of_runs : Controlled::local_error;
}

template <int n>
NamedIntegrator<n> named_integrator(std::string_view name, const Settings& settings) {
  const MethodInfo& info = method_info(name);
  check(info, settings);
  using named::by_tolerance;
  const auto with = [&](auto make) { return named::fixed_step<n>(info, settings, info.order, make); };
  if (info.name == Euler::name) return with([](double step) { return Euler{.step = step}; });
  if (info.name == BackwardEuler::name) return with([](double step) { return BackwardEuler{.step = step}; });
  if (info.name == Rk4::name) return with([](double step) { return Rk4{.step = step}; });
  if (info.name == Rk6::name) return with([](double step) { return Rk6{.step = step}; });
  if (info.name == Ode45::name) return by_tolerance<n, Ode45>(settings);
  if (info.name == Series::name) {
    const double step = settings.step.value_or(0);
    const int order = settings.order.value_or(settings.step ? published_order : 0);
    return by_tolerance<n, Series>(settings, {.order = order, .step = step});
  }
  if (info.name == Mtl::name) return transversal<n>(info, settings);
  if (auto method = named::by_collocation<n>(info, settings)) return method;
  return named::for_accelerations<n>(info, settings);
}

template NamedIntegrator<1> named_integrator<1>(std::string_view, const Settings&);
template NamedIntegrator<2> named_integrator<2>(std::string_view, const Settings&);
template NamedIntegrator<3> named_integrator<3>(std::string_view, const Settings&);
template NamedIntegrator<4> named_integrator<4>(std::string_view, const Settings&);
template NamedIntegrator<6> named_integrator<6>(std::string_view, const Settings&);
template NamedIntegrator<Eigen::Dynamic> named_integrator<Eigen::Dynamic>(std::string_view, const Settings&);

}  // namespace nlmech::ivp

#include "nlmech/ivp/named_methods.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/collocation/matrix.hpp"
#include "nlmech/ivp/adaptive_collocation.hpp"
#include "nlmech/ivp/backward_euler.hpp"
#include "nlmech/ivp/central_difference.hpp"
#include "nlmech/ivp/collocation.hpp"
#include "nlmech/ivp/dormand_prince.hpp"
#include "nlmech/ivp/explicit_runge_kutta.hpp"
#include "nlmech/ivp/generalized_alpha.hpp"
#include "nlmech/ivp/hermitian.hpp"
#include "nlmech/ivp/hht.hpp"
#include "nlmech/ivp/mtl.hpp"
#include "nlmech/ivp/newmark.hpp"
#include "nlmech/ivp/picard.hpp"
#include "nlmech/ivp/rkn1210.hpp"
#include "nlmech/ivp/series.hpp"
#include "nlmech/ivp/step_search.hpp"

namespace nlmech::ivp {
namespace {

constexpr std::string_view lgl_name = "lgl-coll", radau_name = "radau-coll";

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
    MethodInfo{lgl_name,
               true,
               {},
               "collocation by polynomials at 7 Legendre-Gauss-Lobatto nodes: order N - 1",
               false,
               true,
               false},
    MethodInfo{radau_name,
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

/// Relative error of the rate at which a method of fixed step moves along x' = const, for a step; empty if
/// there is none.
using RateError = std::function<double(double step)>;

/// Radial functions do not contain the linear ones. With N unknowns D x = h g and g = 1 the state should grow
/// by h; by how much of h does it miss?
double rate_error(const RbfCollocation& method) {
  const collocation::Basis basis = basis_of(method);
  if (!basis.status().ok()) return HUGE_VAL;
  const Eigen::Index inner = basis.nodes().size() - 1;
  const Eigen::VectorXd growth =
      basis.derivative().bottomRightCorner(inner, inner).lu().solve(Eigen::VectorXd::Ones(inner));
  return std::abs(growth[inner - 1] - 1);
}

/// Failure if a wrong rate alone makes an error beyond the tolerance: near the end x a time wrong by
/// rate (t1 - t0) moves the state by that times f. Halving the step does not show it, if the shape follows
/// the step.
template <int n>
Status check_rate(std::string_view name, const System<n>& system, double rate, double t0, double t,
                  const State<n>& x, double t1, double tolerance) {
  State<n> f(x.size());
  system.rhs(t, x, f);
  const double drift = rate * std::abs(t1 - t0) * (f.array().abs() / (1 + x.array().abs())).maxCoeff();
  if (drift <= tolerance) return {};
  return Status::failure(
      Outcome::not_converged,
      fmt::format(
          "{}: no step meets the tolerance {:.6g}: with this shape a constant rate is wrong by {:.2g} "
          "of itself, which adds up to {:.2g} at t = {:.6g}; take another shape or more nodes, a larger "
          "tolerance, or polynomials (lgl-coll, radau-coll)",
          name, tolerance, rate, drift, t1));
}

/// A method of fixed step in search of its step.
template <int n, class Make>
NamedIntegrator<n> searching(const StepSearch& search, Make make, const RateError& rate, bool rate_is_fixed) {
  return [=](const System<n>& system, const State<n>& x0, double t0, double t1, const Observer<n>& observer,
             const Limits& limits) {
    const Stopwatch watch;
    double last = 1;
    const FixedStepRun<n> run = [&](double step, const Observer<n>& seen, const Limits& left) {
      last = step;
      return integrate(system, x0, t0, t1, make(step), seen, left);
    };
    // Nothing to be found on an interval without length, or from a state that is not finite.
    if (t0 == t1 || !x0.allFinite() || !std::isfinite(t1 - t0)) return run(last, observer, limits);
    Solution<n> s{t0, x0, {}, {}};
    if (rate_is_fixed) s.status = check_rate(search.name, system, rate(1), t0, t0, x0, t1, search.tolerance);
    if (s.status.ok()) s = search_step<n>(search, run, t0, x0, t1, observer, limits);
    if (s.status.ok() && rate)
      s.status = check_rate(search.name, system, rate(last), t0, s.t, s.x, t1, search.tolerance);
    s.statistics.seconds = watch.seconds();
    return s;
  };
}

/// A method of fixed step. @param make the aggregate for a step
template <int n, class Make>
NamedIntegrator<n> fixed_step(const MethodInfo& info, const Settings& settings, std::optional<int> order,
                              Make make, const RateError& rate = {}) {
  if (settings.step) {
    return [method = make(*settings.step)](const System<n>& system, const State<n>& x0, double t0, double t1,
                                           const Observer<n>& observer, const Limits& limits) {
      return integrate(system, x0, t0, t1, method, observer, limits);
    };
  }
  StepSearch search{std::string(info.name), order, settings.tolerance.value_or(default_tolerance)};
  // The step of a collocation costs as many steps of another method as there are unknowns in its matrix.
  if (info.has_nodes)
    search.most_steps /= std::int64_t{1} * settings.nodes.value_or(7) * settings.nodes.value_or(7);
  return searching<n>(search, make, rate, rate && !settings.shape);
}

/// A method that chooses its steps; @p method has all else.
template <int n, class Method>
NamedIntegrator<n> by_tolerance(const Settings& settings, Method method = {}) {
  method.relative_tolerance = settings.tolerance.value_or(default_tolerance);
  method.absolute_tolerance = settings.absolute_tolerance.value_or(method.relative_tolerance);
  check_options(method);
  return
      [method](const System<n>& system, const State<n>& x0, double t0, double t1, const Observer<n>& observer,
               const Limits& limits) { return integrate(system, x0, t0, t1, method, observer, limits); };
}

/// Hermitian operators, which have an estimate of their error: with a tolerance they choose their steps.
template <int n>
NamedIntegrator<n> by_operators(const HermitianPair& pair, const Settings& settings) {
  if (!settings.step) return by_tolerance<n>(settings, Hermitian{.operators = pair});
  const Hermitian method{.operators = pair, .step = *settings.step};
  return
      [method](const System<n>& system, const State<n>& x0, double t0, double t1, const Observer<n>& observer,
               const Limits& limits) { return integrate(system, x0, t0, t1, method, observer, limits); };
}

template <int n>
NamedIntegrator<n> nystroem(const Settings& settings) {
  const double tolerance = settings.tolerance.value_or(default_tolerance);
  const Rkn1210 method{.relative_tolerance = tolerance,
                       .absolute_tolerance = settings.absolute_tolerance.value_or(tolerance)};
  check_options(method);
  return
      [method](const System<n>& system, const State<n>& x0, double t0, double t1, const Observer<n>& observer,
               const Limits& limits) { return integrate(system, x0, t0, t1, method, observer, limits); };
}

template <int n>
NamedIntegrator<n> transversal(const MethodInfo& info, const Settings& settings) {
  const int points = settings.points.value_or(Mtl{}.points);
  const auto make = [points](double step) { return Mtl{.step = step, .points = points}; };
  check_options(make(1));
  return fixed_step<n>(info, settings, mtl_order(MtlBasis::lagrange, points), make);
}

/// Methods with nodes; nothing for another name.
template <int n>
NamedIntegrator<n> collocation_by_name(const MethodInfo& info, const Settings& settings) {
  const double shape = settings.shape.value_or(0);
  if (info.name == AdaptiveCollocation::name)
    return by_tolerance<n, AdaptiveCollocation>(settings,
                                                {.nodes = settings.nodes.value_or(0), .shape = shape});
  if (info.name == Mcpi::name) {
    const int order = settings.nodes ? *settings.nodes - 1 : Mcpi{}.order;
    return fixed_step<n>(info, settings, {},
                         [order](double step) { return Mcpi{.step = step, .order = order}; });
  }
  const int nodes = settings.nodes.value_or(PolynomialCollocation{}.nodes);
  if (info.name == RbfCollocation::name) {
    const auto make = [nodes, shape](double step) {
      return RbfCollocation{.step = step, .nodes = nodes, .shape = shape};
    };
    return fixed_step<n>(info, settings, {}, make, [make](double step) { return rate_error(make(step)); });
  }
  const auto polynomials = [&](collocation::NodeFamily points, int order) {
    return fixed_step<n>(info, settings, order, [nodes, points](double step) {
      return PolynomialCollocation{.step = step, .nodes = nodes, .points = points};
    });
  };
  if (info.name == lgl_name) return polynomials(collocation::NodeFamily::legendre_gauss_lobatto, nodes - 1);
  if (info.name == radau_name) return polynomials(collocation::NodeFamily::left_end_and_radau, 2 * nodes - 3);
  return {};
}

/// Methods for accelerations; nothing for another name.
template <int n>
NamedIntegrator<n> second_order_by_name(const MethodInfo& info, const Settings& settings) {
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

template <int n>
NamedIntegrator<n> named_integrator(std::string_view name, const Settings& settings) {
  const MethodInfo& info = method_info(name);
  check(info, settings);
  const auto with = [&](auto make) { return fixed_step<n>(info, settings, info.order, make); };
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
  if (auto method = collocation_by_name<n>(info, settings)) return method;
  return second_order_by_name<n>(info, settings);
}

template NamedIntegrator<1> named_integrator<1>(std::string_view, const Settings&);
template NamedIntegrator<2> named_integrator<2>(std::string_view, const Settings&);
template NamedIntegrator<3> named_integrator<3>(std::string_view, const Settings&);
template NamedIntegrator<4> named_integrator<4>(std::string_view, const Settings&);
template NamedIntegrator<6> named_integrator<6>(std::string_view, const Settings&);
template NamedIntegrator<Eigen::Dynamic> named_integrator<Eigen::Dynamic>(std::string_view, const Settings&);

}  // namespace nlmech::ivp

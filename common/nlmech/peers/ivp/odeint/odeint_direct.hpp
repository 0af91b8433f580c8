/// @file
/// Odeint with an inlined right-hand side, for benchmarks: as in its manual, without integrate_steps(), and
/// as a method of integrate() on a Direct. Requires Boost.
#pragma once

#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <functional>
#include <stdexcept>
#include <type_traits>

#include "nlmech/peers/ivp/odeint/odeint_stepper.hpp"

namespace nlmech::peers {

/// Integrates from @p t0 to @p t1 > t0 with an initial step of a thousandth of the interval.
///
/// Nothing is checked: with a tolerance below rounding Odeint 1.74 may never return. Try such tolerances with
/// the peer of integrate() first.
/// @param f called as f(x, dxdt, t) @param x initial state; replaced by the final one
/// @return true on success; false also for rosenbrock4, which is not explicit
template <class F, std::size_t n>
[[nodiscard]] bool odeint_natively(const Odeint& method, const F& f, double t0, double t1,
                                   std::array<double, n>& x) {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, n>;
  const double absolute = method.absolute_tolerance, relative = method.relative_tolerance;
  const double step = (t1 - t0) / 1000;
  // By reference, because a copy of a stepper reads uninitialised stages.
  const auto go = [&](auto&& stepper) {
    odeint::integrate_adaptive(std::ref(stepper), f, x, t0, t1, step);
    return true;
  };
  const auto controlled = [&]<class Formula>(std::type_identity<Formula>) {
    // Odeint copies the stages here, too; those of a static object are zeros.
    static const Formula blank;
    return go(odeint::make_controlled(absolute, relative, blank));
  };
  try {
    switch (method.formula) {
      case Odeint::Formula::dopri5:
        return controlled(std::type_identity<odeint::runge_kutta_dopri5<State>>{});
      case Odeint::Formula::fehlberg78:
        return controlled(std::type_identity<odeint::runge_kutta_fehlberg78<State>>{});
      case Odeint::Formula::bulirsch_stoer: return go(odeint::bulirsch_stoer<State>(absolute, relative));
      case Odeint::Formula::rosenbrock4: break;
    }
  } catch (const std::runtime_error&) {  // Odeint gave up
  }
  return false;
}

/// An explicit formula of Odeint compiled with the system. Its steps equal those of Odeint.
struct OdeintDirect : Odeint {};

/// Makes the inlined Odeint available to integrate(). @throws std::invalid_argument for rosenbrock4
template <ivp::SystemLike S>
[[nodiscard]] ivp::SolutionOf<S> run(const ivp::InitialValueProblemOf<S>& problem,
                                     const OdeintDirect& method) {
  using State = detail::OdeintStateOf<S::dimension>;
  require_tolerances(method.name(), {method.relative_tolerance, method.absolute_tolerance});
  return run_peer(problem, [&](EquationsOf<S>& equations, Run& run) {
    return detail::run_explicit_odeint<State>(equations, run, method);
  });
}

}  // namespace nlmech::peers

/// @file
/// Odeint with the right-hand side inlined: for benchmarks against our own methods on a Direct. Needs Boost.
#pragma once

#include "nlmech/peers/ivp/odeint/odeint_stepper.hpp"

namespace nlmech::peers {

/// An explicit formula of Odeint, compiled with the system that it integrates. The same steps as Odeint.
struct OdeintDirect : Odeint {};

/// The inlined Odeint as a method of integrate(). @throws std::invalid_argument for rosenbrock4
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

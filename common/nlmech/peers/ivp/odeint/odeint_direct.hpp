/// @file
/// Odeint with the right-hand side inlined: for benchmarks against our own methods on a Direct. Needs Boost.
#pragma once

#include "nlmech/peers/ivp/odeint/odeint_stepper.hpp"

namespace nlmech::peers {

/// An explicit formula of Odeint, compiled with the system that it integrates. The same steps as Odeint.
struct OdeintDirect : Odeint {};

}  // namespace nlmech::peers

/// The inlined Odeint as a method of integrate(). @throws std::invalid_argument for rosenbrock4
template <nlmech::ivp::SystemLike S>
struct nlmech::ivp::Integrator<S, nlmech::peers::OdeintDirect> {
  /// See integrate().
  static Solution<S::dimension> run(const Task<S>& task, const peers::OdeintDirect& method) {
    using State = peers::detail::OdeintStateOf<S::dimension>;
    peers::require_tolerances(method.name(), {method.relative_tolerance, method.absolute_tolerance});
    return peers::run_peer(task, [&](peers::EquationsOf<S>& equations, peers::Run& run) {
      return peers::detail::run_explicit_odeint<State>(equations, run, method);
    });
  }
};

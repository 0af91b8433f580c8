/// @file
/// integrate(): any system by any method.
#pragma once

#include <string_view>
#include <type_traits>
#include <utility>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/stated_limits.hpp"
#include "nlmech/ivp/switching.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {

/// Initial value problem as passed to a method: the arguments are checked and t0 != t1.
///
/// A method is an aggregate of options with a function
/// `Solution run(const InitialValueProblem&, const Method&)`; a method that can be inlined with its problem
/// has it as a template on the system.
template <SystemLike S>
struct InitialValueProblemOf {
  const S& system;                ///< the equations
  const typename S::State& x0;    ///< finite initial state
  double t0;                      ///< start
  double t1;                      ///< end, before or after t0
  const ObserverOf<S>& observer;  ///< may be empty
  const Limits& limits;           ///< limits of steps, wall time and step size
};
/// Initial value problem of a System.
using InitialValueProblem = InitialValueProblemOf<System>;

namespace detail {

/// @throws std::invalid_argument if a time or the interval is not finite or the sizes differ; names the value
void check_arguments(double t0, double t1, Eigen::Index given_size, int size);
/// Failure `non_finite` for an initial state with NaN or infinity, with the component; otherwise success.
[[nodiscard]] Status check_initial_state(const double* x0, int size, double t0);

/// Type-erased method with its options. Code for it is compiled once per system, not once per method.
template <SystemLike S>
struct AnyMethod {
  const void* method;  ///< the aggregate
  SolutionOf<S> (*run)(const InitialValueProblemOf<S>& problem,
                       const void* method);               ///< integrates by the method
  std::string_view name;                                  ///< for messages
  bool by_tolerances = false;                             ///< are the steps adaptive?
  double relative_tolerance = 0, absolute_tolerance = 0;  ///< for adaptive steps
};
/// AnyMethod of @p method, which outlives it.
template <SystemLike S, class Method>
[[nodiscard]] AnyMethod<S> any_method(const Method& method) {
  AnyMethod<S> any{&method,
                   [](const InitialValueProblemOf<S>& problem, const void* options) -> SolutionOf<S> {
                     return run(problem, *static_cast<const Method*>(options));
                   },
                   method_name(method)};
  if constexpr (HasTolerances<Method>) {
    any.by_tolerances = uses_tolerances(method);
    any.relative_tolerance = method.relative_tolerance;
    any.absolute_tolerance = method.absolute_tolerance;
  }
  return any;
}

/// Runs a method with tolerances and checks the bounds and invariants of the problem. A step in which the
/// observer ends the run is not checked: it may extend beyond the event.
/// @param run integrates a copy of @p problem with another observer
template <SystemLike S, class Run>
[[nodiscard]] SolutionOf<S> run_within(const InitialValueProblemOf<S>& problem, const AnyMethod<S>& method,
                                       Run&& run) {
  StatedLimits<S> stated(problem.system, method.name, problem.t0, problem.x0, problem.t1,
                         method.relative_tolerance, method.absolute_tolerance);
  ObserverOf<S> guard;
  if (stated.has_bounds()) {
    guard = [&](const StepOf<S>& step) {
      return (!problem.observer || problem.observer(step)) && stated.respects(step);
    };
  }
  const ObserverOf<S>* const seen = guard ? &guard : &problem.observer;
  SolutionOf<S> solution = run({problem.system, problem.x0, problem.t0, problem.t1, *seen, problem.limits});
  if (solution.status.ok()) stated.respects_end(solution.statistics.steps, solution.t, solution.x);
  if (!stated.status().ok()) solution.status = stated.status();
  return solution;
}

/// integrate() by any method.
template <SystemLike S>
[[nodiscard]] SolutionOf<S> integrate_by(const AnyMethod<S>& method, const S& system,
                                         const typename S::State& x0, double t0, double t1,
                                         const ObserverOf<S>& observer, const Limits& limits) {
  check_arguments(t0, t1, x0.size(), system.size());
  if constexpr (std::is_same_v<S, System>) {
    if (system.switches() > 0) {
      const SmoothRun smooth = [&method](const System& part, const State& x, double from, double to,
                                         const Observer& seen, const Limits& most) {
        return integrate_by(method, part, x, from, to, seen, most);
      };
      const auto switching = [&smooth](const InitialValueProblem& all) {
        return integrate_switching(all.system, all.x0, all.t0, all.t1, smooth, all.observer, all.limits);
      };
      const InitialValueProblem problem{system, x0, t0, t1, observer, limits};
      return method.by_tolerances ? run_within(problem, method, switching) : switching(problem);
    }
  }
  const Stopwatch watch;
  SolutionOf<S> solution{t0, x0, check_initial_state(x0.data(), system.size(), t0), {}};
  if (solution.status.ok() && t0 != t1) {
    const InitialValueProblemOf<S> problem{system, x0, t0, t1, observer, limits};
    const auto smooth = [&method](const InitialValueProblemOf<S>& all) {
      return method.run(all, method.method);
    };
    solution = method.by_tolerances ? run_within(problem, method, smooth) : smooth(problem);
  }
  solution.statistics.seconds = watch.seconds();
  return solution;
}
extern template Solution integrate_by<System>(const AnyMethod<System>&, const System&, const State&, double,
                                              double, const Observer&, const Limits&);
}  // namespace detail

/// Integrates dx/dt = f(t, x) from (t0, x0) to t1 (forwards or backwards) by @p method. Never throws for
/// events during the integration: blow-up, non-convergence, step underflow and reached limits are the status
/// of the solution. For a method with tolerances, so is a violation of the problem's bounds or invariants
/// (StatedLimits).
/// @param system a System, or a Direct for inlined right-hand sides. A switching system is integrated from
/// switch to switch (switching.hpp)
/// @param x0 initial state, with the size of the system
/// @param t0 start, finite
/// @param t1 end, finite; t1 = t0 returns x0
/// @param method an aggregate such as `Rk4{.step = 0.01}`
/// @param observer called after each accepted step
/// @param limits bounds on steps and wall time
/// @throws std::invalid_argument for a wrong size of x0, a time that is not finite, or options out of range
template <SystemLike S, class Method>
[[nodiscard]] SolutionOf<S> integrate(const S& system, const std::type_identity_t<typename S::State>& x0,
                                      double t0, double t1, const Method& method,
                                      const ObserverOf<S>& observer = {}, const Limits& limits = {}) {
  return detail::integrate_by(detail::any_method<S>(method), system, x0, t0, t1, observer, limits);
}

}  // namespace nlmech::ivp

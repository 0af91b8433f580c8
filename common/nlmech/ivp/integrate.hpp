/// @file
/// The one function that integrates: any system, any method, one kind of answer.
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

/// What is to be integrated, as a method gets it: arguments already checked, t0 != t1.
///
/// A method is an aggregate of options and a function `Solution run(const InitialValueProblem&, const
/// Method&)` beside it; one that is inlined with its problem too has it as a template on the system.
template <SystemLike S>
struct InitialValueProblemOf {
  const S& system;                ///< the equations
  const typename S::State& x0;    ///< finite initial state
  double t0;                      ///< start
  double t1;                      ///< end, before or after t0
  const ObserverOf<S>& observer;  ///< may be empty
  const Limits& limits;           ///< bounds on the work
};
/// Of a System.
using InitialValueProblem = InitialValueProblemOf<System>;

namespace detail {

/// @throws std::invalid_argument naming the value that cannot be meant
void check_arguments(double t0, double t1, Eigen::Index given_size, int size);
/// Failure `non_finite` for an initial state with NaN or infinity, naming the component; else success.
[[nodiscard]] Status check_initial_state(const double* x0, int size, double t0);

/// A method with its options, as all that stands around its run sees it. What is written for this is compiled
/// once for a system, and not for each method anew.
template <SystemLike S>
struct AnyMethod {
  const void* method;                                                                 ///< the aggregate
  SolutionOf<S> (*run)(const InitialValueProblemOf<S>& problem, const void* method);  ///< by it
  std::string_view name;                                                              ///< in sentences
  bool by_tolerances = false;                             ///< does it choose its steps?
  double relative_tolerance = 0, absolute_tolerance = 0;  ///< if it does
};
/// The same of @p method, which must live as long.
template <SystemLike S, class Method>
[[nodiscard]] AnyMethod<S> any_method(const Method& method) {
  AnyMethod<S> any{&method,
                   [](const InitialValueProblemOf<S>& problem, const void* options) -> SolutionOf<S> {
                     return run(problem, *static_cast<const Method*>(options));
                   },
                   method_name(method)};
  if constexpr (HasTolerances<Method>) {
    any.by_tolerances = goes_by_tolerances(method);
    any.relative_tolerance = method.relative_tolerance;
    any.absolute_tolerance = method.absolute_tolerance;
  }
  return any;
}

/// Runs a method with tolerances, and checks it against what the problem says of its solutions. A step in
/// which the observer ends the run is not looked at: it may lead beyond what counts of it.
/// @param run the method's, of a problem like @p problem with another observer
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

/// Integrates dx/dt = f(t, x) from (t0, x0) to t1 (forwards or backwards) by @p method.
/// Never throws for what happens on the way: blow-up, non-convergence, step underflow and used-up limits are
/// the solution's status; so is, for a method with tolerances, a run that leaves the bounds or invariants
/// that the problem names (StatedLimits).
/// @param system a System, or a Direct for inlined right-hand sides. One that switches is integrated from
/// switch to switch (switching.hpp)
/// @param x0 as many components as the system has
/// @param t0 start, finite
/// @param t1 end, finite; equal to t0 gives x0 back
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

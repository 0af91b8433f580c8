/// @file
/// The one function that integrates: any system, any method, one kind of answer.
#pragma once

#include <string_view>
#include <type_traits>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/stated_limits.hpp"
#include "nlmech/ivp/switching.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::ivp {

/// What is to be integrated, as a method gets it: arguments already checked, t0 != t1.
template <SystemLike S>
struct Task {
  const S& system;                         ///< the equations
  const State<S::dimension>& x0;           ///< finite initial state
  double t0;                               ///< begin
  double t1;                               ///< end, before or after t0
  const Observer<S::dimension>& observer;  ///< may be empty
  const Limits& limits;                    ///< bounds on the work
};

/// A method on a kind of system: each method's header specialises it with
/// `static Solution<S::dimension> run(const Task<S>&, const Method&)`.
template <class S, class Method>
struct Integrator;

/// The sizes of System for which the library compiles a method.
enum class InLibrary {
  none,  ///< as of methods of your own, which are compiled where they are used
  all,   ///< 1, 2, 3, 4, 6 and Eigen::Dynamic
  even   ///< 2, 4, 6 and Eigen::Dynamic, of a method for accelerations
};

/// Said by the header of each method of the library.
template <class Method>
inline constexpr InLibrary in_library = InLibrary::none;

namespace detail {
/// The run of a method that the library compiles: declared here, so that nobody compiles it anew, and defined
/// in the library alone.
template <int n, class Method>
struct Instance {
  /// See integrate().
  static Solution<n> run(const Task<System<n>>& task, const Method& method);
};

/// Is there an Instance?
template <class S, class Method>
inline constexpr bool has_instance = false;
template <int n, class Method>
inline constexpr bool has_instance<System<n>, Method> =
    n == 1 || n == 3
        ? in_library<Method> == InLibrary::all
        : (n == 2 || n == 4 || n == 6 || n == Eigen::Dynamic) && in_library<Method> != InLibrary::none;

/// By the library's instance if there is one.
template <SystemLike S, class Method>
[[nodiscard]] Solution<S::dimension> run(const Task<S>& task, const Method& method) {
  if constexpr (has_instance<S, Method>)
    return Instance<S::dimension, Method>::run(task, method);
  else
    return Integrator<S, Method>::run(task, method);
}

/// Throws std::invalid_argument naming the value that cannot be meant.
void check_arguments(double t0, double t1, Eigen::Index given_size, int size);
/// Failure `non_finite` for an initial state with NaN or infinity, naming the component; else success.
[[nodiscard]] Status check_initial_state(const double* x0, int size, double t0);

/// A method with its options, as all that stands around its run sees it. What is written for this is compiled
/// once for a system, and not for each method anew.
template <SystemLike S>
struct AnyMethod {
  const void* method;                                                      ///< the aggregate
  Solution<S::dimension> (*run)(const Task<S>& task, const void* method);  ///< by it
  std::string_view name;                                                   ///< in sentences
  bool by_tolerances = false;                                              ///< does it choose its steps?
  double relative_tolerance = 0, absolute_tolerance = 0;                   ///< if it does
};
/// The same of @p method, which must live as long.
template <SystemLike S, class Method>
[[nodiscard]] AnyMethod<S> any_method(const Method& method) {
  AnyMethod<S> any{&method,
                   [](const Task<S>& task, const void* options) {
                     return detail::run(task, *static_cast<const Method*>(options));
                   },
                   method_name(method)};
  if constexpr (HasTolerances<Method>) {
    any.by_tolerances = goes_by_tolerances(method);
    any.relative_tolerance = method.relative_tolerance;
    any.absolute_tolerance = method.absolute_tolerance;
  }
  return any;
}

/// Runs a method with tolerances, and holds it to what the problem says of its solutions.
template <SystemLike S>
[[nodiscard]] Solution<S::dimension> run_within(const Task<S>& task, const AnyMethod<S>& method) {
  constexpr int n = S::dimension;
  StatedLimits<S> stated(task.system, method.name, task.t0, task.x0, task.t1, method.relative_tolerance,
                         method.absolute_tolerance);
  Observer<n> guard;
  if (stated.has_bounds()) {
    guard = [&](const Step<n>& step) {
      return stated.respects(step) && (!task.observer || task.observer(step));
    };
  }
  const Observer<n>* const seen = guard ? &guard : &task.observer;
  Solution<n> solution =
      method.run(Task<S>{task.system, task.x0, task.t0, task.t1, *seen, task.limits}, method.method);
  if (solution.status.ok()) stated.respects_end(solution.statistics.steps, solution.t, solution.x);
  if (!stated.status().ok()) solution.status = stated.status();
  return solution;
}

/// May the system switch?
template <class S>
inline constexpr bool has_switching = false;
template <int n>
inline constexpr bool has_switching<System<n>> = can_switch<n>;

/// integrate() by any method.
template <SystemLike S>
[[nodiscard]] Solution<S::dimension> integrate_by(const AnyMethod<S>& method, const S& system,
                                                  const State<S::dimension>& x0, double t0, double t1,
                                                  const Observer<S::dimension>& observer,
                                                  const Limits& limits) {
  check_arguments(t0, t1, x0.size(), system.size());
  if constexpr (has_switching<S>) {
    if (system.switches() > 0) {
      const SmoothRun<S::dimension> smooth =
          [&method](const S& part, const auto& x, double from, double to, const Observer<S::dimension>& seen,
                    const Limits& most) { return integrate_by(method, part, x, from, to, seen, most); };
      return integrate_switching<S::dimension>(system, x0, t0, t1, smooth, observer, limits);
    }
  }
  const Stopwatch watch;
  Solution<S::dimension> solution{t0, x0, check_initial_state(x0.data(), system.size(), t0), {}};
  if (solution.status.ok() && t0 != t1) {
    const Task<S> task{system, x0, t0, t1, observer, limits};
    solution = method.by_tolerances ? run_within(task, method) : method.run(task, method.method);
  }
  solution.statistics.seconds = watch.seconds();
  return solution;
}
/// The library's, of one size.
template <int n>
using IntegrateBy = Solution<n>(const AnyMethod<System<n>>&, const System<n>&, const State<n>&, double,
                                double, const Observer<n>&, const Limits&);
extern template IntegrateBy<1> integrate_by<System<1>>;
extern template IntegrateBy<2> integrate_by<System<2>>;
extern template IntegrateBy<3> integrate_by<System<3>>;
extern template IntegrateBy<4> integrate_by<System<4>>;
extern template IntegrateBy<6> integrate_by<System<6>>;
extern template IntegrateBy<Eigen::Dynamic> integrate_by<System<Eigen::Dynamic>>;
}  // namespace detail

/// Integrates dx/dt = f(t, x) from (t0, x0) to t1 (forwards or backwards) by @p method.
/// Never throws for what happens on the way: blow-up, non-convergence, step underflow and used-up limits are
/// the solution's status; so is, for a method with tolerances, a run that leaves the bounds or invariants
/// that the problem names (StatedLimits).
/// @param system a System, or a Direct for inlined right-hand sides. One that switches is integrated from
/// switch to switch (switching.hpp)
/// @param x0 as many components as the system has
/// @param t0 begin, finite
/// @param t1 end, finite; equal to t0 gives x0 back
/// @param method an aggregate such as `Rk4{.step = 0.01}`
/// @param observer called after each accepted step
/// @param limits bounds on steps and wall time
/// @throws std::invalid_argument for a wrong size of x0, a time that is not finite, or options out of range
template <SystemLike S, class Method>
[[nodiscard]] Solution<S::dimension> integrate(const S& system,
                                               const std::type_identity_t<State<S::dimension>>& x0, double t0,
                                               double t1, const Method& method,
                                               const Observer<S::dimension>& observer = {},
                                               const Limits& limits = {}) {
  return detail::integrate_by(detail::any_method<S>(method), system, x0, t0, t1, observer, limits);
}

}  // namespace nlmech::ivp

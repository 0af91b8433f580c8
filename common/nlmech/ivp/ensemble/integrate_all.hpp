/// @file
/// Many initial states at once: several in a register where the method allows, and on all processors.
#pragma once

#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "nlmech/ivp/ensemble/pack.hpp"
#include "nlmech/ivp/ensemble/packed.hpp"
#include "nlmech/ivp/ensemble/series_work.hpp"
#include "nlmech/ivp/ensemble/start.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::ivp {

/// Every trajectory by integrate(), each by itself: failures of one leave the others alone, and a trajectory
/// has the same bits in any company, order, and number of threads. Statistics::seconds is 0.
///
/// Series with chosen steps moves as many trajectories in a register as the processor allows, each with its
/// own steps and end; those of one kind of equations, which may differ in their constants, before those of
/// another. A trajectory that is done makes room for the next. Alone go those that switch, meet a
/// discontinuity, or name bounds or invariants.
/// @param threads how many; 0: one a processor
/// @param set which registers; InstructionSet::baseline rounds products by themselves, so that its bits are
/// those of a processor that has no other
/// @return a solution for each start, in their order
/// @throws std::invalid_argument as integrate() does, and if this processor does not have @p set
template <int n, class Method>
[[nodiscard]] std::vector<Solution<n>> integrate_all(
    std::span<const Start<n>> starts, const Method& method, int threads = 0,
    [[maybe_unused]] InstructionSet set = best_instruction_set()) {
  std::vector<Solution<n>> solutions(starts.size());
  if constexpr (std::same_as<Method, Series>) {
    check_options(method);
    if (method.step == 0) {
      std::atomic<std::size_t> next = 0;
      in_threads(std::min(threads_for(threads), starts.size()),
                 [&] { detail::LaneWork<n>(starts, method, set, solutions).run(next); });
      return solutions;
    }
  }
  share_out(starts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) solutions[i] = detail::alone(starts[i], method);
  });
  return solutions;
}

/// The same of one system from t0 to t1.
template <SystemLike S, class Method>
[[nodiscard]] std::vector<Solution<S::dimension>> integrate_all(const S& system,
                                                                std::span<const State<S::dimension>> states,
                                                                double t0, double t1, const Method& method,
                                                                int threads = 0, const Limits& limits = {}) {
  if constexpr (std::same_as<S, System<S::dimension>>) {
    std::vector<Start<S::dimension>> starts;
    for (const auto& x0 : states) starts.push_back({&system, x0, t0, t1, {}, limits});
    return integrate_all<S::dimension>(std::span<const Start<S::dimension>>(starts), method, threads);
  }
  std::vector<Solution<S::dimension>> solutions(states.size());
  share_out(states.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      solutions[i] = integrate(system, states[i], t0, t1, method, {}, limits);
      solutions[i].statistics.seconds = 0;
    }
  });
  return solutions;
}

/// The same of a problem itself, a callable as Direct takes it. Explicit methods of fixed step (Rk4, Euler,
/// Rk6, a user's own) and Ode45 move several trajectories in a register, if the problem has neither switches,
/// bounds and invariants nor discontinuities on the way: compile for the processor (-march=native) to have
/// registers of that width. Their sums are those of a single run in the same order, so the bits are too,
/// unless the compiler fuses products and sums (-ffp-contract=off keeps it from it). What fails, or becomes
/// infinite or NaN, is run again alone, for its status. Series with chosen steps takes the problem as a
/// System, and has the bits of that.
template <class Problem, class Method, int lanes = register_lanes>
requires(!SystemLike<Problem>) [[nodiscard]] std::vector<Solution<Problem::dimension>> integrate_all(
    const Problem& problem, std::span<const State<Problem::dimension>> states, double t0, double t1,
    const Method& method, int threads = 0, const Limits& limits = {}) {
  if constexpr (std::same_as<Method, Series>) {
    if (method.step == 0) {
      const System<Problem::dimension> recorded(problem);
      return integrate_all(recorded, states, t0, t1, method, threads, limits);
    }
  }
  const Direct<Problem> system(problem);
  if constexpr (detail::TakesPack<Problem, Pack<lanes>> && detail::is_plain<Problem>) {
    const bool smooth = std::isfinite(t0) && std::isfinite(t1) && t0 != t1 &&
                        !std::isfinite(limits.seconds) && system.discontinuities(t0, t1).empty();
    const detail::Packed<Problem> packed{problem, system, states, t0, t1, threads, limits};
    if constexpr (ExplicitMethod<Method>) {
      require_step(Method::name, method.step);
      if (smooth && detail::has_grid(t0, t1, method.step, limits))
        return packed.template by_equal_steps<Method, lanes>(method);
    } else if constexpr (std::same_as<Method, Ode45>) {
      check_options(method);
      if (smooth) return packed.template by_chosen_steps<lanes>(method);
    }
  }
  return integrate_all(system, states, t0, t1, method, threads, limits);
}

}  // namespace nlmech::ivp

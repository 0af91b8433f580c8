/// @file
/// Many initial states at once: several in a register where the method allows, and on all processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "nlmech/ivp/direct.hpp"
#include "nlmech/ivp/ensemble/pack.hpp"
#include "nlmech/ivp/ensemble/series_lanes.hpp"
#include "nlmech/ivp/ensemble/start.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::ivp {

namespace detail {

/// A problem that can be evaluated for several trajectories at once.
template <class Problem, class Number>
concept TakesPack = Problem::dimension >
0 && requires(const Problem& problem, const Number& t, const Vector<Number, Problem::dimension>& x,
              Vector<Number, Problem::dimension>& f) {
  problem(t, x, f);
};

/// All steps of an explicit method for several trajectories: the sums of ExplicitStepper in their order.
template <ExplicitMethod M, class Problem, class Number>
void pack_steps(const Problem& problem, const StepGrid& grid, Vector<Number, Problem::dimension>& x) {
  constexpr std::size_t stages = M::tableau.stages;
  using Packs = Vector<Number, Problem::dimension>;
  const SmoothSegment segment(grid.begin, grid.end);
  Packs k[stages], argument;
  for (std::int64_t step = 0; step < grid.count; ++step) {
    const double t = grid.time(step), h = grid.length(step);
    for (std::size_t i = 0; i < stages; ++i) {
      argument = x;
      for (std::size_t j = 0; j < i; ++j) {
        if (M::tableau.a[i][j] == 0) continue;
        const Number weight(h * M::tableau.a[i][j]);
        for (int c = 0; c < Problem::dimension; ++c) argument[c] += weight * k[j][c];
      }
      problem(Number(segment(t + M::tableau.c[i] * h)), argument, k[i]);
    }
    for (std::size_t i = 0; i < stages; ++i) {
      if (M::tableau.b[i] == 0) continue;
      const Number weight(h * M::tableau.b[i]);
      for (int c = 0; c < Problem::dimension; ++c) x[c] += weight * k[i][c];
    }
  }
}

/// One trajectory by itself.
template <int n, class Method>
[[nodiscard]] Solution<n> alone(const Start<n>& start, const Method& method) {
  Solution<n> solution =
      integrate(*start.system, start.x0, start.t0, start.t1, method, start.observer, start.limits);
  solution.statistics.seconds = 0;
  return solution;
}

/// One thread's work: lanes that take the next trajectory when they are free.
template <int n>
void run_lanes(std::span<const Start<n>> starts, const Series& method, std::atomic<std::size_t>& next,
               std::vector<Solution<n>>& solutions, InstructionSet set = best_instruction_set()) {
  SeriesLanes<n> lanes(rule_of(method), set);
  for (bool more = true; more || lanes.busy() > 0;) {
    while (more && lanes.free() > 0) {
      const std::size_t i = next.fetch_add(1);
      more = i < starts.size();
      if (!more) break;
      const Start<n>& start = starts[i];
      check_arguments(start.t0, start.t1, start.x0.size(), start.system->size());
      if (!lanes.suits(start) || !lanes.take_in(i, start, solutions)) solutions[i] = alone(start, method);
    }
    if (lanes.busy() > 0) lanes.run(solutions);
  }
}

}  // namespace detail

/// Every trajectory by integrate(), each by itself: failures of one leave the others alone, and a trajectory
/// has the same bits in any company, order, and number of threads. Statistics::seconds is 0.
///
/// Series with chosen steps moves as many trajectories in a register as the processor allows, each with its
/// own steps and end; those of one kind of equations, which may differ in their constants. A trajectory that
/// is done makes room for the next. Alone go those that switch, meet a discontinuity, or name bounds or
/// invariants.
/// @param threads how many; 0: one a processor
/// @return a solution for each start, in their order
/// @throws std::invalid_argument as integrate() does
template <int n, class Method>
[[nodiscard]] std::vector<Solution<n>> integrate_all(std::span<const Start<n>> starts, const Method& method,
                                                     int threads = 0) {
  std::vector<Solution<n>> solutions(starts.size());
  if constexpr (std::same_as<Method, Series>) {
    check_options(method);
    if (method.step == 0) {
      std::atomic<std::size_t> next = 0;
      in_threads(std::min(threads_for(threads), starts.size()),
                 [&] { detail::run_lanes<n>(starts, method, next, solutions); });
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
/// Rk6, a user's own) move several trajectories in a register, if the problem has neither switches nor
/// discontinuities on the way: compile for the processor (-march=native) to have registers of that width.
/// Their sums are those of a single run in the same order, so the bits are too, unless the compiler fuses
/// products and sums (-ffp-contract=off keeps it from it). What becomes infinite or NaN is run again alone,
/// for its status.
template <class Problem, class Method, int lanes = register_lanes>
requires(!SystemLike<Problem>) [[nodiscard]] std::vector<Solution<Problem::dimension>> integrate_all(
    const Problem& problem, std::span<const State<Problem::dimension>> states, double t0, double t1,
    const Method& method, int threads = 0, const Limits& limits = {}) {
  constexpr int n = Problem::dimension;
  const Direct<Problem> system(problem);
  if constexpr (ExplicitMethod<Method> && detail::TakesPack<Problem, Pack<lanes>> &&
                !detail::GivesSwitches<Problem>) {
    require_step(Method::name, method.step);
    if (std::isfinite(t0) && std::isfinite(t1) && t0 != t1 && !std::isfinite(limits.seconds) &&
        system.discontinuities(t0, t1).empty()) {
      const StepGrid grid = make_step_grid(t0, t1, method.step);
      const bool moves = grid.begin + grid.step != grid.begin && grid.end - grid.step != grid.end;
      if (moves && grid.count <= limits.steps) {
        std::vector<Solution<n>> solutions(states.size());
        share_out(states.size(), lanes, threads, [&](std::size_t begin, std::size_t end) {
          Vector<Pack<lanes>, n> x;
          for (int lane = 0; lane < lanes; ++lane) {
            const State<n>& from = states[std::min(begin + static_cast<std::size_t>(lane), end - 1)];
            for (int c = 0; c < n; ++c) x[c].v[lane] = from[c];
          }
          detail::pack_steps<Method>(problem, grid, x);
          for (std::size_t i = begin; i < end; ++i) {
            Solution<n>& s = solutions[i];
            s.t = t1;
            s.statistics.steps = grid.count;
            s.statistics.right_hand_sides = grid.count * static_cast<std::int64_t>(Method::tableau.stages);
            for (int c = 0; c < n; ++c) s.x[c] = x[c].v[static_cast<int>(i - begin)];
            if (s.x.allFinite()) continue;
            s = integrate(system, states[i], t0, t1, method, {}, limits);
            s.statistics.seconds = 0;
          }
        });
        return solutions;
      }
    }
  }
  return integrate_all(system, states, t0, t1, method, threads, limits);
}

}  // namespace nlmech::ivp

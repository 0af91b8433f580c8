/// @file
/// Many states of one problem that is compiled in, several in a register: explicit methods of fixed step, and
/// ode45.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include "nlmech/ivp/direct.hpp"
#include "nlmech/ivp/ensemble/pack.hpp"
#include "nlmech/ivp/ensemble/pair_lanes.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::ivp::detail {

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

/// Neither switches nor bounds nor invariants, which single steps would have to be held to.
template <class Problem>
inline constexpr bool is_plain = !GivesSwitches<Problem> && !GivesInvariants<Problem> &&
                                 !GivesLowerBounds<Problem> && !GivesUpperBounds<Problem>;

/// Do equal steps move the time, and are they not too many?
[[nodiscard]] inline bool has_grid(double t0, double t1, double step, const Limits& limits) {
  const StepGrid grid = make_step_grid(t0, t1, step);
  return grid.begin + grid.step != grid.begin && grid.end - grid.step != grid.end &&
         grid.count <= limits.steps;
}

/// Many states of one problem that is smooth on the way.
template <class Problem>
struct Packed {
  static constexpr int n = Problem::dimension;
  const Problem& problem;
  const Direct<Problem>& system;
  std::span<const State<n>> states;
  double t0, t1;
  int threads;
  const Limits& limits;

  /// One by itself.
  template <class Method>
  [[nodiscard]] Solution<n> alone(std::size_t i, const Method& method) const {
    Solution<n> solution = integrate(system, states[i], t0, t1, method, {}, limits);
    solution.statistics.seconds = 0;
    return solution;
  }

  /// By an explicit method of fixed step.
  template <class Method, int lanes>
  [[nodiscard]] std::vector<Solution<n>> by_equal_steps(const Method& method) const {
    const StepGrid grid = make_step_grid(t0, t1, method.step);
    std::vector<Solution<n>> solutions(states.size());
    share_out(states.size(), lanes, threads, [&](std::size_t begin, std::size_t end) {
      Vector<Pack<lanes>, n> x;
      for (int lane = 0; lane < lanes; ++lane) {
        const State<n>& from = states[std::min(begin + static_cast<std::size_t>(lane), end - 1)];
        for (int c = 0; c < n; ++c) x[c].v[lane] = from[c];
      }
      pack_steps<Method>(problem, grid, x);
      for (std::size_t i = begin; i < end; ++i) {
        Solution<n>& s = solutions[i];
        s.t = t1;
        s.statistics.steps = grid.count;
        s.statistics.right_hand_sides = grid.count * static_cast<std::int64_t>(Method::tableau.stages);
        for (int c = 0; c < n; ++c) s.x[c] = x[c].v[static_cast<int>(i - begin)];
        if (!s.x.allFinite()) s = alone(i, method);
      }
    });
    return solutions;
  }

  /// By Ode45.
  template <int lanes>
  [[nodiscard]] std::vector<Solution<n>> by_chosen_steps(const Ode45& method) const {
    std::vector<Solution<n>> solutions(states.size());
    std::atomic<std::size_t> next = 0;
    in_threads(std::min(threads_for(threads), states.size()), [&] {
      PairLanes<Problem, lanes> pair(problem, t0, t1, method, limits);
      std::vector<std::size_t> failed;
      for (bool more = true; more || pair.busy() > 0;) {
        while (more && pair.free() > 0) {
          const std::size_t i = next.fetch_add(1);
          more = i < states.size();
          if (more && !pair.take_in(i, states[i])) failed.push_back(i);
        }
        if (pair.busy() > 0) pair.run(solutions, failed);
      }
      for (const std::size_t i : failed) solutions[i] = alone(i, method);
    });
    return solutions;
  }
};

}  // namespace nlmech::ivp::detail

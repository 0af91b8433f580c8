/// @file
/// Many initial states at once: several in a register where the method allows, and on all processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "nlmech/ivp/direct.hpp"
#include "nlmech/ivp/ensemble/pack.hpp"
#include "nlmech/ivp/ensemble/pair_lanes.hpp"
#include "nlmech/ivp/ensemble/series_lanes.hpp"
#include "nlmech/ivp/ensemble/start.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
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
struct Ensemble {
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
      PairLanes<Problem, lanes> pair(problem, t0, t1, method, limits.steps);
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

/// One trajectory by itself.
template <int n, class Method>
[[nodiscard]] Solution<n> alone(const Start<n>& start, const Method& method) {
  Solution<n> solution =
      integrate(*start.system, start.x0, start.t0, start.t1, method, start.observer, start.limits);
  solution.statistics.seconds = 0;
  return solution;
}

/// One thread's lanes, which take the next trajectory when they are free. Those whose equations are of
/// another kind wait until all of the present kind have ended; if there are more kinds than that pays for,
/// lanes end what they have for each.
template <int n>
class LaneWork {
 public:
  /// All outlive it.
  LaneWork(std::span<const Start<n>> starts, const Series& method, InstructionSet set,
           std::vector<Solution<n>>& solutions)
      : starts_(starts), method_(method), solutions_(solutions), lanes_(rule_of(method), set) {}

  /// Runs what @p next hands out to all threads.
  void run(std::atomic<std::size_t>& next) {
    run_all([&] { return next.fetch_add(1); }, starts_.size());
    while (!waiting_.empty()) {
      const std::vector<std::size_t> those = std::exchange(waiting_, {});
      ++kinds_;
      std::size_t k = 0;
      run_all([&] { return k < those.size() ? those[k++] : starts_.size(); }, starts_.size());
    }
  }

 private:
  static constexpr int most_kinds = 8;

  /// @param next a number of a trajectory, or @p end or more after the last
  template <class Next>
  void run_all(const Next& next, std::size_t end) {
    for (bool more = true; more || lanes_.busy() > 0;) {
      while (more && lanes_.free() > 0) {
        const std::size_t i = next();
        more = i < end;
        if (more) begin(i);
      }
      if (lanes_.busy() > 0) lanes_.run(solutions_);
    }
  }
  void begin(std::size_t i) {
    const Start<n>& start = starts_[i];
    check_arguments(start.t0, start.t1, start.x0.size(), start.system->size());
    if (!lanes_.suits(start)) {
      solutions_[i] = alone(start, method_);
    } else if (!lanes_.take_in(i, start, solutions_)) {
      if (kinds_ < most_kinds) return waiting_.push_back(i);
      while (lanes_.busy() > 0) lanes_.run(solutions_);
      (void)lanes_.take_in(i, start, solutions_);  // empty lanes take anything
    }
  }

  std::span<const Start<n>> starts_;
  const Series& method_;
  std::vector<Solution<n>>& solutions_;
  SeriesLanes<n> lanes_;
  std::vector<std::size_t> waiting_;
  int kinds_ = 1;
};

}  // namespace detail

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
    const detail::Ensemble<Problem> ensemble{problem, system, states, t0, t1, threads, limits};
    if constexpr (ExplicitMethod<Method>) {
      require_step(Method::name, method.step);
      if (smooth && detail::has_grid(t0, t1, method.step, limits))
        return ensemble.template by_equal_steps<Method, lanes>(method);
    } else if constexpr (std::same_as<Method, Ode45>) {
      check_options(method);
      if (smooth) return ensemble.template by_chosen_steps<lanes>(method);
    }
  }
  return integrate_all(system, states, t0, t1, method, threads, limits);
}

}  // namespace nlmech::ivp

/// @file
/// Many initial states at once: on all processors, and by series several in a register.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/support/instruction_set.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::ivp {

/// What integrate() takes for one trajectory.
struct Start {
  const System* system;  ///< outlives the integration; may be the same for many
  State x0;              ///< initial state
  double t0;             ///< begin
  double t1;             ///< end
  Observer observer;     ///< may be empty; called by the thread that has the trajectory
  Limits limits;         ///< bounds on its work, from its start
  /// When all trajectories are to be over: one that begins late has less time, or none.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();

  /// The bounds on it if it begins now.
  [[nodiscard]] Limits limits_from_now() const {
    using std::chrono::steady_clock;
    Limits now = limits;
    if (deadline != steady_clock::time_point::max()) {
      const std::chrono::duration<double> left = deadline - steady_clock::now();
      now.seconds = std::min(now.seconds, std::max(0.0, left.count()));
    }
    return now;
  }
};

namespace detail {
/// One trajectory by itself.
template <class Method>
[[nodiscard]] Solution alone(const Start& start, const Method& method) {
  Solution solution =
      integrate(*start.system, start.x0, start.t0, start.t1, method, start.observer, start.limits_from_now());
  solution.statistics.seconds = 0;
  return solution;
}
}  // namespace detail

/// Every trajectory by integrate(), each by itself: failures of one leave the others alone, and a trajectory
/// has the same bits in any company, order, and number of threads. Statistics::seconds is 0.
/// @param threads how many; 0: one a processor
/// @return a solution for each start, in their order
/// @throws std::invalid_argument as integrate() does
template <class Method>
[[nodiscard]] std::vector<Solution> integrate_all(std::span<const Start> starts, const Method& method,
                                                  int threads = 0) {
  std::vector<Solution> solutions(starts.size());
  share_out(starts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) solutions[i] = detail::alone(starts[i], method);
  });
  return solutions;
}

/// Series with chosen steps moves as many trajectories in a register as the processor allows, each with its
/// own steps and end; those of one kind of equations, which may differ in their constants, before those of
/// another. A trajectory that is done makes room for the next. Alone go those that switch, meet a
/// discontinuity, or name bounds or invariants.
/// @param set which registers; InstructionSet::baseline rounds products by themselves, so that its bits are
/// those of a processor that has no other
/// @throws std::invalid_argument also if this processor does not have @p set
[[nodiscard]] std::vector<Solution> integrate_all(std::span<const Start> starts, const Series& method,
                                                  int threads = 0,
                                                  InstructionSet set = best_instruction_set());

/// The same of one system from t0 to t1.
template <class Method>
[[nodiscard]] std::vector<Solution> integrate_all(const System& system, std::span<const State> states,
                                                  double t0, double t1, const Method& method, int threads = 0,
                                                  const Limits& limits = {}) {
  std::vector<Start> starts;
  for (const State& x0 : states) starts.push_back({&system, x0, t0, t1, {}, limits});
  return integrate_all(std::span<const Start>(starts), method, threads);
}

}  // namespace nlmech::ivp

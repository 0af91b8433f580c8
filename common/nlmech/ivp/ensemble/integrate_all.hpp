/// @file
/// Integration of many initial states in parallel: on all processors, and for `series` in vector registers.
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

/// Arguments of integrate() for one trajectory.
struct Start {
  const System* system;  ///< outlives the integration; may be the same for many
  State x0;              ///< initial state
  double t0;             ///< start
  double t1;             ///< end
  Observer observer;     ///< may be empty; called by the thread of the trajectory
  Limits limits;         ///< limits of the trajectory, from its start
  /// Deadline of all trajectories: one that starts late has less time, or none.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();

  /// The limits if the trajectory starts now.
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
/// Integrates one trajectory.
template <class Method>
[[nodiscard]] Solution alone(const Start& start, const Method& method) {
  Solution solution =
      integrate(*start.system, start.x0, start.t0, start.t1, method, start.observer, start.limits_from_now());
  solution.statistics.seconds = 0;
  return solution;
}
}  // namespace detail

/// Integrates every trajectory by integrate(), independently: a failure does not affect the others, and the
/// result has the same bits for any other trajectories, order and number of threads. Statistics::seconds is
/// 0.
/// @param threads number of threads; 0: one per processor
/// @return a solution for each start, in the same order
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

/// Series with adaptive steps integrates as many trajectories in vector registers as the processor allows,
/// each with its own steps and end. Equations that differ in constants only are grouped. A finished
/// trajectory is replaced by the next. Trajectories that switch, meet a discontinuity, or have bounds or
/// invariants are integrated one by one.
/// @param set instruction set; InstructionSet::baseline rounds products separately, so its bits are those of
/// a processor with no other set
/// @throws std::invalid_argument also if the processor does not have @p set
[[nodiscard]] std::vector<Solution> integrate_all(std::span<const Start> starts, const Series& method,
                                                  int threads = 0,
                                                  InstructionSet set = best_instruction_set());

/// The same for one system from t0 to t1.
template <class Method>
[[nodiscard]] std::vector<Solution> integrate_all(const System& system, std::span<const State> states,
                                                  double t0, double t1, const Method& method, int threads = 0,
                                                  const Limits& limits = {}) {
  std::vector<Start> starts;
  for (const State& x0 : states) starts.push_back({&system, x0, t0, t1, {}, limits});
  return integrate_all(std::span<const Start>(starts), method, threads);
}

}  // namespace nlmech::ivp

/// @file
/// Many trajectories by Taylor series: which of them share lanes, and which go alone.
#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "nlmech/ivp/ensemble/series_lanes.hpp"
#include "nlmech/ivp/ensemble/start.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp::detail {

/// One trajectory by itself.
template <int n, class Method>
[[nodiscard]] Solution<n> alone(const Start<n>& start, const Method& method) {
  Solution<n> solution =
      integrate(*start.system, start.x0, start.t0, start.t1, method, start.observer, start.limits_from_now());
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
      static_cast<void>(lanes_.take_in(i, start, solutions_));  // empty lanes take anything
    }
  }

  std::span<const Start<n>> starts_;
  const Series& method_;
  std::vector<Solution<n>>& solutions_;
  SeriesLanes<n> lanes_;
  std::vector<std::size_t> waiting_;
  int kinds_ = 1;
};

}  // namespace nlmech::ivp::detail

/// @file
/// Where functions of time alone become active after a rest: pulses, smoothed switches, bursts.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::program {

/// Which nodes depend on time and on nothing else, by their numbers.
[[nodiscard]] std::vector<bool> of_time_alone(const Graph& graph);

/// Functions of time alone in equations, and the places that a method must not step over: its error estimate
/// sees nothing of a pulse if all values of a step are taken in the rest before it.
///
/// The interval of integration is divided into cells in which a function rests (it varies by at most 1e-12 of
/// its whole variation W) or is active (it varies by at most 2 W). Bounds on it and on its derivative
/// (interval arithmetic) decide, so that no pulse is too narrow, down to 2^-48 of the interval.
class TimeFeatures {
 public:
  /// Of the expressions @p slopes.
  TimeFeatures(const Graph& graph, const std::vector<NodeId>& slopes);

  /// The starts of the first cells of each activity after a rest, and its end if it is short, strictly
  /// between
  /// @p t0 and @p t1 (t0 < t1), ascending. Empty if there are more than ten thousand: so many pulses are not
  /// stepped over. May be called by several threads.
  [[nodiscard]] std::vector<double> between(double t0, double t1) const;

  /// A time in which one of them is active, between two rests or a rest and an end of the interval.
  struct Activity {
    double t0;  ///< start
    double t1;  ///< end
  };
  /// Those between @p t0 and @p t1 (t0 < t1) that last for at most @p longest, by their starts: pulses, and
  /// fast changes from one rest to another.
  [[nodiscard]] std::vector<Activity> short_activities(double t0, double t1, double longest) const;

 private:
  struct Known {
    double t0 = 0, t1 = 0;
    std::vector<double> places;
  };
  std::vector<Program> functions_;  // each with its derivative
  mutable std::mutex mutex_;
  mutable Known known_;  // of the longest interval that was asked for
};

}  // namespace nlmech::program

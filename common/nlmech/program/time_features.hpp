/// @file
/// Times at which functions of time only become active after a rest: pulses, smoothed switches, bursts.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::program {

/// Marks the nodes that depend on time only, by their numbers.
[[nodiscard]] std::vector<bool> of_time_alone(const Graph& graph);

/// Functions of time only in equations, and the times that a step must not cross: the error estimate misses a
/// pulse if all evaluations of a step are in the rest before it.
///
/// The interval of integration is divided into cells in which a function rests (it varies by at most 1e-12 of
/// its whole variation W) or is active (it varies by at most 2 W). Bounds on the function and its derivative
/// (interval arithmetic) decide, so that all pulses are found down to a width of 2^-48 of the interval.
class TimeFeatures {
 public:
  /// Features of the expressions @p slopes.
  TimeFeatures(const Graph& graph, const std::vector<NodeId>& slopes);

  /// The starts of the first cells of each activity after a rest, and its end if it is short, strictly
  /// between @p t0 and @p t1 (t0 < t1), ascending. Empty if there are more than ten thousand: a step does not
  /// cross so many pulses. Thread-safe.
  [[nodiscard]] std::vector<double> between(double t0, double t1) const;

  /// An interval in which a function is active, between two rests or between a rest and an end of the
  /// interval.
  struct Activity {
    double t0;  ///< start
    double t1;  ///< end
  };
  /// The activities between @p t0 and @p t1 (t0 < t1) of a duration up to @p longest, sorted by start:
  /// pulses, and fast changes from one rest to another.
  [[nodiscard]] std::vector<Activity> short_activities(double t0, double t1, double longest) const;

 private:
  struct Known {
    double t0 = 0, t1 = 0;
    std::vector<double> places;
  };
  std::vector<Program> functions_;  // functions, each with its derivative
  mutable std::mutex mutex_;
  mutable Known known_;  // cache for the latest interval
};

}  // namespace nlmech::program

/// @file
/// Wall-clock time, and the median of repeats: the only timing that this suite reports.
#pragma once

#include <chrono>
#include <functional>
#include <vector>

namespace nlmech {

/// Starts when made. The clock never runs backwards.
class Stopwatch {
 public:
  /// Since it was made.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The middle value; the mean of the two middle ones for an even count.
/// @throws std::invalid_argument if @p values is empty
[[nodiscard]] double median(std::vector<double> values);

/// Timings of one piece of work. A wide gap between smallest and largest says that the machine was busy.
struct Timing {
  double median = 0;    ///< seconds a call
  double smallest = 0;  ///< seconds of the fastest call
  double largest = 0;   ///< seconds of the slowest call
  int repeats = 0;      ///< counted calls, after one that warms up
};

/// Calls @p work once to warm up, then @p repeats times, each call timed by itself.
/// @throws std::invalid_argument if @p repeats is below 1
[[nodiscard]] Timing time_repeats(const std::function<void()>& work, int repeats);

/// Up to five repeats in 5 ms, warmed up by the call that took @p first; where that took longer it counts by
/// itself, as any does if @p quick.
[[nodiscard]] Timing repeated_timing(const std::function<void()>& work, double first, bool quick);

}  // namespace nlmech

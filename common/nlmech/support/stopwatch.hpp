/// @file
/// Wall-clock time, and the median of repeated timings, as reported by this suite.
#pragma once

#include <chrono>
#include <functional>
#include <vector>

namespace nlmech {

/// Stopwatch on a monotonic clock; starts at construction.
class Stopwatch {
 public:
  /// Seconds since construction.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Median; the mean of the two middle values for an even count.
/// @throws std::invalid_argument if @p values is empty
[[nodiscard]] double median(std::vector<double> values);

/// Timings of repeated calls. A large difference between smallest and largest indicates a busy machine.
struct Timing {
  double median = 0;    ///< median of the seconds per call
  double smallest = 0;  ///< seconds of the fastest call
  double largest = 0;   ///< seconds of the slowest call
  int repeats = 0;      ///< number of timed calls, without the warm-up
};

/// Calls @p work once as warm-up, then @p repeats times, and times each call.
/// @throws std::invalid_argument if @p repeats is below 1
[[nodiscard]] Timing time_repeats(const std::function<void()>& work, int repeats);

/// Times up to five repeats in 5 ms in total; the call that took @p first seconds was the warm-up. If @p
/// first is above 5 ms or @p quick is true, returns @p first as the only timing.
[[nodiscard]] Timing repeated_timing(const std::function<void()>& work, double first, bool quick);

}  // namespace nlmech

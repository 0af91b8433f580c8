#include "nlmech/support/stopwatch.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace nlmech {

double median(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("median: no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

namespace {

Timing timed(const std::function<void()>& work, int repeats) {
  std::vector<double> seconds(static_cast<std::size_t>(repeats));
  for (double& s : seconds) {
    const Stopwatch watch;
    work();
    s = watch.seconds();
  }
  const auto [low, high] = std::minmax_element(seconds.begin(), seconds.end());
  return {median(seconds), *low, *high, repeats};
}

}  // namespace

Timing time_repeats(const std::function<void()>& work, int repeats) {
  if (repeats < 1)
    throw std::invalid_argument("time_repeats: repeats must be positive, is " + std::to_string(repeats));
  work();
  return timed(work, repeats);
}

Timing repeated_timing(const std::function<void()>& work, double first, bool quick) {
  constexpr double enough = 0.005;  // s, for all repeats: a few hundred settings then take about a second
  if (quick || first > enough) return {first, first, first, 1};
  return timed(work, std::clamp(static_cast<int>(enough / first), 1, 5));
}

}  // namespace nlmech

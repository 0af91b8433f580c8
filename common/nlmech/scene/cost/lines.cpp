#include "nlmech/scene/cost/lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace nlmech::scene {

std::optional<double> Attempt::digits() const {
  if (!error || !std::isfinite(*error)) return {};
  return -std::log10(std::max(*error, std::numeric_limits<double>::epsilon() / 2));
}

const Attempt* MethodLine::best() const {
  const Attempt* best = nullptr;
  for (const Attempt& a : attempts) {
    if (a.digits() && (best == nullptr || *a.error < *best->error)) best = &a;
  }
  return best;
}

double MethodLine::least_error() const {
  const Attempt* found = best();
  return found != nullptr ? *found->error : HUGE_VAL;
}

const MethodLine& ProblemLines::of(const std::string& method) const {
  const auto found = std::ranges::find(lines, method, &MethodLine::method);
  if (found == lines.end()) throw std::out_of_range("there is no line of " + method);
  return *found;
}

Front::Front(const MethodLine& line) {
  for (const Attempt& a : line.attempts) {
    const auto digits = a.digits();
    if (digits && a.time.median > 0 && std::isfinite(a.time.median))
      runs_.emplace_back(*digits, a.time.median);
  }
  // From the most digits down, a run stays if it is cheaper than all that have more.
  std::ranges::sort(runs_, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  std::vector<std::pair<double, double>> kept;
  for (const auto& run : runs_) {
    if (kept.empty() || run.second < kept.back().second) kept.push_back(run);
  }
  runs_.assign(kept.rbegin(), kept.rend());
}

std::optional<double> Front::time(double digits) const {
  constexpr double rounding = 1e-9;  // an error of 1e-9 has nine digits, whatever its logarithm is rounded to
  const auto above =
      std::ranges::find_if(runs_, [&](const auto& run) { return run.first >= digits - rounding; });
  if (above == runs_.end()) return {};
  if (above == runs_.begin() || above->first <= digits) return above->second;
  const auto& [low, low_time] = *std::prev(above);
  const auto& [high, high_time] = *above;
  return low_time * std::pow(high_time / low_time, std::min((digits - low) / (high - low), 1.0));
}

}  // namespace nlmech::scene

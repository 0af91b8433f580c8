/// @file
/// Accuracy of a run near its end: a median over several times, because the error at a single time may be
/// small by cancellation.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "nlmech/comparison/commands/example.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

/// The largest error of a component, relative to the component or, if that is below a thousandth of its size,
/// to its size; absolute for components that are always zero.
[[nodiscard]] inline double relative_error(const ivp::State& found, const ivp::LongState& exact,
                                           const ivp::State& size) {
  double worst = 0;
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const auto value = static_cast<double>(std::abs(exact[i]));
    double scale = value >= 1e-3 * size[i] ? value : size[i];
    if (!(scale > 0)) scale = 1;
    const auto error = static_cast<double>(std::abs(found[i] - exact[i])) / scale;
    if (std::isnan(error)) return error;
    worst = std::max(worst, error);
  }
  return worst;
}

/// -log10 of an error, at most the digits of double.
[[nodiscard]] inline double digits_of(double error) {
  return -std::log10(std::max(error, std::numeric_limits<double>::epsilon() / 2));
}

/// Ends of steps in the last tenth of the interval of integration: the first one after each of 16 equidistant
/// times or, if these are fewer than 16 steps, the last 16 steps of the run. They replace 16 separate runs.
class LastEnds {
 public:
  /// The end of a step.
  struct End {
    double t;      ///< time
    ivp::State x;  ///< state
  };
  /// For a run from t0 to t1 > t0.
  LastEnds(double t0, double t1) : t0_(t0), t1_(t1) {}

  /// Observer of a run; returns true.
  bool see(const ivp::Step& step) {
    if (step.t1 >= target()) {
      spread_.push_back({step.t1, step.x1});
      while (passed_ < count && step.t1 >= target()) ++passed_;
    }
    last_.push_back({step.t1, step.x1});
    if (last_.size() > count) last_.pop_front();
    return true;
  }
  /// The selected ends, ordered by time.
  [[nodiscard]] const std::deque<End>& get() const { return spread_.size() < count ? last_ : spread_; }

 private:
  static constexpr std::size_t count = 16;
  [[nodiscard]] double target() const {
    if (passed_ == count) return std::numeric_limits<double>::infinity();
    return t1_ - (t1_ - t0_) / 10 * static_cast<double>(count - 1 - passed_) / (count - 1);
  }
  double t0_, t1_;
  std::size_t passed_ = 0;
  std::deque<End> spread_, last_;
};

/// Error and cost of a run.
struct Accuracy {
  Status status;                ///< status of the run
  std::optional<double> error;  ///< median of the example's error over LastEnds; nothing if the run failed
  Statistics work;              ///< cost of the run
};

/// Runs an example to its end.
[[nodiscard]] inline Accuracy accuracy_of(const Example& c, const ivp::NamedIntegrator& run,
                                          const ivp::Limits& limits) {
  LastEnds seen(c.t0, c.t1);
  const auto observe = [&seen](const ivp::Step& step) { return seen.see(step); };
  const ivp::Solution end = run(c.system, c.x0, c.t0, c.t1, observe, limits);
  Accuracy accuracy{end.status, {}, end.statistics};
  if (!end.status.ok()) return accuracy;
  std::vector<double> errors;
  for (const auto& e : seen.get()) {
    const ivp::LongState exact = c.reference(e.t);
    errors.push_back(c.error ? c.error(e.x, exact) : relative_error(e.x, exact, c.amplitude));
  }
  accuracy.error = median(errors);
  return accuracy;
}

}  // namespace nlmech::comparison

#include "nlmech/bvp/optimal_control/duffing.hpp"

#include <cmath>
#include <memory>

#include "nlmech/bvp/optimal_control/dual_control.hpp"

namespace nlmech::bvp {

std::string_view to_string(DuffingCase which) {
  switch (which) {
    case DuffingCase::free: return "free";
    case DuffingCase::fixed: return "fixed";
    case DuffingCase::x1x1: return "x1x1";
    case DuffingCase::x1x2: return "x1x2";
    case DuffingCase::x2x1: return "x2x1";
    case DuffingCase::x2x2: return "x2x2";
    case DuffingCase::final_only: return "final-only";
    case DuffingCase::harmonic: return "harmonic";
  }
  return "unknown";
}

std::vector<DuffingCase> duffing_cases() {
  using enum DuffingCase;
  return {free, fixed, x1x1, x1x2, x2x1, x2x2, final_only, harmonic};
}

double printed_beta(DuffingCase which) {
  if (which == DuffingCase::x1x1 || which == DuffingCase::x1x2) return 0.94;
  return which == DuffingCase::x2x1 ? 0.97 : 0.9;
}

Eigen::Vector2d duffing_target(const DuffingSettings& s) {
  if (s.which != DuffingCase::harmonic) return s.target;
  const double w = s.harmonic_frequency, T = s.final_time;
  const Eigen::Vector3d& a = s.amplitudes;
  return {a[0] * std::cos(w * T) + a[1] * std::cos(3 * w * T) + a[2] * std::cos(w * T / 3),
          -(a[0] * w * std::sin(w * T) + 3 * a[1] * w * std::sin(3 * w * T) +
            a[2] * w / 3 * std::sin(w * T / 3))};
}

ExtremalProblem duffing_problem(const DuffingSettings& s) {
  const Eigen::Vector2d target = duffing_target(s);
  auto model = std::make_shared<const DualControl<ControlledDuffing>>(
      ControlledDuffing{s.frequency, target[0], target[1], s.weights[0], s.weights[1]});
  using enum DuffingCase;
  const DuffingCase c = s.which;
  const bool whole_begin = c == free || c == fixed || c == harmonic;
  const bool whole_end = c == fixed || c == harmonic || c == final_only;
  ControlTask task;
  task.final_time = s.final_time;
  task.begin.resize(2);
  task.end.resize(2);
  if (whole_begin || c == x1x1 || c == x1x2) task.begin[0] = s.begin[0];
  if (whole_begin || c == x2x1 || c == x2x2) task.begin[1] = s.begin[1];
  if (whole_end || c == x1x1 || c == x2x1) task.end[0] = target[0];
  if (whole_end || c == x1x2 || c == x2x2) task.end[1] = target[1];
  task.waypoints = s.waypoints;
  task.free_final_time = s.free_final_time;
  task.mu = s.beta;
  task.constraints = s.constraints;
  return {std::move(model), std::move(task)};
}

Multistart duffing_extremals(const DuffingSettings& settings, const DuffingStarts& which,
                             const Options& options, const MultistartOptions& many) {
  const std::vector<Start> starts = duffing_starts(settings, which);
  return multistart(duffing_problem(settings), starts, options, many);
}

}  // namespace nlmech::bvp

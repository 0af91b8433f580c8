#include "nlmech/orbit/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "nlmech/orbit/walk.hpp"

namespace nlmech::orbit {
namespace {

void require_within(std::string_view method, std::string_view option, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    throw std::invalid_argument(
        fmt::format("{}: {} must be from {:g} to {:g}, not {:g}", method, option, low, high, value));
  }
}

void check_task(const State& start, double t0, double t1, const Gravity& gravity) {
  check(start, "propagate");
  check(gravity);
  if (!std::isfinite(t0) || !std::isfinite(t1) || !std::isfinite(t1 - t0))
    throw std::invalid_argument(fmt::format("propagate: the times must be finite, not {} and {}", t0, t1));
}

/// log2 and exp2 to 1e-4, which is plenty for a step: exponent and a cubic in the fraction. Zeros, infinities
/// and subnormal numbers give what their bits look like, about +-1024.
double rough_log2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto exponent = static_cast<double>(static_cast<std::int64_t>(bits >> 52U & 0x7ffU) - 1023);
  const double m = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL) - 1;
  return exponent + m * (1.4208 + m * (-0.5769 + m * 0.1561));
}
double rough_exp2(double x) {
  const double bounded = std::clamp(x, -1000.0, 1000.0), whole = std::floor(bounded), m = bounded - whole;
  const double fraction = 1 + m * (0.6953 + m * (0.2263 + m * 0.0784));
  return fraction * std::bit_cast<double>(static_cast<std::int64_t>(whole + 1023) << 52U);
}

/// log2 of the step for which k |r_k| h^(k-1) is the wanted change of the velocity; its square's log2 is
/// given.
struct StepOfTerm {
  std::array<double, kernels::most + 1> twice_log2{}, half_power{};
  StepOfTerm() {
    for (int k = 2; k <= kernels::most; ++k) {
      twice_log2[static_cast<std::size_t>(k)] = 2 * std::log2(k);
      half_power[static_cast<std::size_t>(k)] = 0.5 / (k - 1);
    }
  }
  [[nodiscard]] double operator()(double wanted, double square, int k) const {
    const auto i = static_cast<std::size_t>(k);
    return (wanted - rough_log2(square) - twice_log2[i]) * half_power[i];
  }
};

/// Below it no tolerance is worth its overhead.
constexpr int least_chosen = 12;

/// Order and step of the adaptive method.
class Control {
 public:
  Control(const AnalyticContinuation& method, double cost_exponent)
      : wanted_(2 * std::log2(method.tolerance)),
        cost_exponent_(cost_exponent),
        // A circle's series converges everywhere, but like that of exp(i h): terms of the size exp(h v/r)
        // cancel, and eps of them is an error.
        most_(std::max(1.5, std::log(method.tolerance / std::numeric_limits<double>::epsilon()))),
        chooses_(method.order == 0) {
    // The step rho tol^(1/K) for work K^s is best at K = -ln(tol)/s.
    order_ = chooses_ ? bounded(static_cast<int>(std::lround(-std::log(method.tolerance) / cost_exponent)))
                      : method.order;
  }
  [[nodiscard]] int order() const { return order_; }
  /// Length of the step by the series just made; then the order of the next.
  double step(const detail::Walk& walk) {
    static const StepOfTerm of_term;
    const double speed_square = walk.speed_square(), wanted = wanted_ + rough_log2(speed_square);
    const double last = of_term(wanted, walk.square_of(order_), order_);
    const double before = of_term(wanted, walk.square_of(order_ - 1), order_ - 1);
    const int used = order_;
    if (chooses_) {
      // d ln(step)/d ln(order) against d ln(work)/d ln(order).
      const double earlier = of_term(wanted, walk.square_of(order_ - 2), order_ - 2);
      const double gain = 0.5 * std::log(2.0) * (last - earlier) * order_;
      if (gain > 1.1 * cost_exponent_) order_ = bounded(order_ + 1);
      if (gain < 0.9 * cost_exponent_) order_ = bounded(order_ - 1);
    }
    const double step = rough_exp2(std::min(last, before)),
                 // The series of a straight line ends, but that of the motion converges to |r|/|v| alone.
        most = (walk.is_fast() ? 0.5 : most_) * std::sqrt(walk.square_of(0) / speed_square);
    if (step <= most) return step;
    if (chooses_) order_ = bounded(used - 1);
    return most;
  }

 private:
  static int bounded(int order) { return std::clamp(order, least_chosen, kernels::most_unrolled); }
  double wanted_, cost_exponent_;
  double most_;  ///< longest step in units of r/|v|
  bool chooses_;
  int order_ = 0;
};

}  // namespace

Solution propagate(const State& start, double t0, double t1, const Gravity& gravity,
                   const AnalyticContinuation& method, const Observer& observer, const Limits& limits) {
  check_task(start, t0, t1, gravity);
  require_within(method.name, "tolerance", method.tolerance, 1e-18, 0.1);
  if (method.order != 0) require_within(method.name, "order", method.order, 4, kernels::most);
  require_within(method.name, "largest_step", method.largest_step, std::numeric_limits<double>::min(),
                 std::numeric_limits<double>::infinity());
  const int most_order = method.order != 0 ? method.order : kernels::most_unrolled;
  detail::Walk walk(
      start, t0, t1, gravity,
      {method.name, most_order, method.compensated, gravity.degree() == 0, true, method.instructions},
      observer, limits);
  Control control(method, walk.cost_exponent());
  const double direction = t1 < t0 ? -1 : 1;
  while (!walk.arrived()) {
    const int order = control.order();
    walk.expand(order);
    double h = control.step(walk);
    if (walk.in_time(h) > method.largest_step) h *= method.largest_step / walk.in_time(h);
    if (walk.is_lost(h)) return walk.result(walk.lost(direction * h));
    const double remaining = std::abs(walk.remaining());
    const bool last = h >= remaining;
    const double taken = direction * (last ? remaining : 2 * h > remaining ? remaining / 2 : h);
    walk.advance(taken, order, order - 1);
    if (Status status = walk.finish(taken, last); !status.ok()) return walk.result(std::move(status));
    walk.follow_units(h);
  }
  return walk.result({});
}

Solution propagate(const State& start, double t0, double t1, const Gravity& gravity,
                   const FixedContinuation& method, const Observer& observer, const Limits& limits) {
  check_task(start, t0, t1, gravity);
  require_within(method.name, "step", method.step, std::numeric_limits<double>::min(),
                 std::numeric_limits<double>::max());
  require_within(method.name, "order", method.order, 2, kernels::most);
  const int velocity_degree = method.velocity_degree != 0 ? method.velocity_degree : method.order - 1;
  require_within(method.name, "velocity_degree", velocity_degree, 1, kernels::most - 1);
  const int order = std::max(method.order, velocity_degree + 1);
  detail::Walk walk(start, t0, t1, gravity,
                    {method.name, order, method.compensated, gravity.degree() == 0 && method.true_division,
                     method.true_division, method.instructions},
                    observer, limits);
  const double direction = t1 < t0 ? -1 : 1;
  while (!walk.arrived()) {
    const double h = method.step / walk.in_time(1), remaining = std::abs(walk.remaining());
    if (walk.is_lost(h)) return walk.result(walk.lost(direction * h));
    // An interval of n steps, rounded, is n steps.
    const bool last = h * (1 + 1e-9) >= remaining;
    const double taken = direction * (last ? remaining : h);
    walk.expand(order);
    walk.advance(taken, method.order, velocity_degree);
    if (Status status = walk.finish(taken, last); !status.ok()) return walk.result(std::move(status));
    walk.follow_units(h);
  }
  return walk.result({});
}

}  // namespace nlmech::orbit

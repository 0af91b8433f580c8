#include "nlmech/orbit/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/kernels/kernel.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

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

/// Settings common to both methods.
struct Settings {
  std::string_view name;                       ///< name of the method, for messages
  int most_order;                              ///< largest degree used
  bool compensated;                            ///< compensated summation
  bool kernel;                                 ///< may the unrolled kernels be used?
  bool true_division;                          ///< see FixedContinuation
  std::optional<InstructionSet> instructions;  ///< instruction set of the kernels
};

/// State, time and series of one propagation. All numbers are in units 2^a of length and 2^b of time, which
/// are adapted where the time scale of the body changes much; powers of two cause no rounding.
class Propagation : public BasicDenseOutput<State> {
 public:
  Propagation(const State& start, double t0, double t1, const Gravity& gravity, const Settings& options,
              const Observer& observer, const Limits& limits);

  /// Computes the series about the state, to degree @p order.
  void expand(int order);
  /// Advances by @p h in scaled units, with the series of position and velocity to these degrees.
  void advance(double h, int position_degree, int velocity_degree);
  /// Ends the step: time, observer, limits. @p h in scaled units.
  [[nodiscard]] Status finish(double h, bool last);
  /// Step size in units of the user.
  [[nodiscard]] double in_time(double h) const { return h * time_unit_; }
  /// Signed remaining time in scaled units.
  [[nodiscard]] double remaining() const { return ((t1_ - t_) - t_low_) / time_unit_; }
  /// Is a step this short lost in the time?
  [[nodiscard]] bool is_lost(double h) const {
    const double scale = std::max({std::abs(t_), std::abs(t1_), std::abs(t1_ - t0_)});
    return !(std::abs(in_time(h)) > std::numeric_limits<double>::epsilon() * scale);
  }
  /// Failure for a lost step: a collision if the body falls into the centre.
  [[nodiscard]] Status lost(double h) const;
  /// |k r_k|^2, the square of a coefficient of the velocity, of the latest series; k positive.
  [[nodiscard]] double rate_square(int k) const;
  /// Square of the larger of |v| and the circular speed.
  [[nodiscard]] double speed_square() const { return speed_square_; }
  /// |r|
  [[nodiscard]] double distance() const { return distance_; }
  /// Is the body so fast that gravity hardly affects the series? Then the series does not show its
  /// convergence.
  [[nodiscard]] bool is_fast() const { return speed_square_ > 1e3 * (mu_ / distance_); }
  /// Chooses new units if the last step size @p h is far from 1.
  void follow_units(double h) {
    if (!(std::abs(h) < most_drift && std::abs(h) > 1 / most_drift)) choose_units();
  }
  /// Exponent of the cost as a power of the order: d ln(work)/d ln(order).
  [[nodiscard]] double cost_exponent() const;
  /// Has it arrived?
  [[nodiscard]] bool arrived() const { return t_ == t1_; }
  /// The result.
  [[nodiscard]] Solution result(Status status) const;

  /// State by the latest series; also beyond the step, as far as it converges.
  void at(double t, State& x) const override;

 private:
  /// Its 200th power, in the square of the last coefficient, does not overflow.
  static constexpr double most_drift = 16;

  static double square(const double* x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }
  void choose_units();
  /// high + low + change, exact to the rounding of low + change (Knuth's two-sum).
  void add(double change, double& high, double& low) const {
    const double b = low + change, sum = high + b, virtual_b = sum - high;
    low = options_.compensated ? (high - (sum - virtual_b)) + (b - virtual_b) : 0;
    high = sum;
  }
  [[nodiscard]] bool unrolled(int order) const;
  [[nodiscard]] State user_state() const;

  Settings options_;
  const Observer& observer_;
  const Limits& limits_;
  Gravity gravity_;  ///< in units of the user
  const kernels::Kernel* kernel_;
  kernels::Body body_{};
  kernels::Body origin_{};    ///< state about which the series was expanded
  kernels::Series series_{};  ///< of the kernels
  double distance_ = 0, speed_square_ = 0;
  std::optional<Expansion<double>> expansion_;  ///< series of other cases; constructed at first use
  double t_, t_low_ = 0, t1_, t0_, start_radius_;
  int length_exponent_ = 0, time_exponent_ = 0;
  double length_unit_ = 1, time_unit_ = 1, mu_ = 1;
  int order_ = 0, position_degree_ = 0, velocity_degree_ = 0;
  double step_begin_ = 0;
  State before_;
  Statistics statistics_;
  Stopwatch watch_;
};

const kernels::Kernel& kernel_for(InstructionSet set) {
  require_available(set);
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return kernels::avx512_kernel;
  if (set == InstructionSet::avx2) return kernels::avx2_kernel;
#endif
  return kernels::baseline_kernel;
}

void times_power_of_two(double* x, int exponent) {
  for (int i = 0; i < 3; ++i) x[i] = std::ldexp(x[i], exponent);
}

Propagation::Propagation(const State& start, double t0, double t1, const Gravity& gravity,
                         const Settings& options, const Observer& observer, const Limits& limits)
    : options_(options),
      observer_(observer),
      limits_(limits),
      gravity_(gravity),
      kernel_(&kernel_for(options.instructions.value_or(best_instruction_set()))),
      t_(t0),
      t1_(t1),
      t0_(t0),
      start_radius_(start.position.stableNorm()) {
  for (int i = 0; i < 3; ++i) {
    body_.position[i] = start.position[i];
    body_.velocity[i] = start.velocity[i];
  }
  mu_ = gravity.mu;
  choose_units();
}

void Propagation::choose_units() {
  const double r = Vector3<double>(body_.position[0], body_.position[1], body_.position[2]).stableNorm();
  const int length = std::ilogb(r);
  // The smaller of (r^3/mu)^(1/2) and r/|v|, in scaled units; exponents are added as integers, which cannot
  // overflow.
  const double v = Vector3<double>(body_.velocity[0], body_.velocity[1], body_.velocity[2]).stableNorm();
  int time = (3 * length - std::ilogb(mu_)) / 2;
  if (v > 0) time = std::min(time, length - std::ilogb(v));
  length_exponent_ += length;
  time_exponent_ += time;
  for (double* x : {body_.position, body_.position_low}) times_power_of_two(x, -length);
  for (double* x : {body_.velocity, body_.velocity_low}) times_power_of_two(x, time - length);
  length_unit_ = std::ldexp(1, length_exponent_);
  time_unit_ = std::ldexp(1, time_exponent_);
  mu_ = std::ldexp(gravity_.mu, 2 * time_exponent_ - 3 * length_exponent_);
  if (expansion_) expansion_->set_units(mu_, gravity_.radius / length_unit_);
}

bool Propagation::unrolled(int order) const {
  return options_.kernel && order >= kernels::least_unrolled && order <= kernels::most_unrolled;
}

// Measured for loops, the baseline kernel, and the kernels with fused multiply-add.
double Propagation::cost_exponent() const {
  if (!options_.kernel) return 1.8;
  return kernel_ == &kernels::baseline_kernel ? 1.2 : 0.9;
}

void Propagation::expand(int order) {
  order_ = order;
  origin_ = body_;
  distance_ = std::sqrt(square(body_.position));
  speed_square_ = std::max(square(body_.velocity), mu_ / distance_);
  if (unrolled(order)) return kernel_->expand(mu_, order, body_, series_);
  if (!expansion_) {
    Gravity scaled = gravity_;
    scaled.mu = mu_;
    scaled.radius = gravity_.radius / length_unit_;
    expansion_.emplace(scaled, options_.most_order, options_.true_division);
  }
  expansion_->expand({{body_.position[0], body_.position[1], body_.position[2]},
                      {body_.velocity[0], body_.velocity[1], body_.velocity[2]}},
                     order);
}

double Propagation::rate_square(int k) const {
  double rate[3];
  if (unrolled(order_)) {
    const double* const d = &series_.rate[k / 2][k % 2 == 0 ? 0 : 2];
    for (int i = 0; i < 3; ++i) rate[i] = d[0] * series_.first[i] + d[1] * series_.second[i];
  } else {
    const Vector3<double> c = expansion_->coefficient(k);
    for (int i = 0; i < 3; ++i) rate[i] = k * c[i];
  }
  return square(rate);
}

void Propagation::advance(double h, int position_degree, int velocity_degree) {
  if (observer_) before_ = user_state();
  position_degree_ = position_degree;
  velocity_degree_ = velocity_degree;
  if (unrolled(order_)) return kernel_->advance(series_, order_, h, options_.compensated, body_);
  const State change = expansion_->increments(h, position_degree, velocity_degree);
  for (int i = 0; i < 3; ++i) {
    add(change.position[i], body_.position[i], body_.position_low[i]);
    add(change.velocity[i], body_.velocity[i], body_.velocity_low[i]);
  }
}

Status Propagation::finish(double h, bool last) {
  step_begin_ = t_;
  if (last) {
    t_ = t1_;
    t_low_ = 0;
  } else {
    const double change = t_low_ + in_time(h), sum = t_ + change, part = sum - t_;
    t_low_ = (t_ - (sum - part)) + (change - part);
    t_ = sum;
  }
  ++statistics_.steps;
  statistics_.right_hand_sides += position_degree_;
  if (!std::isfinite(square(body_.position) + square(body_.velocity))) {
    return failed_with(Outcome::non_finite,
                       "{}: the step of {:.6g} from t = {:.17g} leads to a state that is not finite; take a "
                       "shorter step or a smaller tolerance",
                       options_.name, in_time(h), step_begin_);
  }
  if (observer_) {
    const State after = user_state();
    const std::span states(&after, 1);
    if (!observer_({statistics_.steps, step_begin_, t_, before_, after, std::span(&t_, 1), states, *this})) {
      return failed_with(Outcome::interrupted, "{}: stopped by the observer at t = {:.17g}", options_.name,
                         t_);
    }
  }
  if (last) return {};
  if (statistics_.steps >= limits_.steps) {
    return failed_with(Outcome::step_limit,
                       "{}: {} steps were used up at t = {:.17g}; allow more, or a larger tolerance",
                       options_.name, limits_.steps, t_);
  }
  if (std::isfinite(limits_.seconds) && watch_.seconds() > limits_.seconds) {
    return failed_with(Outcome::time_limit,
                       "{}: {} seconds were used up at t = {:.17g}; allow more, or a larger tolerance",
                       options_.name, limits_.seconds, t_);
  }
  return {};
}

Status Propagation::lost(double h) const {
  const double r = std::sqrt(square(body_.position)) * length_unit_;
  double inwards = 0;
  for (int i = 0; i < 3; ++i) inwards -= body_.position[i] * body_.velocity[i];
  if (inwards * h > 0 && r < 1e-6 * start_radius_) {
    return failed_with(Outcome::collision,
                       "{}: the body falls into the centre of attraction at t = {:.17g}{}", options_.name, t_,
                       gravity_.degree() > 0 ? ", where the zonal field has no bound; end before that time"
                                             : "; Kepler's solution (method kepler) goes through, a series "
                                               "cannot");
  }
  return failed_with(
      Outcome::step_underflow,
      "{}: at t = {:.17g} the step {:.3g} is lost in the asked interval, at the distance {:.6g}{}",
      options_.name, t_, in_time(h), r,
      gravity_.degree() > 0 ? "; end earlier" : "; Kepler's solution (method kepler) needs no steps");
}

State Propagation::user_state() const {
  State s;
  for (int i = 0; i < 3; ++i) {
    s.position[i] = std::ldexp(body_.position[i], length_exponent_);
    s.velocity[i] = std::ldexp(body_.velocity[i], length_exponent_ - time_exponent_);
  }
  return s;
}

void Propagation::at(double t, State& x) const {
  const double h = (t - step_begin_) / time_unit_;
  State change;
  if (unrolled(order_)) {
    double position[4], velocity[4];
    kernel_->increments(series_, order_, h, position, velocity);
    change = {{position[0], position[1], position[2]}, {velocity[0], velocity[1], velocity[2]}};
  } else {
    change = expansion_->increments(h, position_degree_, velocity_degree_);
  }
  for (int i = 0; i < 3; ++i) {
    x.position[i] = std::ldexp(origin_.position[i] + change.position[i], length_exponent_);
    x.velocity[i] = std::ldexp(origin_.velocity[i] + change.velocity[i], length_exponent_ - time_exponent_);
  }
}

Solution Propagation::result(Status status) const {
  Solution c{t_, user_state(), std::move(status), statistics_};
  if (c.status.outcome() == Outcome::non_finite) {
    // Return the last good state, about which the series was expanded.
    c.t = step_begin_;
    for (int i = 0; i < 3; ++i) {
      c.x.position[i] = std::ldexp(origin_.position[i], length_exponent_);
      c.x.velocity[i] = std::ldexp(origin_.velocity[i], length_exponent_ - time_exponent_);
    }
  }
  c.statistics.seconds = watch_.seconds();
  return c;
}

/// log2 and exp2 to 1e-4, enough for step-size control: exponent and a cubic in the fraction. Zeros,
/// infinities and subnormal numbers give values near +-1024.
double rough_log2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto exponent = static_cast<double>(static_cast<std::int64_t>(bits >> 52U & 0x7ffU) - 1023);
  const double m = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL) - 1;
  return (exponent + m * 1.4208) + (m * m) * (-0.5769 + m * 0.1561);
}
double rough_exp2(double x) {
  const double bounded = std::clamp(x, -1000.0, 1000.0);
  const double shifted = bounded + 0x1.8p52;  // the nearest integer in the last bits
  const double m = bounded - (shifted - 0x1.8p52);
  const double fraction = (0.99992 + m * 0.69314) + (m * m) * (0.24264 + m * 0.05584);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(fraction) +
                               (std::bit_cast<std::uint64_t>(shifted) << 52U));
}

/// log2 of the step size h for which k |r_k| h^(k-1) is the wanted change of the velocity; @p wanted is log2
/// of its square, @p square that of k r_k.
double step_of_term(double wanted, double square, int k) {
  return (wanted - rough_log2(square)) * (0.5 / (k - 1));
}

/// Smallest adaptive order; lower ones do not pay for their overhead at any tolerance.
constexpr int least_chosen = 12;

/// Control of order and step size of the adaptive method.
class Control {
 public:
  Control(const AnalyticContinuation& method, double cost_exponent)
      : wanted_(2 * std::log2(method.tolerance)),
        cost_exponent_(cost_exponent),
        // The series of a circle converges everywhere, but like exp(i h): terms of the size exp(h v/r)
        // cancel, with an error of eps times that size.
        most_(std::max(1.5, std::log(method.tolerance / std::numeric_limits<double>::epsilon()))),
        chooses_(method.order == 0) {
    // The step rho tol^(1/K) for work K^s is best at K = -ln(tol)/s.
    order_ = chooses_ ? bounded(static_cast<int>(std::lround(-std::log(method.tolerance) / cost_exponent)))
                      : method.order;
  }
  [[nodiscard]] int order() const { return order_; }
  /// Step size from the latest series; then chooses the order of the next.
  double step(const Propagation& motion) {
    const double speed_square = motion.speed_square(), wanted = wanted_ + rough_log2(speed_square);
    const double last = step_of_term(wanted, motion.rate_square(order_), order_);
    const double before = step_of_term(wanted, motion.rate_square(order_ - 1), order_ - 1);
    const int used = order_;
    if (chooses_) {
      // d ln(step)/d ln(order) against d ln(work)/d ln(order).
      const double earlier = step_of_term(wanted, motion.rate_square(order_ - 2), order_ - 2);
      const double gain = 0.5 * std::log(2.0) * (last - earlier) * order_;
      if (gain > 1.1 * cost_exponent_) order_ = bounded(order_ + 1);
      if (gain < 0.9 * cost_exponent_) order_ = bounded(order_ - 1);
    }
    const double step = rough_exp2(std::min(last, before)),
                 // The series of a straight line is finite, but that of the motion converges only for h <
                 // |r|/|v|.
        most = (motion.is_fast() ? 0.5 : most_) * motion.distance() / std::sqrt(speed_square);
    if (step <= most) return step;
    if (chooses_) order_ = bounded(used - 1);
    return most;
  }

 private:
  static int bounded(int order) { return std::clamp(order, least_chosen, kernels::most_unrolled); }
  double wanted_, cost_exponent_;
  double most_;  ///< largest step size in units of r/|v|
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
  Propagation motion(
      start, t0, t1, gravity,
      {method.name, most_order, method.compensated, gravity.degree() == 0, true, method.instructions},
      observer, limits);
  Control control(method, motion.cost_exponent());
  const double direction = t1 < t0 ? -1 : 1;
  while (!motion.arrived()) {
    const int order = control.order();
    motion.expand(order);
    double h = control.step(motion);
    if (motion.in_time(h) > method.largest_step) h *= method.largest_step / motion.in_time(h);
    if (motion.is_lost(h)) return motion.result(motion.lost(direction * h));
    const double remaining = std::abs(motion.remaining());
    const bool last = h >= remaining;
    const double taken = direction * (last ? remaining : 2 * h > remaining ? remaining / 2 : h);
    motion.advance(taken, order, order - 1);
    if (Status status = motion.finish(taken, last); !status.ok()) return motion.result(std::move(status));
    motion.follow_units(h);
  }
  return motion.result({});
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
  Propagation motion(start, t0, t1, gravity,
                     {method.name, order, method.compensated,
                      gravity.degree() == 0 && method.true_division && velocity_degree == method.order - 1,
                      method.true_division, method.instructions},
                     observer, limits);
  const double direction = t1 < t0 ? -1 : 1;
  while (!motion.arrived()) {
    const double h = method.step / motion.in_time(1), remaining = std::abs(motion.remaining());
    if (motion.is_lost(h)) return motion.result(motion.lost(direction * h));
    // An interval of n steps takes n steps also with rounding errors.
    const bool last = h * (1 + 1e-9) >= remaining;
    const double taken = direction * (last ? remaining : h);
    motion.expand(order);
    motion.advance(taken, method.order, velocity_degree);
    if (Status status = motion.finish(taken, last); !status.ok()) return motion.result(std::move(status));
    motion.follow_units(h);
  }
  return motion.result({});
}

}  // namespace nlmech::orbit

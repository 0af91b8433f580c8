#include "nlmech/orbit/walk.hpp"

#include <algorithm>
#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit::detail {
namespace {

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

}  // namespace

Walk::Walk(const State& start, double t0, double t1, const Gravity& gravity, const WalkOptions& options,
           const Observer& observer, const Limits& limits)
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

void Walk::choose_units() {
  const double r = Vector3<double>(body_.position[0], body_.position[1], body_.position[2]).stableNorm();
  const int length = std::ilogb(r);
  // The shorter of (r^3/mu)^(1/2) and r/|v|, in units of the walk; the exponents are added in integers, which
  // cannot overflow.
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

bool Walk::unrolled(int order) const {
  return options_.kernel && order >= kernels::least_unrolled && order <= kernels::most_unrolled;
}

// By code path: loops, the baseline kernel, the kernels with fused multiply-adds.
double Walk::cost_exponent() const {
  if (!options_.kernel) return 1.8;
  return kernel_ == &kernels::baseline_kernel ? 1.4 : 1.0;
}

void Walk::expand(int order) {
  order_ = order;
  if (unrolled(order)) {
    std::copy_n(body_.position, 4, series_.row[0]);
    std::copy_n(body_.velocity, 4, series_.row[1]);
    kernel_->expand(mu_, order, series_);
    return;
  }
  if (!expansion_) {
    Gravity scaled = gravity_;
    scaled.mu = mu_;
    scaled.radius = gravity_.radius / length_unit_;
    expansion_.emplace(scaled, options_.most_order, options_.true_division);
  }
  expansion_->expand({{body_.position[0], body_.position[1], body_.position[2]},
                      {body_.velocity[0], body_.velocity[1], body_.velocity[2]}},
                     order);
  for (int k = 0; k <= order; ++k) {
    const Vector3<double> c = expansion_->coefficient(k);
    for (int i = 0; i < 3; ++i) series_.row[k][i] = c[i];
    series_.row[k][3] = 0;
  }
}

void Walk::advance(double h, int position_degree, int velocity_degree) {
  if (observer_) before_ = user_state();
  position_degree_ = position_degree;
  velocity_degree_ = velocity_degree;
  if (velocity_degree == position_degree - 1) {
    kernel_->advance(series_, position_degree, h, options_.compensated, body_);
    return;
  }
  // Positions first; then back to the velocities of before, with a series of their own.
  kernels::Body other = body_;
  kernel_->advance(series_, position_degree, h, options_.compensated, body_);
  kernel_->advance(series_, velocity_degree + 1, h, options_.compensated, other);
  std::copy_n(other.velocity, 4, body_.velocity);
  std::copy_n(other.velocity_low, 4, body_.velocity_low);
}

Status Walk::finish(double h, bool last) {
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

Status Walk::lost(double h) const {
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
  return failed_with(Outcome::step_underflow,
                     "{}: at t = {:.17g} the step {:.3g} is lost in the time; the distance {:.6g} is too "
                     "small for the asked interval",
                     options_.name, t_, in_time(h), r);
}

State Walk::user_state() const {
  State s;
  for (int i = 0; i < 3; ++i) {
    s.position[i] = std::ldexp(body_.position[i], length_exponent_);
    s.velocity[i] = std::ldexp(body_.velocity[i], length_exponent_ - time_exponent_);
  }
  return s;
}

void Walk::at(double t, State& x) const {
  const double h = (t - step_begin_) / time_unit_;
  double position[4], velocity[4], unused[4];
  kernel_->increments(series_, position_degree_, h, position, velocity);
  if (velocity_degree_ != position_degree_ - 1)
    kernel_->increments(series_, velocity_degree_ + 1, h, unused, velocity);
  for (int i = 0; i < 3; ++i) {
    x.position[i] = std::ldexp(series_.row[0][i] + position[i], length_exponent_);
    x.velocity[i] = std::ldexp(series_.row[1][i] + velocity[i], length_exponent_ - time_exponent_);
  }
}

Solution Walk::result(Status status) const {
  Solution c{t_, user_state(), std::move(status), statistics_};
  if (c.status.outcome() == Outcome::non_finite) {
    // The last good step: the one that the series starts from.
    c.t = step_begin_;
    for (int i = 0; i < 3; ++i) {
      c.x.position[i] = std::ldexp(series_.row[0][i], length_exponent_);
      c.x.velocity[i] = std::ldexp(series_.row[1][i], length_exponent_ - time_exponent_);
    }
  }
  c.statistics.seconds = watch_.seconds();
  return c;
}

}  // namespace nlmech::orbit::detail

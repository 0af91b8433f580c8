#include "nlmech/orbit/lanes.hpp"

#include <algorithm>
#include <limits>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit::detail {
namespace {

constexpr double never = 1e300;  // a time to go that no step changes, and with which lanes can count

Vector3<double> vector_at(const kernels::Row* rows, int lane) {
  return {rows[0].lane[lane], rows[1].lane[lane], rows[2].lane[lane]};
}

void put(kernels::Row* rows, int lane, const Vector3<double>& v) {
  for (int i = 0; i < 3; ++i) rows[i].lane[lane] = v[i];
}

void scale(kernels::Row& row, int lane, int exponent) {
  row.lane[lane] = std::ldexp(row.lane[lane], exponent);
}

}  // namespace

Lanes::Lanes(const kernels::EnsembleKernel& kernel, const kernels::LaneSettings& settings,
             const InnerRows& rows, std::int64_t limit)
    : kernel_(kernel), settings_(settings), rows_(rows), limit_(limit) {
  for (int i = 0; i < kernels::most_lanes; ++i) idle(i);
}

/// A circle that never ends: it disturbs nobody.
void Lanes::idle(int lane) {
  lanes_[static_cast<std::size_t>(lane)] = {};
  put(block_.position, lane, {1, 0, 0});
  put(block_.velocity, lane, {0, 1, 0});
  put(block_.position_low, lane, {0, 0, 0});
  put(block_.velocity_low, lane, {0, 0, 0});
  block_.mu.lane[lane] = 1;
  block_.remaining.lane[lane] = block_.next_row.lane[lane] = never;
  block_.remaining_low.lane[lane] = block_.least_step.lane[lane] = 0;
}

void Lanes::take_in(std::size_t number, const Flight& flight) {
  const auto place =
      std::find_if(lanes_.begin(), lanes_.begin() + kernel_.lanes, [](const Lane& l) { return !l.busy; });
  const int i = static_cast<int>(place - lanes_.begin());
  Lane& lane = *place;
  lane = {.busy = true,
          .backwards = flight.until < 0,
          .number = number,
          .mu = flight.gravity.mu,
          .until = std::abs(flight.until),
          .start_radius = flight.start.position.stableNorm(),
          .first_step = steps_};
  ++busy_;
  put(block_.position, i, flight.start.position);
  put(block_.velocity, i, lane.backwards ? Vector3<double>(-flight.start.velocity) : flight.start.velocity);
  put(block_.position_low, i, {0, 0, 0});
  put(block_.velocity_low, i, {0, 0, 0});
  block_.remaining.lane[i] = lane.until;
  block_.remaining_low.lane[i] = 0;
  choose_units(i);
}

/// The shorter of (r^3/mu)^(1/2) and r/|v| becomes a time near 1, as in Walk.
void Lanes::choose_units(int i) {
  Lane& lane = lanes_[static_cast<std::size_t>(i)];
  const double v = vector_at(block_.velocity, i).stableNorm();
  const int length = std::ilogb(vector_at(block_.position, i).stableNorm());
  const double mu = std::ldexp(lane.mu, 2 * lane.time - 3 * lane.length);
  int time = (3 * length - std::ilogb(mu)) / 2;
  if (v > 0) time = std::min(time, length - std::ilogb(v));
  // What remains must stay a number, so that a flight that cannot go on knows its time.
  time = std::max(time, std::ilogb(lane.until) - 1000 - lane.time);
  for (int k = 0; k < 3; ++k) {
    for (kernels::Row* rows : {block_.position, block_.position_low}) scale(rows[k], i, -length);
    for (kernels::Row* rows : {block_.velocity, block_.velocity_low}) scale(rows[k], i, time - length);
  }
  for (kernels::Row* row : {&block_.remaining, &block_.remaining_low}) scale(*row, i, -time);
  lane.length += length;
  lane.time += time;
  block_.mu.lane[i] = std::ldexp(lane.mu, 2 * lane.time - 3 * lane.length);
  block_.least_step.lane[i] = std::ldexp(eps * lane.until, -lane.time);
  await_row(i);
}

/// From now to the time @p t, in the lane's units.
double Lanes::row_after_now(const Lane& lane, int i, double t) const {
  // until - t as a sum of two, exact; what remains is one already.
  const double rest = lane.until - t, back = rest - lane.until,
               error = (lane.until - (rest - back)) - (t + back);
  return (block_.remaining.lane[i] - std::ldexp(rest, -lane.time)) +
         (block_.remaining_low.lane[i] - std::ldexp(error, -lane.time));
}

void Lanes::await_row(int i) {
  const Lane& lane = lanes_[static_cast<std::size_t>(i)];
  const double t = static_cast<double>(lane.next_row) * rows_.every;
  // The end has its own row; rounding of k DT makes no second one.
  block_.next_row.lane[i] = lane.until - t > 1e-9 * rows_.every ? row_after_now(lane, i, t) : never;
}

void Lanes::give_rows(int i, double taken) {
  Lane& lane = lanes_[static_cast<std::size_t>(i)];
  const Vector3<double> r = vector_at(block_.first_position, i), v = vector_at(block_.first_velocity, i);
  const double mu = block_.mu.lane[i], distance = r.norm(), along = r.dot(v);
  const double gamma = distance * v.dot(v) - mu;
  for (;; ++lane.next_row) {
    const double t = static_cast<double>(lane.next_row) * rows_.every, after = row_after_now(lane, i, t);
    if (!(after <= 0 && lane.until - t > 1e-9 * rows_.every)) break;
    const double h = taken + after;
    double one = 0, two = 0;
    for (int k = settings_.order; k > 0; --k) {
      one = (one + block_.first[k].lane[i]) * h;
      two = (two + block_.second[k].lane[i]) * h;
    }
    const double there = distance + (along * one + gamma * two), g = distance * one + along * two;
    const State own{r - (mu / distance * two * r - g * v), v - mu / there * (one / distance * r + two * v)};
    rows_.sink(lane.number, lane.backwards ? -t : t, users(lane, own));
  }
  await_row(i);
}

State Lanes::users(const Lane& lane, State own) const {
  if (lane.backwards) own.velocity = -own.velocity;
  for (int k = 0; k < 3; ++k) {
    own.position[k] = std::ldexp(own.position[k], lane.length);
    own.velocity[k] = std::ldexp(own.velocity[k], lane.length - lane.time);
  }
  return own;
}

State Lanes::state(int i) const {
  return users(lanes_[static_cast<std::size_t>(i)],
               {vector_at(block_.position, i), vector_at(block_.velocity, i)});
}

double Lanes::time_of(int i) const {
  const Lane& lane = lanes_[static_cast<std::size_t>(i)];
  const double t =
      lane.until - std::ldexp(block_.remaining.lane[i] + block_.remaining_low.lane[i], lane.time);
  return lane.backwards ? -t : t;
}

Status Lanes::lost(int i) const {
  const Lane& lane = lanes_[static_cast<std::size_t>(i)];
  const State own{vector_at(block_.position, i), vector_at(block_.velocity, i)};
  const double r = std::ldexp(own.position.stableNorm(), lane.length), h = block_.chosen.lane[i];
  if (own.position.dot(own.velocity) < 0 && r < 1e-6 * lane.start_radius) {
    return failed_with(Outcome::collision,
                       "{}: the body falls into the centre of attraction at t = {:.17g}; Kepler's solution "
                       "(method kepler) goes through, a series cannot",
                       TaylorEnsemble::name, time_of(i));
  }
  if (h > block_.least_step.lane[i]) {
    return failed_with(Outcome::non_finite,
                       "{}: the step of {:.6g} from t = {:.17g} leads to a state that is not finite; take a "
                       "smaller tolerance",
                       TaylorEnsemble::name, std::ldexp(h, lane.time), time_of(i));
  }
  return failed_with(Outcome::step_underflow,
                     "{}: at t = {:.17g} the step {:.3g} is lost in the time; the distance {:.6g} is too "
                     "small for the asked interval",
                     TaylorEnsemble::name, time_of(i), std::ldexp(h, lane.time), r);
}

void Lanes::end(int i, Status status, std::vector<Solution>& solutions) {
  const Lane& lane = lanes_[static_cast<std::size_t>(i)];
  Solution& solution = solutions[lane.number];
  solution.t = time_of(i);
  solution.x = state(i);
  solution.statistics.steps = steps_ - lane.first_step;
  solution.statistics.right_hand_sides = solution.statistics.steps * settings_.order;
  solution.status = std::move(status);
  if (solution.status.ok() && !(solution.x.position.allFinite() && solution.x.velocity.allFinite())) {
    solution.status = failed_with(Outcome::non_finite,
                                  "{}: the state at t = {:.17g} is beyond the range of doubles; choose other "
                                  "units",
                                  TaylorEnsemble::name, solution.t);
  }
  idle(i);
  --busy_;
}

void Lanes::run(std::vector<Solution>& solutions) {
  std::int64_t most = 4096;  // then its caller looks at the clock
  for (int i = 0; i < kernel_.lanes; ++i) {
    const Lane& lane = lanes_[static_cast<std::size_t>(i)];
    if (lane.busy) most = std::min(most, limit_ - (steps_ - lane.first_step));
  }
  const kernels::LaneEvents events = kernel_.steps(block_, settings_, most);
  steps_ += events.steps;
  for (int i = 0; i < kernel_.lanes; ++i) {
    const unsigned bit = 1U << static_cast<unsigned>(i);
    Lane& lane = lanes_[static_cast<std::size_t>(i)];
    if (!lane.busy) continue;
    if ((events.row_due & bit) != 0) give_rows(i, block_.step.lane[i]);
    if ((events.lost & bit) != 0) {
      Status status = lost(i);
      end(i, std::move(status), solutions);
    } else if ((events.arrived & bit) != 0) {
      end(i, {}, solutions);
    } else if (steps_ - lane.first_step >= limit_) {
      end(i,
          failed_with(Outcome::step_limit,
                      "{}: {} steps were used up at t = {:.17g}; allow more, or a larger tolerance",
                      TaylorEnsemble::name, limit_, time_of(i)),
          solutions);
    } else if ((events.drifted & bit) != 0) {
      choose_units(i);
    }
  }
}

void Lanes::stop(const Status& status, std::vector<Solution>& solutions) {
  for (int i = 0; i < kernel_.lanes; ++i) {
    if (lanes_[static_cast<std::size_t>(i)].busy) end(i, status, solutions);
  }
}

}  // namespace nlmech::orbit::detail

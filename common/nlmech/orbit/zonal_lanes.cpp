#include "nlmech/orbit/zonal_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>

#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/orbit/acceleration.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/support/doubles.hpp"

namespace nlmech::orbit::detail {
namespace {

/// dr/dt = v, dv/dt = acceleration(r).
struct Motion {
  static constexpr int dimension = 6;
  Gravity gravity;

  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    const Vector3<T> a = acceleration<T>({x[0], x[1], x[2]}, gravity);
    for (int i = 0; i < 3; ++i) {
      dxdt[i] = x[i + 3];
      dxdt[i + 3] = a[i];
    }
  }
};

/// A flight in its own units, in which |r| and mu are near 1 at the start.
class Leg {
 public:
  Leg(std::size_t number, const Flight& flight, const InnerRows& rows,
      const std::function<bool()>& out_of_time)
      : number_(number),
        flight_(flight),
        rows_(rows),
        out_of_time_(out_of_time),
        units_(extent(flight.start.position), flight.gravity.mu),
        end_(std::min(std::ldexp(std::abs(flight.until), -units_.time), std::numeric_limits<double>::max())),
        system_(Motion{own(flight.gravity)}) {}
  Leg(const Leg&) = delete;
  Leg& operator=(const Leg&) = delete;

  /// What is to be integrated; refers to this.
  [[nodiscard]] ivp::Start start(std::int64_t steps) {
    const State s = units_.own(flight_.start);
    ivp::Start start{&system_, ivp::State(6), 0, std::copysign(end_, flight_.until), {}, {.steps = steps}};
    start.x0 << s.position, s.velocity;
    start.observer = [this](const ivp::Step& step) { return see(step); };
    return start;
  }
  /// In the user's units.
  [[nodiscard]] Solution users(const ivp::Solution& end) const {
    return {end.status.ok() ? flight_.until : std::ldexp(end.t, units_.time), users(end.x), end.status,
            end.statistics};
  }

 private:
  [[nodiscard]] Gravity own(Gravity gravity) const {
    gravity.mu = units_.own_mu(gravity.mu);
    gravity.radius = std::ldexp(gravity.radius, -units_.length);
    return gravity;
  }
  [[nodiscard]] State users(const ivp::State& x) const { return units_.users({x.head<3>(), x.tail<3>()}); }
  /// @return may the flight go on?
  bool see(const ivp::Step& step) {
    if (rows_.sink) give_rows(step);
    constexpr int clock_every = 64;  // a clock that is read at every step would cost as much as the step
    if (steps_++ % clock_every == 0 && out_of_time_()) return false;
    // Towards the end a step is what remains, or half of it, and may be short.
    const double length = std::abs(step.t1 - step.t0), rest = end_ - std::abs(step.t1);
    return length > eps * end_ || rest <= 2 * length;
  }
  /// The rows within a step, but none so near the end that rounding alone parts them.
  void give_rows(const ivp::Step& step) {
    const double sign = flight_.until < 0 ? -1 : 1, until = std::abs(flight_.until);
    for (;; ++next_row_) {
      const double t = static_cast<double>(next_row_) * rows_.every, there = std::ldexp(t, -units_.time);
      if (!(there <= std::abs(step.t1) && until - t > 1e-9 * rows_.every)) return;
      rows_.sink(number_, sign * t, users(step.at(sign * there)));
    }
  }

  std::size_t number_;
  const Flight& flight_;
  const InnerRows& rows_;
  const std::function<bool()>& out_of_time_;
  PowerUnits units_;
  /// Of the time, without its sign, in own units; bounded, since the walk needs a number: every step is lost
  /// in the largest one.
  double end_;
  ivp::System system_;
  std::int64_t next_row_ = 1, steps_ = 0;
};

}  // namespace

void fly_in_zonal_fields(std::span<const Flight> flights, const std::vector<std::size_t>& which,
                         const TaylorEnsemble& method, const InnerRows& rows, std::int64_t steps,
                         const std::function<bool()>& out_of_time, std::vector<Solution>& solutions) {
  std::deque<Leg> legs;
  std::vector<ivp::Start> starts;
  for (const std::size_t number : which)
    starts.push_back(legs.emplace_back(number, flights[number], rows, out_of_time).start(steps));
  // Position and velocity are near 1 at the start; a small absolute part lets a component pass through 0.
  const ivp::Series series{.relative_tolerance = method.tolerance,
                           .absolute_tolerance = method.tolerance / 32,
                           .order = method.order};
  const auto ends = ivp::integrate_all(std::span<const ivp::Start>(starts), series, method.threads,
                                       method.instructions.value_or(best_instruction_set()));
  for (std::size_t i = 0; i < which.size(); ++i) solutions[which[i]] = legs[i].users(ends[i]);
}

}  // namespace nlmech::orbit::detail

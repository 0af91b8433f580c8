#include "nlmech/orbit/ensemble.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <stdexcept>

#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/kernels/kernel.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::orbit {
namespace {

const kernels::EnsembleKernel& ensemble_kernel_for(InstructionSet set) {
  require_available(set);
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return kernels::avx512_ensemble;
  if (set == InstructionSet::avx2) return kernels::avx2_ensemble;
#endif
  return kernels::baseline_ensemble;
}

/// Order of least time for orbits of e = 0.1, 0.5 and 0.9, measured for tolerances from 1e-6 to 1e-17 with
/// AVX-512 and AVX2: 20, 21, 22, 24, 28 and 30 at 1e-8, -9, -10, -12, -15 and -17. A neighbouring order costs
/// 1 or 2 percent more.
int order_for(double tolerance) {
  const auto half = static_cast<int>(std::lround((9.8 - 0.52 * std::log(tolerance)) / 2));
  return 2 * std::clamp(half, 6, kernels::most_ensemble_order / 2);
}

kernels::LaneSettings settings_of(const TaylorEnsemble& m) {
  kernels::LaneSettings s;
  s.order = m.order != 0 ? m.order : order_for(m.tolerance);
  s.wanted = 2 * std::log2(m.tolerance);
  s.longest = std::log2(std::max(1.5, std::log(m.tolerance / eps)));  // as in AnalyticContinuation
  s.last_weight = 2 * std::log2(s.order);
  s.last_power = 0.5 / (s.order - 1);
  s.before_weight = 2 * std::log2(s.order - 1);
  s.before_power = 0.5 / (s.order - 2);
  return s;
}

void check_options(const TaylorEnsemble& m, const InnerRows& rows) {
  if (!(m.tolerance >= 1e-18 && m.tolerance <= 0.1))
    throw invalid_argument("{}: tolerance must be from 1e-18 to 0.1, not {:g}", m.name, m.tolerance);
  if (m.order != 0 &&
      (m.order % 2 != 0 || m.order < kernels::least_ensemble_order || m.order > kernels::most_ensemble_order))
    throw invalid_argument("{}: order must be even, from {} to {}, not {}", m.name,
                           kernels::least_ensemble_order, kernels::most_ensemble_order, m.order);
  if (m.threads < 0 || m.threads > 1024)
    throw invalid_argument("{}: threads must be from 0 to 1024, not {}", m.name, m.threads);
  if (!(rows.every > 0)) throw invalid_argument("{}: every must be positive, not {:g}", m.name, rows.every);
}

/// Failure of an orbit with an invalid start, field or end time; else success.
Status refusal(const PropagationRequest& request) {
  try {
    check(request.start, "propagate_all");
    check(request.gravity);
  } catch (const std::invalid_argument& error) {
    const bool finite = request.start.position.allFinite() && request.start.velocity.allFinite();
    const bool centre = finite && request.start.position.isZero(0);
    return Status::failure(!finite  ? Outcome::non_finite
                           : centre ? Outcome::collision
                                    : Outcome::outside_validity,
                           error.what());
  }
  if (!std::isfinite(request.until))
    return failed_with(Outcome::non_finite, "propagate_all: the end time must be finite, not {}",
                       request.until);
  return {};
}

constexpr double never = 1e300;  // remaining time of an idle lane: finite, and not changed by any step

Vector3<double> vector_at(const kernels::Row* rows, int lane) {
  return {rows[0].lane[lane], rows[1].lane[lane], rows[2].lane[lane]};
}

void put(kernels::Row* rows, int lane, const Vector3<double>& v) {
  for (int i = 0; i < 3; ++i) rows[i].lane[lane] = v[i];
}

void scale(kernels::Row& row, int lane, int exponent) {
  row.lane[lane] = std::ldexp(row.lane[lane], exponent);
}

/// The lanes of one thread, each with an orbit or idle.
class Lanes {
 public:
  /// @param limit limit of steps of an orbit
  Lanes(const kernels::EnsembleKernel& kernel, const kernels::LaneSettings& settings, const InnerRows& rows,
        std::int64_t limit)
      : kernel_(kernel), settings_(settings), rows_(rows), limit_(limit) {
    for (int i = 0; i < kernels::most_lanes; ++i) idle(i);
  }
  /// Number of free lanes.
  [[nodiscard]] int free() const { return kernel_.lanes - busy_; }
  /// Number of busy lanes.
  [[nodiscard]] int busy() const { return busy_; }
  /// Adds an orbit about a point mass, with checked start and field and a non-zero end time.
  void take_in(std::size_t number, const PropagationRequest& request) {
    const auto place =
        std::find_if(lanes_.begin(), lanes_.begin() + kernel_.lanes, [](const Lane& l) { return !l.busy; });
    const int i = static_cast<int>(place - lanes_.begin());
    Lane& lane = *place;
    lane = {.busy = true,
            .backwards = request.until < 0,
            .number = number,
            .mu = request.gravity.mu,
            .until = std::abs(request.until),
            .start_radius = request.start.position.stableNorm(),
            .first_step = steps_};
    ++busy_;
    put(block_.position, i, request.start.position);
    put(block_.velocity, i,
        lane.backwards ? Vector3<double>(-request.start.velocity) : request.start.velocity);
    put(block_.position_low, i, {0, 0, 0});
    put(block_.velocity_low, i, {0, 0, 0});
    block_.remaining.lane[i] = lane.until;
    block_.remaining_low.lane[i] = 0;
    choose_units(i);
  }
  /// Takes steps until an orbit ends or needs attention, at most 4096. Writes finished orbits to @p
  /// solutions.
  void run(std::vector<Solution>& solutions) {
    std::int64_t most = 4096;  // then the caller checks the time limit
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
  /// Ends all running orbits.
  void stop(const Status& status, std::vector<Solution>& solutions) {
    for (int i = 0; i < kernel_.lanes; ++i) {
      if (lanes_[static_cast<std::size_t>(i)].busy) end(i, status, solutions);
    }
  }

 private:
  /// Units of a lane, powers of two, and the data of its orbit.
  struct Lane {
    bool busy = false;
    bool backwards = false;
    std::size_t number = 0;
    int length = 0, time = 0;  ///< exponents of the units
    double mu = 1, until = 0, start_radius = 1;
    std::int64_t first_step = 0, next_row = 1;
  };

  /// Fills a lane with a circular orbit without end.
  void idle(int lane) {
    lanes_[static_cast<std::size_t>(lane)] = {};
    put(block_.position, lane, {1, 0, 0});
    put(block_.velocity, lane, {0, 1, 0});
    put(block_.position_low, lane, {0, 0, 0});
    put(block_.velocity_low, lane, {0, 0, 0});
    block_.mu.lane[lane] = 1;
    block_.remaining.lane[lane] = block_.next_row.lane[lane] = never;
    block_.remaining_low.lane[lane] = block_.least_step.lane[lane] = 0;
  }
  /// Chooses units in which the smaller of (r^3/mu)^(1/2) and r/|v| is near 1, as Propagation in
  /// continuation.cpp.
  void choose_units(int i) {
    Lane& lane = lanes_[static_cast<std::size_t>(i)];
    const double v = vector_at(block_.velocity, i).stableNorm();
    const int length = std::ilogb(vector_at(block_.position, i).stableNorm());
    const double mu = std::ldexp(lane.mu, 2 * lane.time - 3 * lane.length);
    int time = (3 * length - std::ilogb(mu)) / 2;
    if (v > 0) time = std::min(time, length - std::ilogb(v));
    // The remaining time must stay finite, so that the time of a failed orbit is known.
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
  /// Time from now to @p t, in the units of the lane.
  [[nodiscard]] double row_after_now(const Lane& lane, int i, double t) const {
    // until - t as an exact sum of two doubles; the remaining time is stored as one already.
    const double rest = lane.until - t, back = rest - lane.until,
                 error = (lane.until - (rest - back)) - (t + back);
    return (block_.remaining.lane[i] - std::ldexp(rest, -lane.time)) +
           (block_.remaining_low.lane[i] - std::ldexp(error, -lane.time));
  }
  void await_row(int i) {
    const Lane& lane = lanes_[static_cast<std::size_t>(i)];
    const double t = static_cast<double>(lane.next_row) * rows_.every;
    // No row next to the end, which has its own row: rounding of k DT must not add another.
    block_.next_row.lane[i] = lane.until - t > 1e-9 * rows_.every ? row_after_now(lane, i, t) : never;
  }
  void give_rows(int i, double taken) {
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
  [[nodiscard]] State users(const Lane& lane, State own) const {
    if (lane.backwards) own.velocity = -own.velocity;
    for (int k = 0; k < 3; ++k) {
      own.position[k] = std::ldexp(own.position[k], lane.length);
      own.velocity[k] = std::ldexp(own.velocity[k], lane.length - lane.time);
    }
    return own;
  }
  [[nodiscard]] State state(int i) const {
    return users(lanes_[static_cast<std::size_t>(i)],
                 {vector_at(block_.position, i), vector_at(block_.velocity, i)});
  }
  [[nodiscard]] double time_of(int i) const {
    const Lane& lane = lanes_[static_cast<std::size_t>(i)];
    const double t =
        lane.until - std::ldexp(block_.remaining.lane[i] + block_.remaining_low.lane[i], lane.time);
    return lane.backwards ? -t : t;
  }
  [[nodiscard]] Status lost(int i) const {
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
      return failed_with(
          Outcome::non_finite,
          "{}: the step of {:.6g} from t = {:.17g} leads to a state that is not finite; take a "
          "smaller tolerance",
          TaylorEnsemble::name, std::ldexp(h, lane.time), time_of(i));
    }
    return failed_with(Outcome::step_underflow,
                       "{}: at t = {:.17g} the step {:.3g} is lost in the asked interval, at the distance "
                       "{:.6g}; Kepler's solution (method kepler) needs no steps",
                       TaylorEnsemble::name, time_of(i), std::ldexp(h, lane.time), r);
  }
  void end(int i, Status status, std::vector<Solution>& solutions) {
    const Lane& lane = lanes_[static_cast<std::size_t>(i)];
    Solution& solution = solutions[lane.number];
    solution.t = time_of(i);
    solution.x = state(i);
    solution.statistics.steps = steps_ - lane.first_step;
    solution.statistics.right_hand_sides = solution.statistics.steps * settings_.order;
    solution.status = std::move(status);
    if (solution.status.ok() && !(solution.x.position.allFinite() && solution.x.velocity.allFinite())) {
      solution.status =
          failed_with(Outcome::non_finite,
                      "{}: the state at t = {:.17g} is beyond the range of doubles; choose other "
                      "units",
                      TaylorEnsemble::name, solution.t);
    }
    idle(i);
    --busy_;
  }

  const kernels::EnsembleKernel& kernel_;
  const kernels::LaneSettings& settings_;
  const InnerRows& rows_;
  std::int64_t limit_, steps_ = 0;
  int busy_ = 0;
  std::array<Lane, kernels::most_lanes> lanes_;
  kernels::LaneBlock block_{};
};

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

/// An orbit in scaled units, in which |r| and mu are near 1 at the start.
class Leg {
 public:
  Leg(std::size_t number, const PropagationRequest& request, const InnerRows& rows,
      const std::function<bool()>& out_of_time)
      : number_(number),
        request_(request),
        rows_(rows),
        out_of_time_(out_of_time),
        units_(detail::extent(request.start.position), request.gravity.mu),
        end_(std::min(std::ldexp(std::abs(request.until), -units_.time), std::numeric_limits<double>::max())),
        system_(Motion{units_.own(request.gravity)}) {}
  Leg(const Leg&) = delete;
  Leg& operator=(const Leg&) = delete;

  /// The initial value problem for the integrator; it refers to this object.
  [[nodiscard]] ivp::Start start(std::int64_t steps) {
    const State s = units_.own(request_.start);
    ivp::Start start{&system_, ivp::State(6), 0, std::copysign(end_, request_.until), {}, {.steps = steps}};
    start.x0 << s.position, s.velocity;
    start.observer = [this](const ivp::Step& step) { return see(step); };
    return start;
  }
  /// Solution in the units of the user.
  [[nodiscard]] Solution users(const ivp::Solution& end) const {
    return {end.status.ok() ? request_.until : std::ldexp(end.t, units_.time), users(end.x), end.status,
            end.statistics};
  }

 private:
  [[nodiscard]] State users(const ivp::State& x) const { return units_.users({x.head<3>(), x.tail<3>()}); }
  /// Observer of each step. @return false to stop
  bool see(const ivp::Step& step) {
    if (rows_.sink) give_rows(step);
    constexpr int clock_every = 64;  // reading the clock at every step would cost as much as the step
    if (steps_++ % clock_every == 0 && out_of_time_()) return false;
    // Near the end a step is the remaining time, or half of it, and may be short.
    const double length = std::abs(step.t1 - step.t0), rest = end_ - std::abs(step.t1);
    return length > eps * end_ || rest <= 2 * length;
  }
  /// Outputs the rows within a step, without those that equal the end to rounding.
  void give_rows(const ivp::Step& step) {
    const double sign = request_.until < 0 ? -1 : 1, until = std::abs(request_.until);
    for (;; ++next_row_) {
      const double t = static_cast<double>(next_row_) * rows_.every, there = std::ldexp(t, -units_.time);
      if (!(there <= std::abs(step.t1) && until - t > 1e-9 * rows_.every)) return;
      rows_.sink(number_, sign * t, users(step.at(sign * there)));
    }
  }

  std::size_t number_;
  const PropagationRequest& request_;
  const InnerRows& rows_;
  const std::function<bool()>& out_of_time_;
  detail::PowerUnits units_;
  /// |end time| in scaled units, bounded by the largest double, in which every step is lost.
  double end_;
  ivp::System system_;
  std::int64_t next_row_ = 1, steps_ = 0;
};

/// Propagates orbits about bodies with zonal harmonics, with checked starts and fields and non-zero end
/// times, by ivp::integrate_all() in units that are powers of two. A failed orbit keeps its failure, with a
/// time in those units; a step that is lost in the time ends with `interrupted`.
/// @param which indices of these orbits
/// @param steps limit of steps of each orbit
/// @param out_of_time called by all threads; when true, running orbits end with `interrupted`
/// @param solutions results, by index
void propagate_in_zonal_fields(std::span<const PropagationRequest> requests,
                               const std::vector<std::size_t>& which, const TaylorEnsemble& method,
                               const InnerRows& rows, std::int64_t steps,
                               const std::function<bool()>& out_of_time, std::vector<Solution>& solutions) {
  std::deque<Leg> legs;
  std::vector<ivp::Start> starts;
  for (const std::size_t number : which)
    starts.push_back(legs.emplace_back(number, requests[number], rows, out_of_time).start(steps));
  // Position and velocity are near 1 at the start; the small absolute tolerance is for components that pass
  // through 0.
  const ivp::Series series{.relative_tolerance = method.tolerance,
                           .absolute_tolerance = method.tolerance / 32,
                           .order = method.order};
  const auto ends = ivp::integrate_all(std::span<const ivp::Start>(starts), series, method.threads,
                                       method.instructions.value_or(best_instruction_set()));
  for (std::size_t i = 0; i < which.size(); ++i) solutions[which[i]] = legs[i].users(ends[i]);
}

/// Data shared by all threads; orbits are distributed in portions.
struct Ensemble {
  std::span<const PropagationRequest> requests;
  const TaylorEnsemble& method;
  const InnerRows& rows;
  const Limits& limits;
  const kernels::EnsembleKernel& kernel;
  kernels::LaneSettings settings;
  std::vector<Solution> solutions;
  std::vector<char> is_zonal;  // per orbit; bytes, which threads may write concurrently
  Stopwatch watch;
  std::atomic<std::size_t> next = 0;

  [[nodiscard]] bool out_of_time() const {
    return std::isfinite(limits.seconds) && watch.seconds() > limits.seconds;
  }
  [[nodiscard]] Status too_late() const {
    return failed_with(Outcome::time_limit, "{}: {:g} seconds were used up; allow more", TaylorEnsemble::name,
                       limits.seconds);
  }

  /// Work of one thread.
  void work() {
    Lanes lanes(kernel, settings, rows, limits.steps);
    // Distribute few orbits among all threads, with idle lanes; otherwise the first thread would take them
    // all.
    const std::size_t threads = threads_for(method.threads),
                      portion = std::clamp<std::size_t>((requests.size() + threads - 1) / threads, 1, 16);
    std::size_t number = 0, end = 0;
    for (bool more = true; more || lanes.busy() > 0;) {
      while (more && lanes.free() > 0 && static_cast<std::size_t>(lanes.busy()) < portion) {
        if (number == end) {
          number = std::min(next.fetch_add(portion), requests.size());
          end = std::min(number + portion, requests.size());
          more = number < end;
          continue;
        }
        begin(number++, lanes);
      }
      if (lanes.busy() == 0) continue;
      lanes.run(solutions);
      if (out_of_time()) lanes.stop(too_late(), solutions);
    }
  }

  /// Propagates the orbits with zonal terms, which work() skips. A failed one is repeated by
  /// AnalyticContinuation, which may succeed, or else gives a message in the units of the user.
  void propagate_rest() {
    std::vector<std::size_t> rest;
    for (std::size_t i = 0; i < is_zonal.size(); ++i) {
      if (is_zonal[i] != 0) rest.push_back(i);
    }
    if (rest.empty()) return;
    propagate_in_zonal_fields(
        requests, rest, method, rows, limits.steps, [this] { return out_of_time(); }, solutions);
    share_out(rest.size(), 1, method.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Solution& solution = solutions[rest[i]];
        if (!solution.status.ok()) repeat(rest[i], solution);
      }
    });
  }

 private:
  [[nodiscard]] double left() const { return std::max(0.0, limits.seconds - watch.seconds()); }
  /// Repeats one orbit if time is left; otherwise it keeps its state.
  void repeat(std::size_t number, Solution& solution) const {
    if (!out_of_time()) {
      Solution again = alone(number, std::abs(solution.t));
      const bool is_behind = std::abs(again.t) < std::abs(solution.t);
      if (again.status.outcome() != Outcome::time_limit || !is_behind) {
        solution = std::move(again);
        return;
      }
    }
    solution.status = too_late();
  }
  /// @param shown time up to which rows have been output
  [[nodiscard]] Solution alone(std::size_t number, double shown) const {
    const PropagationRequest& request = requests[number];
    auto count = std::max<std::int64_t>(1, static_cast<std::int64_t>(shown / rows.every));
    while (static_cast<double>(count) * rows.every <= shown) ++count;
    const double sign = request.until < 0 ? -1 : 1, until = std::abs(request.until);
    Observer observer;
    if (rows.sink) {
      observer = [&](const Step& step) {
        for (;; ++count) {
          const double t = static_cast<double>(count) * rows.every;
          if (!(t <= std::abs(step.t1) && until - t > 1e-9 * rows.every)) return true;
          rows.sink(number, sign * t, step.at(sign * t));
        }
      };
    }
    Limits own = limits;
    own.seconds = left();
    Solution solution = propagate(request.start, 0, request.until, request.gravity,
                                  AnalyticContinuation{.tolerance = method.tolerance}, observer, own);
    solution.statistics.seconds = 0;
    return solution;
  }

  void begin(std::size_t number, Lanes& lanes) {
    const PropagationRequest& request = requests[number];
    Solution& solution = solutions[number];
    solution.x = request.start;
    solution.status = refusal(request);
    if (!solution.status.ok() || request.until == 0) return;
    if (out_of_time()) {
      solution.status = too_late();
    } else if (request.gravity.degree() > 0) {
      is_zonal[number] = 1;
    } else {
      lanes.take_in(number, request);
    }
  }
};

}  // namespace

std::vector<Solution> propagate_all(std::span<const PropagationRequest> requests,
                                    const TaylorEnsemble& method, const InnerRows& rows,
                                    const Limits& limits) {
  check_options(method, rows);
  Ensemble ensemble{.requests = requests,
                    .method = method,
                    .rows = rows,
                    .limits = limits,
                    .kernel = ensemble_kernel_for(method.instructions.value_or(best_instruction_set())),
                    .settings = settings_of(method),
                    .solutions = std::vector<Solution>(requests.size()),
                    .is_zonal = std::vector<char>(requests.size()),
                    .watch = {}};
  in_threads(std::min(threads_for(method.threads), requests.size()), [&ensemble] { ensemble.work(); });
  ensemble.propagate_rest();
  return std::move(ensemble.solutions);
}

}  // namespace nlmech::orbit

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "nlmech/ivp/ensemble/integrate_all.hpp"
#include "nlmech/ivp/limits.hpp"
#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/program/tape_lanes.hpp"

namespace nlmech::ivp {
namespace {

// Series for several trajectories in parallel, one per lane of the vector registers. Each has the bits of
// integrate(), independent of the others: the same sums (TapeLanes) and the same step-size control (Rule).

/// The lanes of one thread.
class SeriesLanes {
 public:
  /// @param rule of all trajectories
  /// @param set instruction set; with InstructionSet::baseline the bits are those of a processor with no
  /// other set
  SeriesLanes(const taylor_series::Rule& rule, InstructionSet set)
      : rule_(rule),
        log2_safety_(rule.log2_safety()),
        tapes_(set),
        lanes_(static_cast<std::size_t>(tapes_.lanes())) {}

  /// Can the trajectory run in a lane? It needs smooth equations without discontinuities, bounds and
  /// invariants.
  [[nodiscard]] static bool suits(const Start& start) {
    const System& system = *start.system;
    const State& x0 = start.x0;
    if (start.t0 == start.t1 || !x0.allFinite() || system.switches() > 0) return false;
    State lower = x0, upper = x0;
    Eigen::VectorXd constant;
    return system.discontinuities(start.t0, start.t1).empty() && !system.bounds(lower, upper) &&
           !system.invariants(start.t0, x0, constant);
  }

  /// Number of lanes without a trajectory.
  [[nodiscard]] int free() const { return tapes_.lanes() - busy_; }
  /// Number of lanes with a trajectory.
  [[nodiscard]] int busy() const { return busy_; }
  /// Adds a trajectory that suits() if there is a free lane for its equations. @param start outlives the lane
  [[nodiscard]] bool take_in(std::size_t number, const Start& start, std::vector<Solution>& solutions) {
    const std::size_t at = static_cast<std::size_t>(
        std::find_if(lanes_.begin(), lanes_.end(), [](const Lane& l) { return l.start == nullptr; }) -
        lanes_.begin());
    Lane& lane = lanes_[at];
    const SmoothSegment segment(start.t0, start.t1);
    if (lane.equations != start.system || lane.recorded != start.t0) {
      Tape tape = start.system->record(segment(start.t0));
      const bool fits = order_ > 0 && tapes_.fits(tape);
      if (!fits && busy_ > 0) return false;
      if (!fits) load(tape, start.system->series_codes());
      tapes_.put(static_cast<int>(at), tape);
      lane.equations = start.system;
      lane.recorded = start.t0;
    }
    lane.start = &start;
    lane.limits = start.limits_from_now();
    lane.control = StepControl(bounded(taylor_series::Rule::steps, lane.limits.largest_step));
    lane.number = number;
    lane.segment = segment;
    lane.now = {start.t0, start.x0, {}, {}};
    lane.next = lane.f = start.x0;
    lane.watch = {};
    ++busy_;
    begin(lane, solutions);
    return true;
  }
  /// One trial step of each trajectory. Writes finished trajectories to @p solutions.
  void run(std::vector<Solution>& solutions) {
    tapes_.expand();
    tapes_.measure(rule_.absolute_tolerance, rule_.relative_tolerance);
    for (Lane& lane : lanes_) {
      if (lane.start != nullptr) plan(lane, {tapes_.tail(index(lane))}, solutions);
    }
    tapes_.advance();
    for (Lane& lane : lanes_) {
      if (lane.start != nullptr && lane.planned) attempt(lane, solutions);
    }
  }

 private:
  struct Lane {
    const System* equations = nullptr;  // system whose constants are in the lane
    double recorded = 0;                // time of the recording, for branches on the time
    const Start* start = nullptr;       // none: the lane is free
    Limits limits;
    std::size_t number = 0;
    SmoothSegment segment;
    Solution now;   // its state is that of the start, of the latest observed step, or of the end
    State next, f;  // at the end of a step that is tested or observed
    StepControl control{taylor_series::Rule::steps};
    Stopwatch watch;
    double scale = 1, before = 0, t1 = 0;
    int attempts = 0;
    bool planned = false, tested = true;
  };
  /// Within the latest step of a lane.
  class Dense : public DenseOutput {
   public:
    Dense(const SeriesLanes& lanes, const Lane& lane) : lanes_(lanes), lane_(lane) {}
    void at(double t, State& x) const override {
      x.resize(lane_.next.size());
      const double s = (t - lane_.now.t) / lane_.scale;
      for (int i = 0; i < static_cast<int>(x.size()); ++i) {
        const auto c = lanes_.series(lane_, i);
        x[i] = c[0] + taylor_series::increment(c.data(), lanes_.rule_.order, s);
      }
    }
    // As a single run has them, so that events have the same bits.
    [[nodiscard]] bool is_as_accurate_as_step() const override { return true; }
    bool bound_change(double t1, State& least, State& most) const override {
      most.resize(lane_.next.size());
      const double s = (t1 - lane_.now.t) / lane_.scale;
      for (int i = 0; i < static_cast<int>(most.size()); ++i)
        most[i] = taylor_series::largest_increment(lanes_.series(lane_, i).data(), lanes_.rule_.order, s);
      least = -most;
      return true;
    }

   private:
    const SeriesLanes& lanes_;
    const Lane& lane_;
  };
  using Coefficients = std::array<double, 101>;

  void load(const Tape& tape, machine_code::SeriesCodes& codes) {
    order_ = rule_.order;
    tapes_.load(tape, order_, &codes);
    for (Lane& lane : lanes_) lane.equations = nullptr;
  }
  [[nodiscard]] int index(const Lane& lane) const { return static_cast<int>(&lane - lanes_.data()); }
  [[nodiscard]] Coefficients series(const Lane& lane, int i) const {
    Coefficients c{};
    for (int k = 0; k <= order_; ++k) c[static_cast<std::size_t>(k)] = tapes_.coefficients(i, k)[index(lane)];
    return c;
  }

  void begin(Lane& lane, std::vector<Solution>& solutions) {
    Solution& now = lane.now;
    const double end = lane.start->t1;
    tapes_.set(index(lane), lane.segment(now.t), now.x.data(), 1);
    lane.start->system->rhs(lane.segment(now.t), now.x, lane.f);
    ++now.statistics.right_hand_sides;
    if (!lane.f.allFinite()) return finish(lane, non_finite_rhs(Series::name, now.t), solutions);
    lane.scale = rule_.first_scale(now.x, lane.f, std::abs(end - now.t));
    lane.before = 0;
    prepare(lane, solutions);
  }
  // Starts a new step.
  void prepare(Lane& lane, std::vector<Solution>& solutions) {
    if (Status status = limits(lane); !status.ok()) return finish(lane, std::move(status), solutions);
    lane.attempts = 0;
    set_time(lane);
  }
  void set_time(const Lane& lane) { tapes_.set_time(index(lane), lane.segment(lane.now.t), lane.scale); }
  // Reading the clock at every step would cost as much as the step.
  [[nodiscard]] Status limits(const Lane& lane) const {
    Limits limits = lane.limits;
    if (lane.now.statistics.steps % 64 != 0) limits.seconds = std::numeric_limits<double>::infinity();
    return check_limits(Series::name, lane.now.t, lane.now.statistics, limits, lane.watch);
  }

  // Plans the step size from the coefficients.
  void plan(Lane& lane, const taylor_series::Tail& tail, std::vector<Solution>& solutions) {
    Solution& now = lane.now;
    lane.planned = false;
    now.statistics.right_hand_sides += order_;
    if (!tail.is_finite()) {
      if (++lane.attempts == taylor_series::Rule::attempts)
        return finish(lane, non_finite_coefficients(Series::name, now.t, order_), solutions);
      lane.scale = taylor_series::Rule::smaller(lane.scale);
      return set_time(lane);
    }
    const double length = rule_.length(tail, lane.scale, log2_safety_);
    lane.tested = length > 2 * lane.before;
    lane.control.start(length);
    if (!aim(lane, solutions)) return;
    lane.planned = true;
    tapes_.set_argument(index(lane), (lane.t1 - now.t) / lane.scale);
  }
  // Sets the end of the next trial. @return false if there is none
  bool aim(Lane& lane, std::vector<Solution>& solutions) {
    lane.t1 = lane.control.plan(lane.now.t, lane.start->t1);
    if (lane.t1 != lane.now.t) return true;
    finish(lane, step_underflow(Series::name, lane.now.t, lane.control.length()), solutions);
    return false;
  }
  void attempt(Lane& lane, std::vector<Solution>& solutions) {
    const int at = index(lane);
    while (lane.tested && !slope_agrees(lane)) {
      ++lane.now.statistics.rejected;
      if (!lane.control.rejected(lane.control.taken() / 2)) {
        return finish(lane, step_underflow(Series::name, lane.now.t, lane.control.length()), solutions);
      }
      if (Status status = limits(lane); !status.ok()) return finish(lane, std::move(status), solutions);
      if (!aim(lane, solutions)) return;
      const double s = (lane.t1 - lane.now.t) / lane.scale;
      for (int i = 0; i < tapes_.size(); ++i)
        add_increment(tapes_.state(i)[at], tapes_.carry(i)[at],
                      taylor_series::increment(series(lane, i).data(), order_, s), tapes_.end(i)[at],
                      tapes_.end_carry(i)[at]);
    }
    accept(lane, solutions);
  }
  // Copies the end of the step.
  void take_end(Lane& lane) {
    for (int i = 0; i < tapes_.size(); ++i) lane.next[i] = tapes_.end(i)[index(lane)];
  }
  [[nodiscard]] bool ends_finite(const Lane& lane) {
    bool finite = true;
    for (int i = 0; i < tapes_.size(); ++i) finite = finite && std::isfinite(tapes_.end(i)[index(lane)]);
    return finite;
  }
  [[nodiscard]] bool slope_agrees(Lane& lane) {
    take_end(lane);
    if (!lane.next.allFinite()) return false;
    lane.start->system->rhs(lane.segment(lane.t1), lane.next, lane.f);
    ++lane.now.statistics.right_hand_sides;
    const double h = lane.t1 - lane.now.t, s = h / lane.scale;
    return rule_.template slope_agrees(lane.next, lane.f, h, [&](int i) {
      return taylor_series::slope(series(lane, i).data(), order_, s) / lane.scale;
    });
  }
  void accept(Lane& lane, std::vector<Solution>& solutions) {
    Solution& now = lane.now;
    if (!ends_finite(lane))
      return finish(lane, non_finite_state(Series::name, now.t, lane.t1 - now.t), solutions);
    lane.before = lane.control.taken();
    ++now.statistics.steps;
    const bool goes_on = !lane.start->observer || show(lane);
    lane.scale = taylor_series::Rule::next_scale(lane.scale, lane.before);
    tapes_.accept(index(lane));
    now.t = lane.t1;
    if (!goes_on) return finish(lane, interrupted(Series::name, now.t), solutions);
    if (now.t == lane.start->t1) return finish(lane, {}, solutions);
    prepare(lane, solutions);
  }
  [[nodiscard]] bool show(Lane& lane) {
    take_end(lane);
    const Nodes states = lane.next;
    const double times[] = {lane.t1};
    const bool goes_on = lane.start->observer({lane.now.statistics.steps, lane.now.t, lane.t1, lane.now.x,
                                               lane.next, times, states, Dense(*this, lane)});
    lane.now.x = lane.next;
    return goes_on;
  }

  void finish(Lane& lane, Status status, std::vector<Solution>& solutions) {
    lane.now.status = std::move(status);
    for (int i = 0; i < tapes_.size(); ++i) lane.now.x[i] = tapes_.state(i)[index(lane)];
    solutions[lane.number] = std::move(lane.now);
    lane.start = nullptr;
    --busy_;
  }

  taylor_series::Rule rule_;
  double log2_safety_;
  TapeLanes tapes_;
  int order_ = 0, busy_ = 0;
  std::vector<Lane> lanes_;
};

/// The lanes of one thread; a free lane takes the next trajectory. Trajectories of other equations wait until
/// all of the current equations have ended; with too many kinds of equations the lanes are emptied for each.
class LaneWork {
 public:
  /// The arguments outlive this object.
  LaneWork(std::span<const Start> starts, const Series& method, InstructionSet set,
           std::vector<Solution>& solutions)
      : starts_(starts), method_(method), solutions_(solutions), lanes_(rule_of(method), set) {}

  /// Integrates the trajectories whose numbers @p next distributes to all threads.
  void run(std::atomic<std::size_t>& next) {
    run_all([&] { return next.fetch_add(1); }, starts_.size());
    while (!waiting_.empty()) {
      const std::vector<std::size_t> those = std::exchange(waiting_, {});
      ++kinds_;
      std::size_t k = 0;
      run_all([&] { return k < those.size() ? those[k++] : starts_.size(); }, starts_.size());
    }
  }

 private:
  static constexpr int most_kinds = 8;

  /// @param next returns the number of the next trajectory; @p end or more after the last
  template <class Next>
  void run_all(const Next& next, std::size_t end) {
    for (bool more = true; more || lanes_.busy() > 0;) {
      while (more && lanes_.free() > 0) {
        const std::size_t i = next();
        more = i < end;
        if (more) begin(i);
      }
      if (lanes_.busy() > 0) lanes_.run(solutions_);
    }
  }
  void begin(std::size_t i) {
    const Start& start = starts_[i];
    detail::check_arguments(start.t0, start.t1, start.x0.size(), start.system->size());
    if (!lanes_.suits(start)) {
      solutions_[i] = detail::alone(start, method_);
    } else if (!lanes_.take_in(i, start, solutions_)) {
      if (kinds_ < most_kinds) return waiting_.push_back(i);
      while (lanes_.busy() > 0) lanes_.run(solutions_);
      static_cast<void>(lanes_.take_in(i, start, solutions_));  // empty lanes accept any equations
    }
  }

  std::span<const Start> starts_;
  const Series& method_;
  std::vector<Solution>& solutions_;
  SeriesLanes lanes_;
  std::vector<std::size_t> waiting_;
  int kinds_ = 1;
};

}  // namespace

std::vector<Solution> integrate_all(std::span<const Start> starts, const Series& method, int threads,
                                    InstructionSet set) {
  check_options(method);
  std::vector<Solution> solutions(starts.size());
  if (method.step > 0) {
    share_out(starts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) solutions[i] = detail::alone(starts[i], method);
    });
    return solutions;
  }
  std::atomic<std::size_t> next = 0;
  in_threads(std::min(threads_for(threads), starts.size()),
             [&] { LaneWork(starts, method, set, solutions).run(next); });
  return solutions;
}

}  // namespace nlmech::ivp

/// @file
/// Ode45 for several trajectories side by side, each with steps of its own: the sums of Pair in their order,
/// the formulas of Run. Internal to the component.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "nlmech/ivp/ensemble/pack.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"

namespace nlmech::ivp::detail {

/// One thread's lanes. @tparam Problem smooth on the way, and without bounds and invariants
template <class Problem, int lanes>
class PairLanes {
 public:
  static constexpr int n = Problem::dimension;  ///< components of the state

  /// All outlive it. @param t0 begin and @param t1 end of all, apart
  /// @param limits of each, without a time
  PairLanes(const Problem& problem, double t0, double t1, const Ode45& method, const Limits& limits)
      : problem_(problem),
        t0_(t0),
        t1_(t1),
        method_(method),
        rule_(bounded(dormand_prince::step_rule(t0, t1, method), limits.largest_step)),
        most_(limits.steps),
        segment_(t0, t1) {
    lanes_.fill(Lane(rule_));
    x0_ = x1_ = Packs::Zero();
    k_.fill(Packs::Zero());
  }

  /// Lanes with a trajectory.
  [[nodiscard]] int busy() const { return busy_; }
  /// Lanes without one.
  [[nodiscard]] int free() const { return lanes - busy_; }
  /// Takes in a trajectory, if there is a lane. @return false if it cannot begin
  [[nodiscard]] bool take_in(std::size_t number, const State<n>& x) {
    State<n> f;
    problem_(segment_(t0_), x, f);
    if (!x.allFinite() || !f.allFinite()) return false;
    int at = 0;
    while (lanes_[static_cast<std::size_t>(at)].number) ++at;
    Lane& lane = lanes_[static_cast<std::size_t>(at)];
    lane = Lane(rule_);
    lane.number = number;
    lane.t = t0_;
    lane.done.right_hand_sides = 1;
    lane.control.start(dormand_prince::first_length<n>(method_, rule_.largest, std::abs(t1_ - t0_), x, f));
    for (int c = 0; c < n; ++c) {
      x0_[c].v[at] = x[c];
      k_.front()[c].v[at] = f[c];
    }
    ++busy_;
    return true;
  }
  /// A trial step of each. Puts what has arrived into @p solutions, and the numbers of those that cannot go
  /// on into @p failed.
  void run(std::vector<Solution<n>>& solutions, std::vector<std::size_t>& failed) {
    for (int l = 0; l < lanes; ++l) {
      Lane& lane = lanes_[static_cast<std::size_t>(l)];
      if (!lane.number) continue;
      lane.t1 = lane.control.plan(lane.t, t1_);
      h_.v[l] = lane.t1 - lane.t;
      if (lane.t1 == lane.t || lane.done.steps + lane.done.rejected >= most_) fail(lane, failed);
    }
    attempt();
    typename Number::Numbers accepted = {};  // 1 where it is
    for (int l = 0; l < lanes; ++l) {
      Lane& lane = lanes_[static_cast<std::size_t>(l)];
      if (lane.number && judge(lane, l, failed)) accepted[l] = 1;
    }
    const auto moves = accepted != typename Number::Numbers{};
    for (int c = 0; c < n; ++c) {
      x0_[c].v = moves ? x1_[c].v : x0_[c].v;
      k_.front()[c].v = moves ? k_.back()[c].v : k_.front()[c].v;
    }
    for (int l = 0; l < lanes; ++l) {
      Lane& lane = lanes_[static_cast<std::size_t>(l)];
      if (lane.number && lane.t == t1_) arrive(lane, l, solutions);
    }
  }

 private:
  using Number = Pack<lanes>;
  using Packs = Vector<Number, n>;
  struct Lane {
    explicit Lane(const StepRule& rule = {}) : control(rule) {}
    std::optional<std::size_t> number;  // none: the lane is free
    double t = 0, t1 = 0;
    StepControl control;
    Statistics done;
  };

  void attempt() {
    using namespace dormand_prince;
    for (std::size_t i = 1; i < stages; ++i) {
      x1_ = x0_;
      for (std::size_t j = 0; j < i; ++j) {
        if (a[i][j] == 0) continue;
        const Number weight = h_ * Number(a[i][j]);
        for (int d = 0; d < n; ++d) x1_[d] += weight * k_[j][d];
      }
      Number t;
      for (int l = 0; l < lanes; ++l) {
        const Lane& lane = lanes_[static_cast<std::size_t>(l)];
        t.v[l] = segment_(c[i] == 1 ? lane.t1 : lane.t + c[i] * h_.v[l]);
      }
      problem_(t, x1_, k_[i]);
    }
    for (int d = 0; d < n; ++d) {
      error_[d] = Number(0);
      for (std::size_t j = 0; j < stages; ++j) error_[d] += Number(difference[j]) * k_[j][d];
      error_[d] = h_ * error_[d];
    }
  }
  /// Is the step accepted?
  [[nodiscard]] bool judge(Lane& lane, int l, std::vector<std::size_t>& failed) {
    const double threshold = method_.absolute_tolerance / method_.relative_tolerance;
    bool finite = true;
    double largest = 0;
    for (int d = 0; d < n; ++d) {
      const double x1 = x1_[d].v[l];
      finite = finite && std::isfinite(x1) && std::isfinite(k_.back()[d].v[l]);
      const double part =
          std::abs(error_[d].v[l]) / std::max({std::abs(x0_[d].v[l]), std::abs(x1), threshold});
      if (part > largest || std::isnan(part)) largest = part;
    }
    const double error = finite ? largest / method_.relative_tolerance : nan;
    lane.done.right_hand_sides += static_cast<std::int64_t>(dormand_prince::stages) - 1;
    if (error <= 1) {
      lane.control.accepted(dormand_prince::next_length(lane.control.taken(), error));
      ++lane.done.steps;
      lane.t = lane.t1;
      return true;
    }
    ++lane.done.rejected;
    if (!lane.control.rejected(dormand_prince::shorter_length(lane.control.taken(), error)))
      fail(lane, failed);
    return false;
  }
  void fail(Lane& lane, std::vector<std::size_t>& failed) {
    failed.push_back(*std::exchange(lane.number, std::nullopt));
    --busy_;
  }
  void arrive(Lane& lane, int l, std::vector<Solution<n>>& solutions) {
    Solution<n>& s = solutions[*std::exchange(lane.number, std::nullopt)];
    --busy_;
    s.t = t1_;
    s.statistics = lane.done;
    for (int c = 0; c < n; ++c) s.x[c] = x0_[c].v[l];
  }

  const Problem& problem_;
  double t0_, t1_;
  const Ode45& method_;
  StepRule rule_;
  std::int64_t most_;
  SmoothSegment segment_;
  std::array<Lane, lanes> lanes_;
  Packs x0_, x1_, error_;
  std::array<Packs, dormand_prince::stages> k_;
  Number h_;
  int busy_ = 0;
};

}  // namespace nlmech::ivp::detail

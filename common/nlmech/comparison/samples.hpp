/// @file
/// A trajectory as points of a picture.
#pragma once

#include <cstddef>
#include <vector>

#include "nlmech/ivp/solution.hpp"

namespace nlmech::comparison {

/// Collects states of a run: several a step, of long runs a part of them at equal distances.
class Samples {
 public:
  /// A state.
  template <class State>
  void add(double t, const State& x) {
    if (seen_++ % stride_ != 0) return;
    times_.push_back(t);
    states_.emplace_back(x.data(), x.data() + x.size());
    if (times_.size() > most) thin();
  }
  /// Those of a step after the latest and before @p end.
  template <int n>
  void see(const ivp::Step<n>& step, double end) {
    constexpr int places = 8;
    const double way = step.t1 - step.t0;
    for (int k = 1; k < places; ++k) {
      const double t = step.t0 + way * k / places;
      if ((t - latest_) * way > 0 && (end - t) * way > 0) add(t, step.at(t));
    }
    latest_ = end;
  }
  /// A state that stays whatever else is left out: the last.
  template <class State>
  void finish(double t, const State& x) {
    seen_ = 0;
    add(t, x);
  }

  /// When.
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  /// One component at those times.
  [[nodiscard]] std::vector<double> component(std::size_t i) const {
    std::vector<double> all;
    for (const auto& x : states_) all.push_back(x[i]);
    return all;
  }

 private:
  static constexpr std::size_t most = 8000;

  void thin() {
    for (std::size_t i = 0; 2 * i < times_.size(); ++i) {
      times_[i] = times_[2 * i];
      states_[i] = states_[2 * i];
    }
    times_.resize((times_.size() + 1) / 2);
    states_.resize(times_.size());
    stride_ *= 2;
  }

  std::vector<double> times_;
  std::vector<std::vector<double>> states_;
  std::size_t seen_ = 0, stride_ = 1;
  double latest_ = 0;
};

}  // namespace nlmech::comparison

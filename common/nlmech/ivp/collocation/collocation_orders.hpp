/// @file
/// Control of the order in adaptive-collocation: engines of rising order, of which one works at a time.
#pragma once

#include <algorithm>
#include <tuple>
#include <type_traits>

#include "nlmech/ivp/collocation/collocation_trial.hpp"
#include "nlmech/ivp/solution.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::ivp::adaptive {

/// One engine in several orders, with the engine's own interface. After each step the engine says whether a
/// neighbour would do better, and the neighbour goes on from its trial function.
/// @tparam Engine by rising order; all for the same system
template <class... Engine>
class Orders {
 public:
  static constexpr int count = sizeof...(Engine);  ///< of orders

  /// @param order which one begins, from 0
  /// @param is_fixed does it stay there?
  Orders(const Setup& setup, int order, bool is_fixed)
      : engines_(for_each_of<Engine>(setup)...), order_(order), is_fixed_(is_fixed) {}

  /// Calls @p work with the engine that is at work, and answers what it does.
  template <class Work>
  decltype(auto) current(Work&& work) {
    return at<0>(*this, order_, work);
  }
  /// The same, for looking.
  template <class Work>
  decltype(auto) current(Work&& work) const {
    return at<0>(*this, order_, work);
  }

  /// See the engine.
  void begin_segment(double t, double end, const State& x, Statistics& statistics) {
    current([&](auto& e) { e.begin_segment(t, end, x, statistics); });
    steps_ = 0;
  }
  /// See the engine.
  Trial attempt(double t, double t1, Statistics& statistics) {
    return current([&](auto& e) { return e.attempt(t, t1, statistics); });
  }
  /// Power of the step with which the estimate grows.
  [[nodiscard]] int error_order() const {
    return current([](const auto& e) { return e.error_order(); });
  }
  /// Takes the trial for the begin of the next, with another order if that will do better.
  void accept(Statistics& statistics) {
    const int better = current([&](auto& e) {
      const int change = e.better_order();
      e.accept(statistics);
      return change;
    });
    ++steps_;
    const int next = std::clamp(order_ + better, 0, count - 1);
    if (is_fixed_ || next == order_ || steps_ < patience) return;
    current([&](const auto& from) {
      at<0>(*this, next, [&](auto& to) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(to)>, std::decay_t<decltype(from)>>)
          to.continue_from(from);
      });
    });
    order_ = next;
    steps_ = 0;
  }

 private:
  static constexpr int patience = 4;  // steps with an order before the next change

  template <class>
  static const Setup& for_each_of(const Setup& setup) {
    return setup;
  }
  template <int i, class Self, class Work>
  static decltype(auto) at(Self& self, int order, Work&& work) {
    if constexpr (i + 1 < count) {
      if (order != i) return at<i + 1>(self, order, work);
    }
    return work(std::get<static_cast<std::size_t>(i)>(self.engines_));
  }

  std::tuple<Engine...> engines_;
  int order_;
  bool is_fixed_;
  int steps_ = 0;
};

}  // namespace nlmech::ivp::adaptive

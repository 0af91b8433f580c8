/// @file
/// Where a function of time and state passes through zero on the way of an integration: landings, sections,
/// impacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Which passages count, in the direction of the integration.
enum class Crossing {
  either,   ///< all
  rising,   ///< from negative values
  falling,  ///< from positive values
};

/// What an integration is to look out for.
struct Event {
  std::function<double(double t, const State& x)> value;  ///< g(t, x), continuous: the event is its zero
  Crossing crossing = Crossing::either;                   ///< which passages count
  bool ends = false;                                      ///< is the integration over at the first of them?
};

/// An event that took place.
struct Hit {
  std::size_t event;  ///< its place in the list
  double t;           ///< when: at the zero or at most one spacing of doubles after it
  State x;            ///< the state, by the method's dense output
  bool rising;        ///< did g come from negative values?
};

/// An integration with what took place on its way.
struct EventSolution {
  Solution solution;      ///< ends at the asked time, or with success at the event that ends it
  std::vector<Hit> hits;  ///< in the order of the way
};

/// Looks for events in one step after another. `integrate_with_events` is the usual way to use it.
///
/// Each step is looked at in 8 places (the last is its end), and every change of sign is narrowed down by
/// bisection until two neighbouring doubles are left. Two zeros between neighbouring places go unseen: bound
/// the method's `largest_step` where that may happen. A function that is zero at the begin of a place has the
/// sign that it takes in the first 2^-26 of it: a ball that leaves the ground makes no event until it is
/// back. Poles and jumps, where the sign changes without a zero, are no events.
class EventFinder {
 public:
  /// @throws std::invalid_argument for an event without a function
  explicit EventFinder(std::vector<Event> events) : events_(std::move(events)), signs_(events_.size(), 0) {
    for (const Event& event : events_) {
      if (!event.value) throw std::invalid_argument("event: there is no function to look at");
    }
  }

  /// Looks at a step; false if an event ends the integration in it, or a value was NaN.
  [[nodiscard]] bool see(const Step& step) {
    if (step.index == 1) begin(step.t0, step.x0);
    State x = step.x1;
    double from = step.t0;
    for (int k = 1; k <= places && status_.ok(); ++k) {
      const double to = k == places ? step.t1 : step.t0 + (step.t1 - step.t0) * k / places;
      if (k < places) {
        step.dense.at(to, x);
      } else {
        x = step.x1;
      }
      if (look(step, from, to, x)) return false;
      from = to;
    }
    return status_.ok();
  }
  /// What was found up to now, in the order of the way.
  [[nodiscard]] const std::vector<Hit>& hits() const { return hits_; }
  /// Was the last one an event that ends the integration?
  [[nodiscard]] bool ended() const { return !hits_.empty() && events_[hits_.back().event].ends; }
  /// `non_finite` once a value was NaN.
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  static constexpr int places = 8;

  void begin(double t, const State& x) {
    for (std::size_t i = 0; i < events_.size(); ++i) signs_[i] = sign_of(events_[i].value(t, x), t);
  }
  int sign_of(double value, double t) {
    if (std::isnan(value) && status_.ok()) status_ = event_undefined(t);
    return (value > 0) - (value < 0);
  }
  // The passages between two places, the second with state x; true if one of them ends the integration.
  bool look(const Step& step, double from, double to, const State& x) {
    const std::size_t first = hits_.size();
    for (std::size_t i = 0; i < events_.size(); ++i) {
      double begin = from;
      const int before = signs_[i] != 0 ? signs_[i] : sign_after(step, i, begin, to);
      const int after = sign_of(events_[i].value(to, x), to);
      signs_[i] = after;
      const bool rising = before < 0;
      if (before == 0 || after == before || !status_.ok() || !counts(events_[i].crossing, rising)) continue;
      const Hit hit = narrowed(step, i, begin, to, before);
      // Else the function was NaN on the way to its zero.
      if (status_.ok() && is_zero(step, hit, begin, to, x)) hits_.push_back(hit);
    }
    const auto begin = hits_.begin() + static_cast<std::ptrdiff_t>(first);
    const bool forwards = step.t1 > step.t0;
    std::stable_sort(begin, hits_.end(),
                     [forwards](const Hit& a, const Hit& b) { return forwards ? a.t < b.t : a.t > b.t; });
    const auto end = std::find_if(begin, hits_.end(), [this](const Hit& h) { return events_[h.event].ends; });
    if (end == hits_.end()) return false;
    hits_.erase(end + 1, hits_.end());
    return true;
  }
  // Where a function leaves zero, its sign is what it is shortly afterwards: there the function has moved by
  // far more than rounding, but hardly come back already. Moves the begin there.
  int sign_after(const Step& step, std::size_t event, double& begin, double to) {
    const double after = begin + (to - begin) * 0x1p-26;
    if (after == begin) return 0;
    begin = after;
    State x = step.x1;
    step.dense.at(begin, x);
    return sign_of(events_[event].value(begin, x), begin);
  }
  static bool counts(Crossing crossing, bool rising) {
    return crossing == Crossing::either || (crossing == Crossing::rising) == rising;
  }
  // A pole and a jump change the sign too. Between neighbouring doubles a continuous function does not move
  // as far as between two places.
  bool is_zero(const Step& step, const Hit& hit, double from, double to, const State& x_to) const {
    const auto& value = events_[hit.event].value;
    const auto at = [&](double t) {
      State x = step.x1;
      step.dense.at(t, x);
      return value(t, x);
    };
    const double across = std::abs(value(hit.t, hit.x) - at(std::nextafter(hit.t, from)));
    return !(across > (std::abs(at(from)) + std::abs(value(to, x_to))) / 4);
  }
  // The first double at which the sign is no longer that of `from`.
  Hit narrowed(const Step& step, std::size_t event, double from, double to, int sign) {
    State x = step.x1;
    for (;;) {
      const double middle = from + (to - from) / 2;
      if (middle == from || middle == to) break;
      step.dense.at(middle, x);
      (sign_of(events_[event].value(middle, x), middle) == sign ? from : to) = middle;
    }
    if (to == step.t1) {
      x = step.x1;
    } else {
      step.dense.at(to, x);
    }
    return {event, to, x, sign < 0};
  }

  std::vector<Event> events_;
  std::vector<int> signs_;
  std::vector<Hit> hits_;
  Status status_;
};

/// integrate() with events. An event that ends the integration makes a success of it: the solution's time and
/// state are those of the event. With the method `series` they are as accurate as the steps (a test asserts
/// 16 eps of the time for an oscillator at a tolerance of 1e-15); other methods' dense output says how
/// accurate it is.
/// @param observer sees every step, the one too in which an event ends the integration
/// @throws std::invalid_argument as integrate(), and for an event without a function
template <class Method>
[[nodiscard]] EventSolution integrate_with_events(const System& system, const State& x0, double t0, double t1,
                                                  const Method& method, std::vector<Event> events,
                                                  const Observer& observer = {}, const Limits& limits = {}) {
  EventFinder finder(std::move(events));
  const auto observe = [&](const Step& step) {
    const bool wanted = !observer || observer(step);
    return finder.see(step) && wanted;
  };
  Solution solution = integrate(system, x0, t0, t1, method, observe, limits);
  if (!finder.status().ok()) {
    solution.status = finder.status();
  } else if (finder.ended()) {
    solution.t = finder.hits().back().t;
    solution.x = finder.hits().back().x;
    solution.status = {};
  }
  return {std::move(solution), finder.hits()};
}

}  // namespace nlmech::ivp

/// @file
/// What a run shows on its way: rows at asked times, events, and what a picture needs.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "nlmech/comparison/commands/seen.hpp"
#include "nlmech/comparison/rows.hpp"
#include "nlmech/ivp/named/named_methods.hpp"

namespace nlmech::comparison {

/// What the steps of a run show: rows at asked times, events, and what a picture needs.
class LookOut {
 public:
  /// All outlive this. @param run the method, without observer
  LookOut(const Request& request, const ivp::NamedIntegrator& run, const ivp::System& system, Rows& rows,
          Seen& seen)
      : request_(request),
        run_(run),
        system_(system),
        rows_(rows),
        seen_(seen),
        finder_(events_of(request)) {}

  /// Looks at a step; false if an event ends the run in it.
  bool see(const ivp::Step& step) {
    const std::size_t before = finder_.hits().size();
    const bool on = finder_.see(step);
    for (std::size_t i = before; i < finder_.hits().size(); ++i) {
      last_ = refined(step, finder_.hits()[i]);
      rows_.add_before(last_->t, step);
      rows_.add_event(last_->t, last_->x, request_.events[last_->event].text);
      if (request_.draw) seen_.events.push_back({last_->t, {last_->x.begin(), last_->x.end()}});
    }
    if (on) rows_.add_before(step.t1, step);
    if (request_.draw && !request_.section) seen_.path.see(step, on ? step.t1 : last_->t);
    return on;
  }
  /// Has an event ended the run?
  [[nodiscard]] bool ended() const { return finder_.ended(); }
  /// A run that an event has ended is a success.
  void finish(ivp::Solution& solution) const {
    if (!finder_.status().ok()) {
      solution.status = finder_.status();
    } else if (ended()) {
      solution.t = last_->t;
      solution.x = last_->x;
      solution.status = {};
    }
  }

 private:
  static std::vector<ivp::Event> events_of(const Request& request) {
    std::vector<ivp::Event> events;
    for (const WantedEvent& e : request.events)
      events.push_back(
          {[&e](double t, const ivp::State& x) { return e.value(t, x.data()); }, e.crossing, e.ends});
    return events;
  }

  // An event by the dense output, made as exact as the steps: the method itself goes from the begin of the
  // step to the time of the event, which Newton's iteration corrects.
  ivp::Hit refined(const ivp::Step& step, ivp::Hit hit) const {
    const StateFunction& g = request_.events[hit.event].value;
    const double way = step.t1 - step.t0, near = 1e-5 * way;
    const double from = std::abs(hit.t - step.t0) < std::abs(way) / 2 ? hit.t : hit.t - near;
    const double slope = (g(from + near, step.at(from + near).data()) - g(from, step.at(from).data())) / near;
    constexpr int most = 3;
    for (int k = 0; k < most && hit.t != step.t0; ++k) {
      const ivp::Solution there = run_(system_, step.x0, step.t0, hit.t, {}, request_.limits);
      if (!there.status.ok()) break;
      hit.x = there.x;
      const double change = -g(hit.t, hit.x.data()) / slope, next = hit.t + change;
      const bool inside = (next - step.t0) / way > 0 && (next - step.t0) / way <= 1;
      if (!inside || std::abs(change) <= std::numeric_limits<double>::epsilon() * std::abs(hit.t)) break;
      hit.t = next;
    }
    return hit;
  }

  const Request& request_;
  const ivp::NamedIntegrator& run_;
  const ivp::System& system_;
  Rows& rows_;
  Seen& seen_;
  ivp::EventFinder finder_;
  std::optional<ivp::Hit> last_;
};

}  // namespace nlmech::comparison

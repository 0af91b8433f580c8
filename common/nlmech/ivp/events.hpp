/// @file
/// Events: zeros of a function of time and state along a solution (landings, sections, impacts), and what
/// they do to the state.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/program/interval.hpp"

namespace nlmech::ivp {

/// Which zeros count, in the direction of the integration.
enum class Crossing {
  either,   ///< all, those too at which g touches zero
  rising,   ///< from negative to positive values
  falling,  ///< from positive to negative values
};

/// Bounds on a function g and on its derivative along solutions.
struct Enclosure {
  program::Interval value;  ///< of g
  program::Interval rate;   ///< of dg/dt
};

/// A function to watch.
struct Event {
  std::function<double(double t, const State& x)> value;  ///< g(t, x), continuous: the event is its zero
  Crossing crossing = Crossing::either;                   ///< which zeros count
  int ends = 0;  ///< the integration ends at the so-manieth that counts; 0: at none of them
  /// Bounds on g over a time and a box of states. With them no zero is passed over: a part of a step without
  /// one is a part where the bounds exclude it. Without them the signs of g at 8 places of a step decide.
  std::function<Enclosure(const program::Interval& t, std::span<const program::Interval> x)> bounds = {};
  /// What it makes of the state, which the integration goes on from; empty: it changes nothing.
  std::function<void(double t, State& x)> change = {};
  /// Bounds on dx/dt of the equations that the bounds go with, a component each: steps that stay far from a
  /// zero by them cost less.
  std::function<void(const program::Interval& t, std::span<const program::Interval> x,
                     std::span<program::Interval> slopes)>
      slopes = {};
};

/// An event that took place.
struct Hit {
  std::size_t event;  ///< its place in the list
  double t;           ///< when: at the zero or at most one spacing of doubles after it
  State x;            ///< the state
  int direction;      ///< 1 if g rises, -1 if it falls, 0 if it touches zero to within the tolerance
  State after = {};   ///< what the event makes of x; empty if it changes nothing
};

/// A part of an integration in which an event cannot be told from none.
struct OpenEvent {
  std::size_t event;  ///< its place in the list
  double t0;          ///< from
  double t1;          ///< to
};

/// How far the states of a run may be off.
struct StateAccuracy {
  double relative = 0;  ///< of |x_i|
  double absolute = 0;  ///< besides
};

/// Finds events in one step after another; an observer calls it. `integrate_with_events` is the usual way.
///
/// Where an event has bounds, the step is halved until each part has no zero by the bounds on g, or at most
/// one by those on dg/dt (interval bisection). The box of states of a part is that of the Chebyshev
/// polynomial of degree 7 through the dense output, where the last two coefficients show that it is resolved.
/// Zeros that remain open to within the accuracy of the states, double ones for instance, are hits of
/// direction 0 if g has a minimum or maximum there and the event counts both directions; else they are in
/// open().
///
/// A function that is zero where the integration starts makes no event there. Poles and jumps, where the sign
/// changes without a zero, are no events.
class EventFinder {
 public:
  /// @param run the method, by which the time of an event is made as accurate as the steps; empty: the dense
  /// output is good enough
  /// @throws std::invalid_argument for an event without a function
  explicit EventFinder(std::vector<Event> events, StateAccuracy accuracy = {}, SmoothRun run = {});

  /// Looks at a step of @p system; false if the run must stop in it: an event ends it or changes the state,
  /// or a value was not a number.
  [[nodiscard]] bool see(const System& system, const Step& step, const Limits& limits = {});
  /// How many functions are watched.
  [[nodiscard]] std::size_t events() const { return events_.size(); }
  /// What was found up to now, in the direction of travel.
  [[nodiscard]] const std::vector<Hit>& hits() const { return hits_; }
  /// Where an event could not be decided: the first such part of each event, up to the last one.
  [[nodiscard]] const std::vector<OpenEvent>& open() const { return open_; }
  /// Did the last hit end the integration?
  [[nodiscard]] bool ended() const { return ended_; }
  /// Did the last hit change the state? The integration goes on from Hit::after.
  [[nodiscard]] bool changed() const { return changed_; }
  /// To be called before the integration goes on from Hit::after. Where the change leaves the function at its
  /// zero, the event is over, on whichever side rounding has left it.
  void go_on();
  /// `non_finite` once a value was not a number; else success.
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  class Scan;
  /// States and times for which an event has no zero: a solution that comes from x0 to x1 within h and keeps
  /// x0 + [0, h/2] f and x1 - [0, h/2] f inside has none on its way (Moore 1966).
  struct SafeBox {
    program::Interval t{0};
    std::vector<program::Interval> x, slopes;
    std::vector<program::Interval> seen;  // the states so far
    int wait = 0, pause = 1;              // steps until the next one is looked for, and after that
  };
  void begin(double t, const State& x);
  bool stops_at(Hit& hit);
  void add_open(std::size_t event, double t0, double t1);

  std::vector<Event> events_;
  StateAccuracy accuracy_;
  SmoothRun run_;
  std::vector<int> signs_;              // of each function; 0: not known yet
  std::vector<int> counts_;             // of hits of each event
  std::vector<program::Interval> box_;  // of the states, of a part of a step
  Nodes samples_, coefficients_;        // of a part of a step
  std::vector<SafeBox> safe_;           // of each event
  std::vector<Hit> hits_;
  std::vector<OpenEvent> open_;
  Status status_;
  bool ended_ = false, changed_ = false, goes_on_ = false;
};

/// A run with its events.
struct EventSolution {
  Solution solution;            ///< ends at the asked time, or with success at the event that ends it
  std::vector<Hit> hits;        ///< in the direction of travel
  std::vector<OpenEvent> open;  ///< where events could not be decided
};

/// Integrates on after every event that changes the state.
/// @param run the method
/// @param finder whose see() @p observer calls for each step, and returns false when that does
/// @return as of @p run; `outside_validity` where events that change the state accumulate (a ball that
/// bounces ever faster); `non_finite` where a function is not a number
[[nodiscard]] Solution integrate_past_changes(const SmoothRun& run, const System& system, const State& x0,
                                              double t0, double t1, EventFinder& finder,
                                              const Observer& observer, const Limits& limits);

/// @p run with events that change the state, as an integration of its own; @p run itself if none does.
[[nodiscard]] SmoothRun with_changes(const SmoothRun& run, const std::vector<Event>& events,
                                     StateAccuracy accuracy);

/// The same with hits; for any integrator.
[[nodiscard]] EventSolution integrate_with_events(const SmoothRun& run, const System& system, const State& x0,
                                                  double t0, double t1, std::vector<Event> events,
                                                  StateAccuracy accuracy, const Observer& observer,
                                                  const Limits& limits);

/// integrate() with events. One that ends the integration makes a success of it: the solution's time and
/// state are those of the event, as accurate as the steps (a test asserts 16 eps of the time for an
/// oscillator by `series` at a tolerance of 1e-15).
/// @param observer sees every step, the one too in which an event ends the integration or changes the state
/// @throws std::invalid_argument as integrate(), and for an event without a function
template <class Method>
[[nodiscard]] EventSolution integrate_with_events(const System& system, const State& x0, double t0, double t1,
                                                  const Method& method, std::vector<Event> events,
                                                  const Observer& observer = {}, const Limits& limits = {}) {
  const SmoothRun run = [&method](const System& s, const State& x, double from, double to,
                                  const Observer& seen, const Limits& most) {
    return integrate(s, x, from, to, method, seen, most);
  };
  StateAccuracy accuracy;
  if constexpr (HasTolerances<Method>) {
    if (goes_by_tolerances(method)) accuracy = {method.relative_tolerance, method.absolute_tolerance};
  }
  return integrate_with_events(run, system, x0, t0, t1, std::move(events), accuracy, observer, limits);
}

}  // namespace nlmech::ivp

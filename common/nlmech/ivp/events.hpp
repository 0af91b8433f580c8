/// @file
/// Events: zeros of a function of time and state along a solution (landings, Poincare sections, impacts), and
/// the changes of the state at them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/program/interval.hpp"

namespace nlmech::ivp {

/// Which zeros count, in the direction of integration.
enum class Crossing {
  either,   ///< all zeros, including those at which g touches zero
  rising,   ///< from negative to positive values
  falling,  ///< from positive to negative values
};

/// Bounds on a function over a time and a box of states.
using BoundsOver =
    std::function<program::Interval(const program::Interval& t, std::span<const program::Interval> x)>;

/// An event function and its options.
struct Event {
  std::function<double(double t, const State& x)> value;  ///< g(t, x), continuous: the event is its zero
  Crossing crossing = Crossing::either;                   ///< direction of the zeros that count
  int ends = 0;  ///< the integration ends at this zero, counted from 1; 0: at none
  /// Does an end or a change take place only where g leaves zero by more than the errors of the states? A
  /// function that tends to zero does not.
  bool must_leave = false;
  /// Bounds on g. With them no zero is missed: a part of a step counts as free of zeros only if the bounds
  /// exclude them. Without them the signs of g at 8 points of a step decide.
  BoundsOver bounds = {};
  BoundsOver rate_bounds = {};  ///< bounds on dg/dt along solutions, if there are bounds on g
  /// Changes the state, from which the integration continues; empty: no change.
  std::function<void(double t, State& x)> change = {};
  /// Bounds on dx/dt of the same equations, one per component. They make steps cheaper that stay far from a
  /// zero.
  std::function<void(const program::Interval& t, std::span<const program::Interval> x,
                     std::span<program::Interval> slopes)>
      slopes = {};
};

/// A zero that was found.
struct Hit {
  std::size_t event;  ///< its place in the list
  double t;           ///< time: the zero, or at most one spacing of doubles after it
  State x;            ///< state at t
  int direction;      ///< 1 if g rises, -1 if it falls, 0 if it touches zero to within the tolerance
  State after = {};   ///< state after the change by the event; empty without a change
};

/// A part of an integration in which an event function is zero, or cannot be distinguished from zero.
struct OpenEvent {
  std::size_t event;   ///< its place in the list
  double t0;           ///< start of the part
  double t1;           ///< end of the part
  bool rests = false;  ///< is the function zero throughout? Otherwise zeros are undecided
};

/// Error bounds of the states of a run: relative |x_i| + absolute.
struct StateAccuracy {
  double relative = 0;  ///< relative to |x_i|
  double absolute = 0;  ///< absolute, added
};

/// Finds events step by step; called by an observer. `integrate_with_events` does all of this.
///
/// Where an event has bounds, the step is halved until each part has no zero by the bounds on g, or at most
/// one by those on dg/dt (interval bisection). The box of states of a part is that of the Chebyshev
/// polynomial of degree 7 through the dense output, if its last two coefficients are small enough. Zeros that
/// stay undecided within the accuracy of the states, such as double zeros, are hits of direction 0 if g has a
/// minimum or maximum there and the event counts both directions; otherwise they are in open(). Where a
/// function comes to rest at zero, as the level of a tank does, there is one hit, and the rest is in open().
/// So is the part in which a function that tends to zero, as 1 - erf(t), is zero by rounding.
///
/// A zero at the start of the integration is not an event. Poles and jumps, which change the sign without a
/// zero, are not events. Events at one time follow each other in the order of the list.
class EventFinder {
 public:
  /// @param run the method, which refines the time of an event to the accuracy of the steps where the dense
  /// output has less; empty: the dense output is accurate enough
  /// @throws std::invalid_argument for an event without a function
  explicit EventFinder(std::vector<Event> events, StateAccuracy accuracy = {}, SmoothRun run = {});

  /// Searches a step of @p system for events. @return false if the run must stop in it: an event ends it or
  /// changes the state, or a value is NaN
  [[nodiscard]] bool see(const System& system, const Step& step, const Limits& limits = {});
  /// Number of event functions.
  [[nodiscard]] std::size_t events() const { return events_.size(); }
  /// Events found so far, in the direction of integration.
  [[nodiscard]] const std::vector<Hit>& hits() const { return hits_; }
  /// Parts in which a function rests at zero, and for each event the undecided ones, from the start of the
  /// first to the end of the last.
  [[nodiscard]] const std::vector<OpenEvent>& open() const { return open_; }
  /// Did the last hit end the integration?
  [[nodiscard]] bool ended() const { return ended_; }
  /// Did the last hits, at one time, change the state? The integration continues from after().
  [[nodiscard]] bool changed() const { return changed_; }
  /// The state after the changes at the time of the last hit.
  [[nodiscard]] const State& after() const { return after_; }
  /// Call before the integration continues from after(). If the change leaves the function at its zero,
  /// that zero does not count again, for either sign by rounding.
  void go_on();
  /// `non_finite` after a NaN value; otherwise success.
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  class Scan;
  /// States and times without a zero of an event: a step from x0 to x1 of size h has no zero if the box holds
  /// x0 + [0, h/2] f and x1 - [0, h/2] f (Moore 1966).
  struct SafeBox {
    program::Interval t{0};
    std::vector<program::Interval> x, slopes;
    std::vector<program::Interval> seen;  // the states so far
    int uses = 0;                         // steps that the box held
    int wait = 0, pause = 1;              // steps until the next search for a box, and after that
  };
  void begin(double t, const State& x);
  // Did event @p i have a hit in the step that ended at @p t?
  [[nodiscard]] bool has_hit_before(std::size_t i, double t) const;
  bool stops_at(Hit& hit);
  std::vector<Hit>::iterator with_others_at_its_time(std::vector<Hit>::iterator hit);
  // @param is_zero is the function zero throughout?
  void add_open(std::size_t event, double t0, double t1, bool is_zero = false);
  void add_rest(std::size_t event, double t0, double t1);
  // The last rest of @p event, or null.
  OpenEvent* last_rest(std::size_t event);

  std::vector<Event> events_;
  StateAccuracy accuracy_;
  SmoothRun run_;
  std::vector<int> signs_;              // sign of each function; 0: not known yet
  std::vector<int> counts_;             // number of hits of each event
  std::vector<program::Interval> box_;  // bounds on the states in a part of a step
  State x_;                             // at one time
  State least_, most_;                  // changes within a step
  Nodes samples_, coefficients_;        // Chebyshev polynomial of a part of a step
  std::vector<SafeBox> safe_;           // one per event
  std::vector<Hit> hits_;
  std::vector<OpenEvent> open_;
  Status status_;
  State after_;
  double last_from_ = 0;        // start of the step before
  std::size_t changed_at_ = 0;  // the first hit at the time of the last change
  bool ended_ = false, changed_ = false, goes_on_ = false;
};

/// Solution and events.
struct EventSolution {
  Solution solution;            ///< ends at t1, or with success at the event that ends it
  std::vector<Hit> hits;        ///< events in the direction of integration
  std::vector<OpenEvent> open;  ///< parts in which events are undecided
};

/// Integrates and restarts after every event that changes the state.
/// @param run the method
/// @param finder @p observer calls its see() for each step and returns false if see() does
/// @return the solution of @p run; status `outside_validity` if events that change the state accumulate (a
/// ball that bounces ever faster), `non_finite` if a function is NaN
[[nodiscard]] Solution integrate_past_changes(const SmoothRun& run, const System& system, const State& x0,
                                              double t0, double t1, EventFinder& finder,
                                              const Observer& observer, const Limits& limits);

/// Wraps @p run so that it applies the events that change the state; returns @p run itself if none does.
[[nodiscard]] SmoothRun with_changes(const SmoothRun& run, const std::vector<Event>& events,
                                     StateAccuracy accuracy);

/// Integrates with events by any @p run and returns the hits.
[[nodiscard]] EventSolution integrate_with_events(const SmoothRun& run, const System& system, const State& x0,
                                                  double t0, double t1, std::vector<Event> events,
                                                  StateAccuracy accuracy, const Observer& observer,
                                                  const Limits& limits);

/// integrate() with events. An event that ends the integration ends it with success: the time and state of
/// the solution are those of the event, as accurate as the steps (a test asserts 16 eps of the time for an
/// oscillator by `series` at a tolerance of 1e-15).
/// @param observer receives every step, including one in which an event ends the integration or changes the
/// state
/// @throws std::invalid_argument as integrate() does, and for an event without a function
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
    if (uses_tolerances(method)) accuracy = {method.relative_tolerance, method.absolute_tolerance};
  }
  return integrate_with_events(run, system, x0, t0, t1, std::move(events), accuracy, observer, limits);
}

}  // namespace nlmech::ivp

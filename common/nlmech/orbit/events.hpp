/// @file
/// Events of an orbit: nodes, apsides and given distances from the centre.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "nlmech/ivp/events.hpp"
#include "nlmech/orbit/continuation.hpp"

namespace nlmech::orbit {

/// Kinds of events.
enum class EventKind {
  node,     ///< z = 0: the body crosses the plane of reference
  apsis,    ///< r.v = 0: the distance is smallest or largest
  distance  ///< |r| has a given value
};

/// An event that is searched for.
struct Event {
  EventKind kind = EventKind::node;  ///< what happens
  double distance = 0;               ///< |r| at an event of kind `distance`, positive; else unused
};

/// An event that was found.
struct Hit {
  std::size_t event;  ///< its place in the list
  /// Direction in time, also of backward propagation. 1: ascending node, periapsis, growing distance; -1:
  /// descending node, apoapsis, falling distance; 0: z, r.v or the distance touches its value to within the
  /// errors of the steps.
  int direction;
  double t;     ///< time of the event, or at most one spacing of doubles after it
  State state;  ///< state at t
};

/// Finds events step by step. The functions z, r.v and |r| and their rates are evaluated by the dense output
/// of the step and isolated by ivp::EventFinder on Chebyshev polynomials of degree 7 through them, so that no
/// event is missed, however many lie in a step. An event at the start is none. Tests compare times with
/// Kepler's equation: within 1e-12 of the time and of the period.
class EventFinder {
 public:
  /// @param events events to search for
  /// @param gravity the field of the propagation
  /// @param tolerance relative error of the states of a step. A function that is, with its rate, below 20
  /// + n/16 times that in step n is zero: a circle drifts by a few roundings in a hundred steps
  /// @throws std::invalid_argument for a distance that is not positive and finite
  EventFinder(std::vector<Event> events, const Gravity& gravity, double tolerance);
  ~EventFinder();
  EventFinder(const EventFinder&) = delete;             ///< not copied
  EventFinder& operator=(const EventFinder&) = delete;  ///< not copied

  /// Searches a step of a propagation, whose steps have the numbers 1, 2, ... @return false if a function is
  /// NaN
  [[nodiscard]] bool see(const Step& step);
  /// Events found so far, in the direction of propagation.
  [[nodiscard]] const std::vector<Hit>& hits() const { return hits_; }
  /// Times between which a function stays zero to within the errors: the nodes of an equatorial orbit, the
  /// apsides of a circular one. They have no hits.
  [[nodiscard]] const std::vector<ivp::OpenEvent>& open() const { return finder_.open(); }
  /// `non_finite` after a NaN (a body in the centre); otherwise success.
  [[nodiscard]] const Status& status() const { return finder_.status(); }

 private:
  class Functions;

  std::unique_ptr<Functions> functions_;
  ivp::EventFinder finder_;
  ivp::System system_;  // not evaluated
  ivp::State before_, after_;
  std::vector<Hit> hits_;
};

}  // namespace nlmech::orbit

/// @file
/// Parser of typed events with names, given times and changes of the state.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/ivp/events.hpp"

namespace nlmech::comparison {

/// A typed event.
struct WantedEvent {
  std::string name;                     ///< printed name: the typed one or the equation as typed
  ivp::Event event;                     ///< event for the integrator
  std::string equation;                 ///< its equation as typed: "x = 0"
  std::optional<double> at = {};        ///< time of the event, if it is one of a typed list of times
  std::set<Eigen::Index> changed = {};  ///< components that the event changes
};

/// Parses "x = 0", "apex: x' = 0 falling", "x = 0 end after 3", or "dose: t = 0:24:240", which is one event
/// per time.
/// @param option option named in messages @throws InputError that points at the mistake
[[nodiscard]] std::vector<WantedEvent> events_of(const std::string& option, const std::string& typed,
                                                 const UserProblem& problem);

/// Parses "bounce: y' = -0.8 y'; x' = 0.9 x'" and adds this change of the state to the events of that name.
/// Its right-hand sides use the state before the change; several changes of one event apply in order.
/// @throws InputError with the mistake
void add_change(const std::string& option, const std::string& typed, const UserProblem& problem,
                std::vector<WantedEvent>& events);

/// Adds the events of a line of a text of equations.
/// @throws InputError with the mistake
void add_line(const EventLine& line, const UserProblem& problem, std::vector<WantedEvent>& events);

/// Removes the lines "when x = 0 falling: x' -> -0.8 x'" and "at t = 0:24:240: x -> x + 5, n -> n + 1" from a
/// text of equations. Blanks replace them, so that messages point at the right places of the other lines.
[[nodiscard]] std::vector<EventLine> take_event_lines(std::string& text);

}  // namespace nlmech::comparison

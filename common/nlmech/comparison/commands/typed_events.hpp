/// @file
/// Events as users type them: with names, at given times, with changes of the state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/ivp/events.hpp"

namespace nlmech::comparison {

/// What a run is to watch.
struct WantedEvent {
  std::string name;               ///< as it is printed: its name, or the equation as typed
  ivp::Event event;               ///< the same
  std::optional<double> at = {};  ///< its time, if it was typed as one of a list of times
};

/// Events as typed: "x = 0", "apex: x' = 0 falling", "x = 0 end after 3", or "dose: t = 0:24:240", which is
/// one event for each time.
/// @param option named by messages @throws InputError that points at the mistake
[[nodiscard]] std::vector<WantedEvent> events_of(const std::string& option, const std::string& typed,
                                                 const UserProblem& problem);

/// "bounce: y' = -0.8 y'; x' = 0.9 x'": a change of the state at the events of that name. Values are those
/// before the event; changes of one event are done in their order.
/// @throws InputError that says what is wrong
void add_change(const std::string& option, const std::string& typed, const UserProblem& problem,
                std::vector<WantedEvent>& events);

/// Adds the event of a line of a text.
/// @throws InputError as the above
void add_line(const EventLine& line, const UserProblem& problem, std::vector<WantedEvent>& events);

/// Takes lines "when x = 0 falling: x' -> -0.8 x'" and "at t = 0:24:240: x -> x + 5, n -> n + 1" out of a
/// text of equations. Blanks stand in their place, so that messages point at the right places of the others.
[[nodiscard]] std::vector<EventLine> take_event_lines(std::string& text);

}  // namespace nlmech::comparison

/// @file
/// Integrations that end where their equations do, or rest there, and begin at singular points.
///
/// Three things are looked for:
///  - Arguments of square roots, powers with a fraction and arcs that reach zero along the solution: an empty
///    tank, h' = -sqrt(h). From there the equations with max(g, 0) in place of the argument g are integrated.
///    If their solution stays at g = 0, or comes back from there, it is the solution (the tank stays empty);
///    if g becomes negative, the run ends with `outside_validity` and the time at which it left. A zero that
///    the equations repel (x' = sqrt(x) near x = 0) is passed by.
///  - Denominators of the time alone that become zero on the way: the run ends with `outside_validity` if
///    the solution becomes infinite there or many solutions go on from there, as those of
///    sin(t) x' = cos(t) x beyond pi; it goes on where the quotient stays regular, as sin(t)/t does. At the
///    start the first part of the solution is a power series (singular_start.hpp).
///  - Denominators that depend on the state: the same where they change their sign; where a run fails beside
///  a
///    zero of one, its sentence says so.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "nlmech/ivp/events.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/graph.hpp"

namespace nlmech::ivp {

/// The expression @p node of @p graph as a function to watch, with bounds along solutions with the slopes
/// @p slopes: every zero counts, and nothing changes there.
[[nodiscard]] Event event_of(program::Graph graph, program::NodeId node,
                             const std::vector<program::NodeId>& slopes);

/// Where equations end, as functions to watch.
struct Domain {
  /// Nothing to watch.
  Domain() = default;
  /// Of these equations.
  explicit Domain(const program::Equations& equations);

  std::vector<Event> arguments;         ///< what must not be negative
  std::vector<Event> beyond_arguments;  ///< the same, with the rates of the equations beyond
  std::optional<System> beyond;         ///< the equations with max(g, 0) for each argument g, if there is one
  std::vector<Event> denominators;      ///< that depend on the state
  std::vector<Event> crossings;         ///< those of them that can have both signs
  std::vector<Event> timed;             ///< denominators of the time alone

  /// Must every step be looked at?
  [[nodiscard]] bool watches() const { return !arguments.empty() || !crossings.empty() || !timed.empty(); }
  /// Is there nothing to watch?
  [[nodiscard]] bool empty() const { return arguments.empty() && denominators.empty() && timed.empty(); }
};

/// @p run as it respects the domain of the equations that it integrates; @p run itself if there is nothing to
/// watch. The observer sees steps that end where something was found.
/// @param run a method
/// @param domain of the system that it will be given
/// @param accuracy of its states
/// @param rests becomes true when a solution comes to the zero of an argument and goes on; may be null
[[nodiscard]] SmoothRun within_domain(SmoothRun run, std::shared_ptr<const Domain> domain,
                                      StateAccuracy accuracy, bool* rests = nullptr);

/// Is there an argument that is zero at (t, x), from which the equations lead away although they may also
/// rest there, as x' = sqrt(x) from 0? Several solutions begin there.
/// @param direction of travel, 1 or -1
[[nodiscard]] bool several_begin(const Domain& domain, double t, const State& x, int direction);

}  // namespace nlmech::ivp

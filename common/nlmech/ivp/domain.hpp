/// @file
/// Domain of the equations: integrations that stop or rest at its boundary, or start at a singular point.
///
/// Three cases are detected:
///  - Arguments of square roots, powers with a fraction and arcs that reach zero along the solution: an empty
///    tank, h' = -sqrt(h). From there the equations with max(g, 0) in place of the argument g are integrated.
///    If their solution stays at g = 0, or comes back from there, it is the solution (the tank stays empty);
///    if g becomes negative, the run ends with `outside_validity` and the time at which it left, unless the
///    equations are defined there, as those with sqrt(max(h, 0)). A zero that repels the solution (x' =
///    sqrt(x) near x = 0) is ignored.
///  - Denominators that depend on time only and become zero between t0 and t1: the run ends with
///    `outside_validity` if the solution becomes infinite there or many solutions continue from there, as
///    those of sin(t) x' = cos(t) x beyond pi; it continues where the quotient stays regular, as sin(t)/t
///    does. If such a denominator is zero at the start, the first part of the solution is a power series
///    (singular_start.hpp).
///  - Factors of denominators that depend on the state: the same where they change sign (x of 1/x^2), and
///  where a
///    step passes through a zero of those that do not, as x^2 + y^2 of two bodies that collide. A run that
///    fails close to a zero of one, or of the argument of a logarithm, ends with `outside_validity` and the
///    time of that zero.
///  - Arguments of roots, powers with a fraction, arcs and logarithms that depend on time only: the run ends
///    with `outside_validity` at the time at which one leaves its domain.
///
/// The times in messages have the digits that the accuracy of the states leaves.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/ivp/events.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/graph.hpp"

namespace nlmech::ivp {

/// The expression @p node of @p graph as an event, with bounds along solutions of x' = @p slopes. Every zero
/// counts; the event does not change the state.
[[nodiscard]] Event event_of(program::Graph graph, program::NodeId node,
                             const std::vector<program::NodeId>& slopes);

/// Boundary of the domain of equations, as events.
struct Domain {
  /// No events.
  Domain() = default;
  /// Domain of @p equations.
  explicit Domain(const program::Equations& equations);

  std::vector<Event>
      arguments;            ///< arguments g of roots, powers and arcs; then g of roots of max(g, 0), abs(g)
  std::size_t corners = 0;  ///< index of the first g of a root of max(g, 0) or abs(g)
  std::vector<Event> beyond_arguments;  ///< the same, with the rates of the equations `beyond`
  std::optional<System> beyond;  ///< the equations with max(g, 0) for each argument g; none without arguments
  std::vector<Event> ends;       ///< state-dependent factors of denominators, and arguments of logarithms
  std::vector<std::vector<int>> components;  ///< the components of the state in each of them
  std::vector<std::string> names;            ///< of the components
  std::vector<Event> crossings;              ///< those factors that may become negative
  std::vector<std::size_t> sums;             ///< places in ends of the others, as x^2 + y^2
  std::vector<Event> timed;                  ///< factors of denominators that depend on time only
  std::vector<Event> timed_arguments;        ///< arguments that depend on time only

  /// Must every step be checked?
  [[nodiscard]] bool watches() const {
    return !arguments.empty() || !crossings.empty() || !timed.empty() || !timed_arguments.empty();
  }
  /// Are there no events?
  [[nodiscard]] bool empty() const { return ends.empty() && !watches(); }
};

/// Wraps @p run so that it respects the domain of its equations; returns @p run itself if the domain is
/// empty. A step in which a boundary is found is passed to the observer up to the boundary only.
/// @param run a method
/// @param domain of the system that the result will integrate
/// @param accuracy of the states of @p run
/// @param rests set to true when a solution reaches the zero of an argument and continues; may be null
[[nodiscard]] SmoothRun within_domain(SmoothRun run, std::shared_ptr<const Domain> domain,
                                      StateAccuracy accuracy, bool* rests = nullptr);

/// Do several solutions start at (t, x)? They do if an argument is zero there and the solution may rest there
/// or leave, as for x' = sqrt(x) and x' = sqrt(abs(x)) from 0.
/// @param direction of integration, 1 or -1
[[nodiscard]] bool several_begin(const Domain& domain, double t, const State& x, int direction);

}  // namespace nlmech::ivp

/// @file
/// Lambert's problem: conics from one position to another in a given time.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "nlmech/orbit/state.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::orbit {

/// Lambert's problem: positions, time of flight and mu. Any consistent units.
struct LambertProblem {
  Vector3<double> from;  ///< r_1, not 0
  Vector3<double> to;    ///< r_2, not 0
  double time = 0;       ///< time of flight, positive
  double mu = 1;         ///< gravitational parameter, positive
  /// Vector along the angular momentum of the short way. Used only if the positions are opposite to 8 eps and
  /// determine no plane; its component normal to the positions is used.
  std::optional<Vector3<double>> normal = std::nullopt;
};

/// Selects one of the two arcs with the same number of revolutions, one or more.
enum class LambertBranch {
  low,  ///< the arc of smaller semi-major axis
  high  ///< the arc of larger semi-major axis
};

/// Selects an arc.
struct LambertArc {
  bool long_way = false;                      ///< transfer angle above 180 degrees, without whole revolutions
  int revolutions = 0;                        ///< whole revolutions before the arrival, 0 or more
  LambertBranch branch = LambertBranch::low;  ///< unused for 0 revolutions
};

/// Solution of Lambert's problem for one arc.
struct LambertSolution {
  Vector3<double> v1{0, 0, 0};  ///< velocity at the departure; 0 after a failure
  Vector3<double> v2{0, 0, 0};  ///< velocity at the arrival; 0 after a failure
  double reciprocal_axis = 0;   ///< 1/a: negative for hyperbolas
  /// success; `infeasible` if that number of revolutions takes longer than the given time; `outside_validity`
  /// if the positions lie in one direction from the centre (0 or 360 degrees: the plane is undetermined, and
  /// the arc is a straight line), if they are opposite and no normal is given, if the time is so long or so
  /// short that the velocities in double precision do not determine it (64 kappa eps >= 1, as in
  /// propagate_kepler()), or if the arc passes the centre so closely that the rounding of v_1 determines the
  /// side (its component normal to r_1 is below 64 eps |v_1|, and 8 kappa eps > 1e-6)
  Status status;
  int iterations = 0;  ///< number of evaluations of the time of flight
};

/// Solves the problem by Izzo's method (D. Izzo, Revisiting Lambert's problem, Celest. Mech. Dyn. Astron. 121
/// (2015) 1-15): ellipses of any number of revolutions, parabolas, hyperbolas. Kepler motion from r_1 with
/// v_1 ends within 8 kappa eps |r_2| of r_2, with kappa of kepler_condition(), at most |r_2|/8; tests check
/// this for 10 000 random problems with up to 20 revolutions. After success the angular momentum has the
/// requested direction wherever the end depends on it. Every arc that doubles can resolve is found: bisection
/// replaces Householder's iteration where that does not converge. Parabolas of any angle are included.
/// @throws std::invalid_argument for a zero position, a time or mu not positive, values that are not finite,
/// a negative number of revolutions, and a normal along opposite positions
[[nodiscard]] LambertSolution solve_lambert(const LambertProblem& problem, const LambertArc& arc = {});

/// Shortest time of flight with @p revolutions whole revolutions, 1 or more, the short or long way between
/// the positions of @p problem, whose time is not used.
/// @return the time; NaN if the positions lie in one direction. @throws std::invalid_argument as
/// solve_lambert, and for less than one revolution
[[nodiscard]] double least_time(const LambertProblem& problem, bool long_way, int revolutions);

/// Are the positions of @p problem opposite to 8 eps, so that its normal is used? @throws
/// std::invalid_argument as solve_lambert; the time is not used
[[nodiscard]] bool are_opposite(const LambertProblem& problem);

/// An arc and its solution.
struct SolvedArc {
  LambertArc arc;            ///< the arc
  LambertSolution solution;  ///< always a success
};

/// All arcs with at most @p most_revolutions revolutions: the short way first, then by revolutions, low
/// before high. Arcs for which solve_lambert() fails are omitted. Empty if the positions determine no plane.
/// @throws std::invalid_argument as solve_lambert
[[nodiscard]] std::vector<SolvedArc> lambert_arcs(const LambertProblem& problem, int most_revolutions);

}  // namespace nlmech::orbit

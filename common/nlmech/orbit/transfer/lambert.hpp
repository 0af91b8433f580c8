/// @file
/// Lambert's problem: the conics that lead from one position to another in a given time.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "nlmech/orbit/state.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::orbit {

/// From where to where, and how long. Any consistent units.
struct LambertProblem {
  Vector3<double> from;  ///< r_1, not 0
  Vector3<double> to;    ///< r_2, not 0
  double time = 0;       ///< of flight, positive
  double mu = 1;         ///< gravitational parameter, positive
  /// A vector along the angular momentum of the short way. Read only where the positions are opposite to 8
  /// eps, so that they determine no plane; then the part of it across the positions counts.
  std::optional<Vector3<double>> normal = std::nullopt;
};

/// Which of the two arcs of the same number of revolutions, one or more.
enum class LambertBranch {
  low,  ///< the one of smaller semi-major axis
  high  ///< the other
};

/// Which arc.
struct LambertArc {
  bool long_way = false;                      ///< by more than 180 degrees, not counting whole revolutions
  int revolutions = 0;                        ///< whole ones before the arrival, 0 or more
  LambertBranch branch = LambertBranch::low;  ///< without meaning for 0 revolutions
};

/// An arc.
struct LambertSolution {
  Vector3<double> v1{0, 0, 0};  ///< velocity at the departure; 0 after a failure
  Vector3<double> v2{0, 0, 0};  ///< velocity at the arrival; 0 after a failure
  double reciprocal_axis = 0;   ///< 1/a: negative for hyperbolas
  /// success; `infeasible` if so many revolutions take longer than the given time; `outside_validity` if
  /// the positions lie in one direction from the centre (0 or 360 degrees: the plane is undetermined, and the
  /// arc a straight line), if they are opposite and no normal is given, if the time is so long or so short
  /// that the velocities in double precision do not tell it (64 kappa eps >= 1, as propagate_kepler() refuses
  /// it), or if the arc passes the centre so closely that the rounding of v_1 decides on which side it passes
  /// (less than 64 eps of it goes across r_1, and 8 kappa eps > 1e-6)
  Status status;
  int iterations = 0;  ///< evaluations of the time of flight
};

/// Solves the problem by Izzo's method (D. Izzo, Revisiting Lambert's problem, Celest. Mech. Dyn. Astron. 121
/// (2015) 1-15): ellipses of any number of revolutions, parabolas, hyperbolas. The positions that Kepler's
/// motion leads to from r_1 with v_1 are within 8 kappa eps |r_2| of r_2, kappa from kepler_condition(), an
/// eighth of |r_2| at most; tests hold 10 000 random problems with up to 20 revolutions to it. The angular
/// momentum of a success is on the side that was asked for, wherever the end depends on it. No arc is lost
/// that doubles can tell: where Householder's iteration does not converge, bisection does. A parabola of any
/// angle is an arc like others.
/// @throws std::invalid_argument for a position 0, a time or mu not positive, anything not finite, a number
/// of revolutions that is negative, and for a normal that is along the positions where it is read
[[nodiscard]] LambertSolution solve_lambert(const LambertProblem& problem, const LambertArc& arc = {});

/// The shortest time in which @p revolutions whole ones, 1 or more, can be made on the given way between the
/// positions of @p problem, whose time is not read.
/// @throws std::invalid_argument as solve_lambert, and for less than one revolution. Not a number if the
/// positions lie in one direction.
[[nodiscard]] double least_time(const LambertProblem& problem, bool long_way, int revolutions);

/// Are the positions of @p problem opposite to 8 eps, so that its normal is read? @throws
/// std::invalid_argument as solve_lambert; the time is not read
[[nodiscard]] bool are_opposite(const LambertProblem& problem);

/// An arc and its solution.
struct SolvedArc {
  LambertArc arc;            ///< which
  LambertSolution solution;  ///< always a success
};

/// All arcs with at most @p most_revolutions: the short way first, then by revolutions, low before high.
/// Arcs that solve_lambert() refuses are left out. Empty if the positions determine no plane.
/// @throws std::invalid_argument as solve_lambert
[[nodiscard]] std::vector<SolvedArc> lambert_arcs(const LambertProblem& problem, int most_revolutions);

}  // namespace nlmech::orbit

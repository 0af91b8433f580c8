/// @file
/// Partial derivatives of both velocities of a transfer by its positions and its time of flight.
#pragma once

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"

namespace nlmech::orbit {

/// Partial derivatives of the velocities v_1 at r_1 and v_2 at r_2 of a transfer in a given time; 0 after a
/// failure.
struct LambertPartials {
  Matrix<double, 3> v1_by_r1 = Matrix<double, 3>::Zero();  ///< d(v_1)/d(r_1), symmetric
  Matrix<double, 3> v1_by_r2 = Matrix<double, 3>::Zero();  ///< d(v_1)/d(r_2)
  Matrix<double, 3> v2_by_r1 = Matrix<double, 3>::Zero();  ///< d(v_2)/d(r_1) = -(d(v_1)/d(r_2))^T
  Matrix<double, 3> v2_by_r2 = Matrix<double, 3>::Zero();  ///< d(v_2)/d(r_2), symmetric
  Vector3<double> v1_by_time{0, 0, 0};                     ///< d(v_1)/d(time of flight)
  Vector3<double> v2_by_time{0, 0, 0};                     ///< d(v_2)/d(time of flight)
  /// Largest condition number of the block d(r_2)/d(v_1) in Frobenius' norm: growth of relative errors.
  double condition = 1;
  /// success; `singular_matrix` if the block d(r_2)/d(v_1) of the transition matrix is singular to rounding
  /// (64 eps times its condition number >= 1: a transfer by 180 degrees, whose plane a change of the
  /// positions turns by any angle; arrival at a point conjugate to the departure, as in the least time of an
  /// arc with revolutions, where two arcs merge; no time); failures of the propagation
  Status status = {};
};

/// Derivatives along any arc by its state-transition matrix: d(v_1)/d(r_2) is the inverse of the block
/// d(r_2)/d(v_1). Relative errors are those of the matrix times `condition`. As the action S of the arc has
/// v_1 = -dS/dr_1, v_2 = dS/dr_2 and the energy -dS/dt, derivatives by the time are gradients of the energy.
/// @param v1 velocity at the departure  @param v2 at the arrival
[[nodiscard]] LambertPartials lambert_partials(const TransitionMatrix& transition, const Vector3<double>& v1,
                                               const Vector3<double>& v2);

/// The same for a transfer: by Kepler's motion, or with zonal terms by series. Every arc of Lambert's
/// problem. Tests compare with differences in 50 digits.
/// @param v1 velocity at the departure, such as that of solve_lambert()
/// @throws std::invalid_argument as propagate_kepler() and propagate()
[[nodiscard]] LambertPartials lambert_partials(const TransferProblem& problem, const Vector3<double>& v1);

}  // namespace nlmech::orbit

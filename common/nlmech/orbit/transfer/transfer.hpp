/// @file
/// Transfers from one position to another in the field of a point mass or with zonal harmonics: by
/// collocation, or by correction of Lambert's arc.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::orbit {

/// Transfer problem: positions, time of flight and gravity field. Any consistent units.
struct TransferProblem {
  Vector3<double> from;  ///< r_0, not 0
  Vector3<double> to;    ///< r_F, not 0
  double time = 0;       ///< time of flight, positive
  Gravity gravity;       ///< point mass, or with zonal terms
  /// As in LambertProblem; also the plane of the initial guess `arc` for opposite positions.
  std::optional<Vector3<double>> normal = std::nullopt;
};

/// Largest miss of a successful transfer, relative to |r_F|.
inline constexpr double largest_miss = 1e-6;

/// A transfer, verified by propagation.
struct Transfer {
  Vector3<double> v1{0, 0, 0};  ///< velocity at the departure; 0 if none was found
  Vector3<double> v2{0, 0, 0};  ///< velocity at the arrival
  /// |r(t) - r_F| with r(t) propagated from r_0 with v_1: by Kepler's solution, or with zonal terms by
  /// adaptive analytic continuation. Infinite if the propagation fails.
  double miss = 0;
  /// success, or the failures of the function
  Status status;
  Statistics statistics;  ///< newton_iterations, jacobians, factorisations; seconds
};

/// Basis functions of the positions in collocation.
enum class TransferBasis {
  gaussian,  ///< Gaussian functions; differentiation matrix D by solving with their interpolation matrix, as
             ///< printed
  stable_gaussian,  ///< Gaussian functions with D computed without cancellation
  polynomial        ///< polynomials, the limit for shape 0
};

/// Form of the discrete equations.
enum class TransferEquations {
  positions_and_velocities,  ///< 6N, Eq. 5.37 of Elgohary 2015
  positions                  ///< 3(N - 2): velocities and end points eliminated
};

/// Initial guess of Newton's iteration.
enum class TransferGuess {
  line,   ///< straight line from r_0 to r_F
  arc,    ///< rotation about the centre the short way, with linear change of the distance
  ones,   ///< all unknowns 1
  random  ///< all unknowns normally distributed
};

/// Collocation at N Legendre-Gauss-Lobatto nodes, solved by Newton's iteration with full steps.
struct TransferCollocation {
  int nodes = 47;                                   ///< N, from 4 to 200
  TransferBasis basis = TransferBasis::polynomial;  ///< basis of the positions
  double shape = 0;  ///< shape parameter c T of Gaussian functions; 0: (N + 3)/4, as printed
  TransferEquations equations = TransferEquations::positions;  ///< which
  TransferGuess guess = TransferGuess::arc;                    ///< start
  /// Initial guess in place of `guess`, if not empty: position at t from 0 to the time of flight.
  std::function<Vector3<double>(double)> start = {};
  std::uint64_t seed = 1;    ///< seed of `random`
  double length_unit = 0;    ///< unit of length of the unknowns; 0: |r_0|
  double time_unit = 0;      ///< unit of time; 0: (length_unit^3/mu)^(1/2)
  int iterations = 60;       ///< limit of Newton iterations
  double tolerance = 1e-10;  ///< tolerance of an update, relative to 1 + |unknown|
  /// Largest miss of a success, relative to |r_F|; increase it to study coarse sets of nodes.
  double largest_miss = orbit::largest_miss;
};

/// Result of collocation.
struct CollocatedTransfer : Transfer {
  Eigen::VectorXd times;        ///< nodes, from 0 to the time of flight
  Eigen::Matrix3Xd positions;   ///< positions at the nodes
  Eigen::Matrix3Xd velocities;  ///< velocities at the nodes
  double condition = 1;         ///< condition number of the matrix of Gaussian functions; 1 for other bases
};

/// Solves @p problem by collocation. Status: success if the orbit with the computed velocity, propagated by
/// another method, misses r_F by at most `largest_miss` |r_F|; `spurious_root` if the solution of the
/// discrete equations is no orbit, or an under-resolved one; `newton_diverged`, `not_converged`, `non_finite`
/// or `singular_matrix` of Newton's iteration. The initial guess determines which arc is found.
/// @throws std::invalid_argument as solve_lambert, and for options out of range
[[nodiscard]] CollocatedTransfer collocate(const TransferProblem& problem,
                                           const TransferCollocation& method = {});

/// Lambert's arc, corrected for the zonal terms by Broyden's iteration on the miss with a first Jacobian by
/// differences, and by continuation in the size of the zonal terms where one correction does not converge
/// (many revolutions); without zonal terms the arc itself. Status: that of solve_lambert; `outside_validity`
/// if the propagated arc misses by more than `largest_miss` |r_F| because it is ill-conditioned (near
/// collisions, very many revolutions); `not_converged` if with zonal terms the miss does not fall below 1e-9
/// |r_F| (a transfer angle near 180 degrees, where the velocity out of the plane has no effect, or an arc
/// that grazes the centre), or if that takes more than 20 million steps. The tests reach misses within 1e-11
/// |r_F|.
/// @throws std::invalid_argument as solve_lambert, and for an invalid field
[[nodiscard]] Transfer corrected_transfer(const TransferProblem& problem, const LambertArc& arc = {});

/// @p problem in a plane that is asked for, where the positions are near 180 degrees apart and determine none
/// well: the arrival is projected onto the plane through the departure, and `normal` is its unit normal, the
/// component of @p normal across r_0. The distance to the arrival asked for is the caller's to report.
/// @throws std::invalid_argument for a normal that is not finite or along r_0, and an arrival along it
[[nodiscard]] TransferProblem in_plane(const TransferProblem& problem, const Vector3<double>& normal);

/// Turns the velocities of @p transfer about the positions into the plane of the normal of @p problem, as
/// from in_plane(). Beside 180 degrees rounding of the arrival turns the plane of an arc; turned back it
/// keeps its shape and, to rounding, its end. Renews the miss; status `outside_validity` if it exceeds
/// `largest_miss` |r_F|. A test asserts misses of 1e-13 |r_F|.
void turn_into_plane(const TransferProblem& problem, Transfer& transfer);

/// |r(t) - r_F| for the orbit from r_0 with @p v1; infinite if the propagation fails. @param v2 receives the
/// velocity at the arrival, if not null @throws std::invalid_argument as propagate()
[[nodiscard]] double miss_of(const TransferProblem& problem, const Vector3<double>& v1,
                             Vector3<double>* v2 = nullptr);

}  // namespace nlmech::orbit

/// @file
/// Transfers from one position to another in the field of a point mass or with zonal harmonics: by
/// collocation, and by correcting Lambert's arc.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::orbit {

/// From where to where, how long, and in which field. Any consistent units.
struct TransferProblem {
  Vector3<double> from;  ///< r_0, not 0
  Vector3<double> to;    ///< r_F, not 0
  double time = 0;       ///< of flight, positive
  Gravity gravity;       ///< point mass, or with zonal terms
  /// As of LambertProblem; also the plane of the start guess `arc` for opposite positions.
  std::optional<Vector3<double>> normal = std::nullopt;
};

/// A transfer whose integrated miss is a larger share of |r_F| is no success.
inline constexpr double largest_miss = 1e-6;

/// A transfer, verified by integration.
struct Transfer {
  Vector3<double> v1{0, 0, 0};  ///< velocity at the departure; 0 after a failure to find one
  Vector3<double> v2{0, 0, 0};  ///< velocity at the arrival
  /// |r(t) - r_F|, r(t) integrated from r_0 with v_1: by Kepler's solution, or with zonal terms by adaptive
  /// analytic continuation. Infinite if that does not arrive.
  double miss = 0;
  /// success, or as the function says
  Status status;
  Statistics statistics;  ///< newton_iterations, jacobians, factorisations; seconds
};

/// What the positions of collocation are combined of.
enum class TransferBasis {
  gaussian,         ///< Gaussian functions, D by solving with the matrix of them, as printed
  stable_gaussian,  ///< the same functions with D free of cancellation
  polynomial        ///< their limit for shape 0
};

/// Which equations are solved.
enum class TransferEquations {
  positions_and_velocities,  ///< 6N, Eq. 5.37 of Elgohary 2015
  positions                  ///< 3(N - 2): the same with velocities and ends eliminated
};

/// From where Newton's iteration starts.
enum class TransferGuess {
  line,   ///< straight from r_0 to r_F
  arc,    ///< turning about the centre the short way, the distance changing linearly
  ones,   ///< all unknowns 1
  random  ///< all unknowns normally distributed
};

/// Collocation at N Legendre-Gauss-Lobatto nodes, solved by Newton's iteration with full steps.
struct TransferCollocation {
  int nodes = 47;                                   ///< N, from 4 to 200
  TransferBasis basis = TransferBasis::polynomial;  ///< of the positions
  double shape = 0;                                 ///< c T of Gaussian functions; 0: (N + 3)/4, as printed
  TransferEquations equations = TransferEquations::positions;  ///< which
  TransferGuess guess = TransferGuess::arc;                    ///< start
  /// The start in place of `guess`, if not empty: position at t from 0 to the time of flight.
  std::function<Vector3<double>(double)> start = {};
  std::uint64_t seed = 1;    ///< of `random`
  double length_unit = 0;    ///< in which unknowns are 1; 0: |r_0|
  double time_unit = 0;      ///< 0: (length_unit^3/mu)^(1/2)
  int iterations = 60;       ///< limit of Newton iterations
  double tolerance = 1e-10;  ///< of an update, relative to 1 + |unknown|
  /// A miss beyond this share of |r_F| is no success; for studies of what coarse sets of nodes give, more.
  double largest_miss = orbit::largest_miss;
};

/// What collocation found.
struct CollocatedTransfer : Transfer {
  Eigen::VectorXd times;        ///< nodes, from 0 to the time of flight
  Eigen::Matrix3Xd positions;   ///< at the nodes
  Eigen::Matrix3Xd velocities;  ///< at the nodes
  double condition = 1;         ///< of the matrix of Gaussian functions; 1 for other bases
};

/// Solves @p problem by collocation. The status: success, if the orbit that leaves with the velocity found,
/// integrated by another method, misses r_F by less than `largest_miss` |r_F|; `spurious_root` if the
/// discrete equations are solved by what is no orbit, or by one that is not resolved; `newton_diverged`,
/// `not_converged`, `non_finite` or `singular_matrix` of Newton's iteration. Which of the arcs is found is up
/// to the start.
/// @throws std::invalid_argument for what solve_lambert refuses, nodes or numbers out of range
[[nodiscard]] CollocatedTransfer collocate(const TransferProblem& problem,
                                           const TransferCollocation& method = {});

/// Lambert's arc corrected for the zonal terms by Broyden's iteration on the miss, with a first Jacobian by
/// differences, over parts of the zonal terms where all of them at once are too much (many
/// revolutions); without zonal terms the arc itself. The status: that of solve_lambert; `outside_validity` if
/// the arc, integrated, misses by more than `largest_miss` |r_F|, because its condition leaves no more digits
/// (near collisions, very many revolutions); `not_converged` if with zonal terms the miss does not fall below
/// 1e-9 |r_F| (a transfer by nearly 180 degrees, where the velocity out of the plane has no effect, or one
/// that grazes the centre), or if that takes more than 20 million steps. Transfers of the test are integrated
/// to within 1e-11 |r_F|.
/// @throws std::invalid_argument as solve_lambert, and for a field that cannot be meant
[[nodiscard]] Transfer corrected_transfer(const TransferProblem& problem, const LambertArc& arc = {});

/// |r(t) - r_F| for the orbit from r_0 with @p v1; infinite if it does not arrive. @param v2 its velocity
/// there, if not null @throws std::invalid_argument as propagate()
[[nodiscard]] double miss_of(const TransferProblem& problem, const Vector3<double>& v1,
                             Vector3<double>* v2 = nullptr);

}  // namespace nlmech::orbit

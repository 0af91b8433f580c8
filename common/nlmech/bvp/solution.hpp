/// @file
/// Result of solve(): the solution on its mesh, its error measures, and interpolation in time.
#pragma once

#include <memory>
#include <vector>

#include "nlmech/bvp/newton/newton_system.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::bvp {

/// Side of the limit at a point between two phases.
enum class Side : std::uint8_t {
  before,  ///< from the left
  after    ///< from the right
};

/// Solution of a boundary value problem, or the last iterate of a failed iteration.
struct Solution {
  Status status;          ///< success, or the failure, its place and a remedy
  Statistics statistics;  ///< work: newton_iterations, factorisations, right_hand_sides; steps counts meshes
  Unknowns unknowns;      ///< mesh with all values; empty if nothing could be evaluated
  std::shared_ptr<const Scheme> scheme;  ///< scheme of every interval; null while unknowns is empty
  /// max over time and components of |u' - f(t, u)| / max |f|, measured between the nodes. The size of f is
  /// at least the bound of its rounding errors, 200 unit roundoffs of `terms`, over the tolerance.
  double residual = 0;
  /// For each state the largest sum over time of |df_i/dx_j x_j| and |df_i/dp_j p_j|.
  Eigen::VectorXd terms;
  /// max over the mesh of |x - integrated x| / max |x|, by component; see Verification. The size of x is at
  /// least that which errors of the integrator, 1e-13, have by `terms`, over the tolerance. 0 if not
  /// integrated.
  double integration_error = 0;
  Eigen::VectorXd integrated_end;  ///< integrated x at the end; empty if the end was not reached
  /// Rough reciprocal condition number of the reduced system of the last Newton matrix: its negative decimal
  /// logarithm is the number of digits lost.
  double pivot_ratio = 0;

  /// The unknown constants.
  [[nodiscard]] const Eigen::VectorXd& parameters() const { return unknowns.parameters; }
  /// First time.
  [[nodiscard]] double begin() const { return unknowns.intervals.front().t0; }
  /// Last time.
  [[nodiscard]] double end() const { return unknowns.intervals.back().t0 + unknowns.intervals.back().h; }
  /// x(t_0).
  [[nodiscard]] Eigen::VectorXd first() const { return unknowns.intervals.front().values.col(0); }
  /// x(t_K).
  [[nodiscard]] Eigen::VectorXd last() const { return unknowns.intervals.back().values.rightCols(1); }
  /// x at the time @p t in [begin, end], with the accuracy of the interpolant.
  [[nodiscard]] Eigen::VectorXd at(double t, Side side = Side::after) const;
  /// Ends of all intervals, ascending, without duplicates.
  [[nodiscard]] std::vector<double> mesh() const;
  /// Times of all nodes, ascending, without duplicates.
  [[nodiscard]] std::vector<double> node_times() const;
  /// States at node_times(), one per column. At a jump the value before it.
  [[nodiscard]] Eigen::MatrixXd node_values() const;
  /// Integral of g(t, x(t)) over [begin, end] by the quadrature of the nodes, which has the order of the
  /// values at the ends of intervals.
  [[nodiscard]] double integral(const std::function<double(double, const Eigen::VectorXd&)>& g) const;
};

/// Start for another problem with the same states: the solution on its mesh, with times mapped linearly to
/// the new ends if these differ.
/// @param solution solution; copied
[[nodiscard]] Start start_from(const Solution& solution);

}  // namespace nlmech::bvp

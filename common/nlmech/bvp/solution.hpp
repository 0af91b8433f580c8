/// @file
/// What solve() gives back: the solution on its mesh, how good it is, and its values at any time.
#pragma once

#include <memory>
#include <vector>

#include "nlmech/bvp/newton/newton_system.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::bvp {

/// Which limit is meant at a point between two phases.
enum class Side : std::uint8_t {
  before,  ///< from the left
  after    ///< from the right
};

/// A solution of a boundary value problem, or how far the iteration came.
struct Solution {
  Status status;          ///< success, or which failure, where, and what to change
  Statistics statistics;  ///< work: newton_iterations, factorisations, right_hand_sides; steps: meshes
  Unknowns unknowns;      ///< the mesh with all values; empty if nothing could be evaluated
  std::shared_ptr<const Scheme> scheme;  ///< of every interval; null as long as unknowns is empty
  /// max over time and components of |u' - f(t, u)| / (1 + max |f|), measured between the nodes.
  double residual = 0;
  /// max over the mesh of |x - integrated x| / (1 + max |x|), by component; see Integration. 0 if it was not
  /// integrated.
  double integration_error = 0;
  Eigen::VectorXd integrated_end;  ///< x at the end of the integration; empty if it was not integrated so far
  /// Reciprocal condition of the end system of Newton's last matrix, roughly: digits of it are lost.
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
  /// x at the time @p t in [begin, end], in the accuracy of the interpolant.
  [[nodiscard]] Eigen::VectorXd at(double t, Side side = Side::after) const;
  /// Ends of all intervals, ascending, each once.
  [[nodiscard]] std::vector<double> mesh() const;
  /// All nodes in order of time; the right end of an interval is left out where the next one begins with the
  /// same value.
  [[nodiscard]] std::vector<double> node_times() const;
  /// The states at node_times(), one a column. At a jump the value before it.
  [[nodiscard]] Eigen::MatrixXd node_values() const;
  /// The integral of g(t, x(t)) over the whole time, by the quadrature of the nodes: of the order of the
  /// values at the ends of intervals.
  [[nodiscard]] double integral(const std::function<double(double, const Eigen::VectorXd&)>& g) const;
};

/// The solution as a start of another problem with the same states: on its own mesh, times mapped linearly to
/// the new ends if these differ. @param solution is copied
[[nodiscard]] Start start_from(const Solution& solution);

}  // namespace nlmech::bvp

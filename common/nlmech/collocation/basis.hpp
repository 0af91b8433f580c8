/// @file
/// Trial functions for collocation in time on the unit interval: common interface of polynomials and radial
/// functions.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/radial_basis.hpp"

namespace nlmech::collocation {

/// N functions on [0, 1] that interpolate values at N nodes. For an interval of length h divide derivative()
/// by h; a radial basis then has the shape c with c h = relative_shape.
class Basis {
 public:
  /// Polynomials of degree N - 1: the limit of all radial functions for vanishing shape, without their loss
  /// of digits.
  /// @throws std::invalid_argument unless 2 <= n <= max_nodes
  [[nodiscard]] static Basis polynomial(NodeFamily family, int n);

  /// Radial functions centred at the nodes.
  /// @param family family of the nodes
  /// @param n number of nodes, 2 to max_nodes
  /// @param kernel radial function
  /// @param relative_shape c times the length of the interval; > 0
  /// @param inversion computation of the derivative matrix
  /// @throws std::invalid_argument for n or the shape out of range
  [[nodiscard]] static Basis radial(NodeFamily family, int n, Kernel kernel, double relative_shape,
                                    Inversion inversion = Inversion::solve);

  /// Success, or a failure if a radial basis of this shape is unusable in double precision: see
  /// Differentiation.
  [[nodiscard]] const Status& status() const noexcept { return status_; }
  /// Nodes from 0 to 1, ascending.
  [[nodiscard]] const Eigen::VectorXd& nodes() const noexcept { return nodes_; }
  /// Matrix that maps values at the nodes to derivatives at the nodes. Unreliable unless status() is a
  /// success; empty if not finite.
  [[nodiscard]] const Eigen::MatrixXd& derivative() const noexcept { return derivative_; }
  /// Condition number of the matrix of radial functions; 1 for polynomials.
  [[nodiscard]] double condition() const noexcept { return condition_; }
  /// Interpolation row r: r X is the interpolant at @p tau in [0, 1] of the values X at the nodes.
  /// @throws std::logic_error unless status() is a success
  [[nodiscard]] Eigen::RowVectorXd row(double tau) const;

 private:
  Basis() = default;

  Eigen::VectorXd nodes_, weights_;
  Eigen::MatrixXd derivative_;
  std::optional<RadialBasis<double>> radial_;
  double condition_ = 1;
  Status status_;
};

}  // namespace nlmech::collocation

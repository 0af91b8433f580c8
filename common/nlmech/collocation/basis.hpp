/// @file
/// Trial functions of collocation in time on the unit interval: polynomials, or radial functions, behind one
/// face.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/radial_basis.hpp"

namespace nlmech::collocation {

/// N functions on [0, 1] that interpolate values at N nodes. For an interval of length h derivative() is to
/// be divided by h; a radial basis then has the shape c with c h = relative_shape.
class Basis {
 public:
  /// Polynomials of degree N - 1: the limit of all radial functions for a vanishing shape, without their loss
  /// of digits.
  /// @throws std::invalid_argument unless 2 <= n <= max_nodes
  [[nodiscard]] static Basis polynomial(NodeFamily family, int n);

  /// Radial functions centred at the nodes.
  /// @param family where the nodes stand
  /// @param n number of nodes, 2 to max_nodes
  /// @param kernel which radial function
  /// @param relative_shape c times the length of the interval; > 0
  /// @param inversion how the derivative matrix is formed
  /// @throws std::invalid_argument for n or the shape out of range
  [[nodiscard]] static Basis radial(NodeFamily family, int n, Kernel kernel, double relative_shape,
                                    Inversion inversion = Inversion::solve);

  /// Success, or why a radial basis of this shape is of no use in double precision: see Differentiation.
  [[nodiscard]] const Status& status() const noexcept { return status_; }
  /// From 0 to 1, ascending.
  [[nodiscard]] const Eigen::VectorXd& nodes() const noexcept { return nodes_; }
  /// Values at the nodes to derivatives there. Under a failing status not to be relied on; empty if not
  /// finite.
  [[nodiscard]] const Eigen::MatrixXd& derivative() const noexcept { return derivative_; }
  /// Condition of the matrix of radial functions; 1 for polynomials, which need none.
  [[nodiscard]] double condition() const noexcept { return condition_; }
  /// The row r with which r X is the interpolant at @p tau in [0, 1] to the values X at the nodes.
  /// @throws std::logic_error if status() is no success
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

/// @file
/// Interpolation by Gaussian functions of any width, and its derivative, without loss of digits.
#pragma once

#include <vector>

#include "nlmech/collocation/matrix.hpp"
#include "nlmech/collocation/radial/gaussian_cardinals.hpp"

namespace nlmech::collocation {

/// The span of exp(-c^2 (t - t_k)^2) at nodes t_1 < ... < t_n, in double precision for all shapes c: from 0,
/// where it is that of the polynomials of degree n - 1, to functions as narrow as a two-hundredth of the
/// interval.
///
/// It serves the purpose of RBF-QR (Fornberg, Larsson & Flyer, SIAM J. Sci. Comput. 33 (2011)) by other
/// means, which one dimension allows: the matrix Phi is totally positive, and GaussianCardinals computes the
/// cardinal functions without a subtraction; those left of their nodes by reflection. So each off-diagonal
/// entry of D has a small relative error, though Phi may have a condition of 1e1400. D phi_i = 0 at t_i gives
/// the entries on the diagonal.
class StableGaussian {
 public:
  /// The largest c times the length of the interval. Narrower functions are what RadialBasis is for.
  static constexpr double largest_shape = 200;

  /// Computes D in n^2 M steps: 10 ms for 35 nodes and 0.1 s for 100, three times that for the narrowest
  /// functions.
  /// @param times nodes, ascending; 2 to max_nodes of them
  /// @param shape c of Eq. 4.8, 1/time; 0 <= c (t_n - t_1) <= largest_shape
  /// @throws std::invalid_argument if the times are too few, too many, not finite, not ascending or too close
  /// to each other for barycentric_weights, or the shape is out of range
  StableGaussian(const Eigen::VectorXd& times, double shape);

  /// The nodes.
  [[nodiscard]] const Eigen::VectorXd& times() const noexcept { return times_; }

  /// D with which D X is the derivative at the nodes of the interpolant to the values X (Eq. 4.15); 1/time.
  /// For 2 to 100 nodes of the families of nodes.hpp and c times the interval from 1e-6 to 100, entries are
  /// within 1e-12 of the largest one, and each off the diagonal relatively within 2e-11.
  [[nodiscard]] const Eigen::MatrixXd& differentiation_matrix() const noexcept { return derivative_; }

  /// The row r with which r X is the interpolant's value at @p t to the values X at the nodes. At a node it
  /// is a row of the unit matrix. Its entries are relatively within 2e-11. Takes n M steps and
  /// allocates.
  /// @throws std::invalid_argument unless t is within the interval of the nodes
  void row(double t, RowVector<double>& row) const;

  /// 1/(Phi^-1)_ii for each node, of which leave-one-out errors are made: what is left of the function at
  /// node i beyond the span of the others. Relatively within 1e-10; takes n^3 M steps. None for polynomials.
  [[nodiscard]] std::vector<Wide> last_pivots() const {
    return sides_.empty() ? std::vector<Wide>() : sides_.front().last_pivots();
  }

  /// How many powers were summed: M of PositiveKernel; n for polynomials.
  [[nodiscard]] Eigen::Index terms() const noexcept {
    return sides_.empty() ? times_.size() : sides_.front().terms();
  }

 private:
  void differentiate(double shape);

  Eigen::VectorXd times_, weights_;
  std::vector<GaussianCardinals> sides_;  // from the left; from the right. None for polynomials.
  Eigen::MatrixXd derivative_;
};

}  // namespace nlmech::collocation

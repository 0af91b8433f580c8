/// @file
/// Interpolation by Gaussian functions of any width, and its derivative, without loss of digits.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "nlmech/collocation/wide.hpp"

namespace nlmech::collocation {

/// The functions K(x, x_j) = sum_{k=1..M} s_k x^(k-1) x_j^(k-1), s_k > 0, at nodes x_1, ..., x_n >= 0.
///
/// Their cardinal functions are those of the polynomials times a factor. With the divided differences
/// K[x_1..x_m; x_1..x_n] = (U S U^T)_mn, where row m of U holds the complete symmetric polynomials of
/// x_1..x_m and S the s_k, that factor follows from the last row of the inverse of the triangular factor of
/// U S U^T. Its inverse T, but for the signs of a chessboard, is a product of the bidiagonal matrices
/// R_m = I + x_m (superdiagonal from row m on): T = R_n^T .. R_1^T S^-1 R_1 .. R_n. It is factored into
/// W Gamma W^T, W upper triangular, by passing one R_m^T after the other through the factors of W. Each
/// passage is a recurrence of Rutishauser's kind that adds, multiplies and divides positive numbers, so that
/// every result has a small relative error, some (n + M) times 2.2e-16, whatever the condition of the matrix
/// (compare P. Koev, SIAM J. Matrix Anal. Appl. 29 (2007), on totally positive matrices).
class PositiveKernel {
 public:
  /// Factorises; n^2 M/2 steps.
  /// @param nodes not negative, different from each other, n of them; the smallest need not come first
  /// @param ratios s_k/s_(k+1), k = 1..M-1, positive; M > n + 1. Terms beyond M must not matter.
  PositiveKernel(std::vector<Wide> nodes, std::vector<Wide> ratios);

  /// How much the cardinal functions of the kernel exceed those of polynomials: for a point x > x_j, the
  /// former is the latter times 1 + (x - x_j) g_j with
  ///     g_j = sum_{k=j..n} v_k prod_{m=k+1..n} |x_m - x_j|.
  /// @param x a point, not negative
  /// @return v_1..v_n
  [[nodiscard]] std::vector<Wide> excess(Wide x) const;

  /// Gamma_n in units of 1/s_1. Its inverse, times the product of (x_n - x_m)^2, is the last pivot of the
  /// matrix K(x_i, x_j), eliminated in their order.
  [[nodiscard]] Wide last_gamma() const noexcept { return last_gamma_; }

  /// M.
  [[nodiscard]] std::size_t terms() const noexcept { return ratios_.size() + 1; }

 private:
  void absorb(std::size_t m, std::vector<Wide>& gamma);

  std::vector<Wide> nodes_, ratios_;
  std::vector<std::vector<Wide>> factors_;  // of W: the superdiagonal of each
  Wide last_gamma_ = 1.0;
};

/// A Gaussian of the difference of two times as weight(s) K(x(s), x(t)) weight(t), where K is a power series
/// with positive coefficients and x grows with the time:
///     exp(-c^2 (s - t)^2) = exp(-c^2 s^2) (sum_k (2 c^2)^k/k! s^k t^k) exp(-c^2 t^2), for wide functions;
///     the same = C sum_q exp(-2 c^2 (s - qh)^2) exp(-2 c^2 (t - qh)^2), for narrow ones: by the trapezoidal
///     rule, and a power series in exp(4 c^2 h s) exp(4 c^2 h t).
/// The step h makes the rule's error, 2 exp(-(pi/(2 c h))^2), far smaller than the smallest pivot of the
/// matrix. Of the two, the one with fewer terms is taken.
class GaussianCardinals {
 public:
  /// @param times nodes, ascending
  /// @param shape c > 0, 1/time; c times the interval at least 1e-10
  GaussianCardinals(Eigen::VectorXd times, double shape);

  /// The derivatives at node @p i of the cardinal functions of the nodes 0..i-1; 1/time.
  [[nodiscard]] Eigen::VectorXd derivatives(Eigen::Index i) const;

  /// 1/(Phi^-1)_ii for each i: the last pivot of Phi if node i comes last. n^3 M/2 steps.
  [[nodiscard]] std::vector<Wide> last_pivots() const;

  /// How many powers were summed.
  [[nodiscard]] Eigen::Index terms() const noexcept { return static_cast<Eigen::Index>(kernel_.terms()); }

 private:
  /// Which power series: x = c (t - t_1) if rate is 0, else exp(rate c (t - t_n)).
  struct Series {
    double rate = 0;
    double offset = 0;         // the weight is exp(-(c (t - t_1) + offset)^2), or its square if rate > 0
    std::vector<Wide> ratios;  // of its coefficients
  };
  [[nodiscard]] static Series choose(Eigen::Index n, double width, double digits);
  [[nodiscard]] PositiveKernel factorised();
  [[nodiscard]] Wide last_pivot(const PositiveKernel& kernel, Eigen::Index last) const;
  [[nodiscard]] Wide gap(double t, double u) const;
  [[nodiscard]] Wide coordinate(double t) const;

  Eigen::VectorXd times_;
  double shape_;
  Series series_;
  std::vector<Wide> gaps_, products_;  // |x_m - x_j| at n m + j; its product over m != j
  PositiveKernel kernel_;
};

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

  Eigen::VectorXd times_;
  std::vector<GaussianCardinals> sides_;  // from the left; from the right. None for polynomials.
  Eigen::MatrixXd derivative_;
};

}  // namespace nlmech::collocation

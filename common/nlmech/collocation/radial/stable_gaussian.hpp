/// @file
/// Interpolation by Gaussian functions of any width, and its derivative, without loss of digits.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "nlmech/collocation/wide.hpp"

namespace nlmech::collocation {

/// Kernel K(x, x_j) = sum_{k=1..M} s_k x^(k-1) x_j^(k-1), s_k > 0, at nodes x_1, ..., x_n >= 0.
///
/// The cardinal functions are those of the polynomials times a factor. The divided differences are
/// K[x_1..x_m; x_1..x_n] = (U S U^T)_mn, where row m of U contains the complete symmetric polynomials of
/// x_1..x_m and S the s_k. The factor follows from the last row of the inverse of the triangular factor of U
/// S U^T. The inverse T, up to checkerboard signs, is a product of the bidiagonal matrices R_m = I + x_m
/// (superdiagonal from row m on): T = R_n^T .. R_1^T S^-1 R_1 .. R_n. It is factorised into W Gamma W^T, W
/// upper triangular, by passing each R_m^T in turn through the factors of W. Each passage is a qd-type
/// (Rutishauser) recurrence of sums, products and quotients of positive numbers. So every result has a small
/// relative error, about (n + M) times 2.2e-16, for every condition number of the matrix (compare P. Koev,
/// SIAM J. Matrix Anal. Appl. 29 (2007), on totally positive matrices).
class PositiveKernel {
 public:
  /// Factorises in n^2 M/2 operations.
  /// @param nodes n nodes, non-negative and distinct, in any order
  /// @param ratios s_k/s_(k+1), k = 1..M-1, positive; M > n + 1. Terms beyond M must be negligible.
  PositiveKernel(std::vector<Wide> nodes, std::vector<Wide> ratios);

  /// Ratio of the cardinal functions of the kernel to those of polynomials. For a point x > x_j it is
  /// 1 + (x - x_j) g_j with
  ///     g_j = sum_{k=j..n} v_k prod_{m=k+1..n} |x_m - x_j|.
  /// @param x point, non-negative
  /// @return v_1..v_n
  [[nodiscard]] std::vector<Wide> excess(Wide x) const;

  /// Gamma_n in units of 1/s_1. Its inverse times the product of (x_n - x_m)^2 is the last pivot of the
  /// matrix K(x_i, x_j), eliminated in the order of the nodes.
  [[nodiscard]] Wide last_gamma() const noexcept { return last_gamma_; }

  /// Number of terms M.
  [[nodiscard]] std::size_t terms() const noexcept { return ratios_.size() + 1; }

 private:
  void absorb(std::size_t m, std::vector<Wide>& gamma);

  std::vector<Wide> nodes_, ratios_;
  std::vector<std::vector<Wide>> factors_;  // superdiagonals of the factors of W
  Wide last_gamma_ = 1.0;
};

/// Cardinal functions of Gaussians. The Gaussian of s - t is weight(s) K(x(s), x(t)) weight(t), where K is a
/// power series with positive coefficients and x increases with time:
///     exp(-c^2 (s - t)^2) = exp(-c^2 s^2) (sum_k (2 c^2)^k/k! s^k t^k) exp(-c^2 t^2), for wide functions;
///     the same = C sum_q exp(-2 c^2 (s - qh)^2) exp(-2 c^2 (t - qh)^2), for narrow ones: by the trapezoidal
///     rule, and a power series in exp(4 c^2 h s) exp(4 c^2 h t).
/// The step h makes the error of the trapezoidal rule, 2 exp(-(pi/(2 c h))^2), far smaller than the smallest
/// pivot of the matrix. The form with fewer terms is used.
class GaussianCardinals {
 public:
  /// @param times nodes, ascending
  /// @param shape c > 0, 1/time; c times the interval at least 1e-10
  GaussianCardinals(Eigen::VectorXd times, double shape);

  /// Derivatives at node @p i of the cardinal functions of the nodes 0..i-1; 1/time.
  [[nodiscard]] Eigen::VectorXd derivatives(Eigen::Index i) const;

  /// 1/(Phi^-1)_ii for each i: the last pivot of Phi if node i is eliminated last. n^3 M/2 operations.
  [[nodiscard]] std::vector<Wide> last_pivots() const;

  /// Number of powers in the series.
  [[nodiscard]] Eigen::Index terms() const noexcept { return static_cast<Eigen::Index>(kernel_.terms()); }

 private:
  /// Power series: x = c (t - t_1) if rate is 0, else exp(rate c (t - t_n)).
  struct Series {
    double rate = 0;
    double offset = 0;         // the weight is exp(-(c (t - t_1) + offset)^2), or its square if rate > 0
    std::vector<Wide> ratios;  // ratios of successive coefficients
  };
  [[nodiscard]] static Series choose(Eigen::Index n, double width, double digits);
  [[nodiscard]] PositiveKernel factorised();
  [[nodiscard]] Wide last_pivot(const PositiveKernel& kernel, Eigen::Index last) const;
  [[nodiscard]] Wide gap(double t, double u) const;
  [[nodiscard]] Wide coordinate(double t) const;

  Eigen::VectorXd times_;
  double shape_;
  Series series_;
  std::vector<Wide> gaps_, products_;  // |x_m - x_j| at n m + j; products over j != m
  PositiveKernel kernel_;
};

/// Interpolation by exp(-c^2 (t - t_k)^2) at nodes t_1 < ... < t_n, in double precision for all shapes c:
/// from 0, where the interpolants are the polynomials of degree n - 1, to functions as narrow as a
/// two-hundredth of the interval.
///
/// An alternative to RBF-QR (Fornberg, Larsson & Flyer, SIAM J. Sci. Comput. 33 (2011)) in one dimension,
/// where the matrix Phi is totally positive: GaussianCardinals computes the cardinal functions to the right
/// of their nodes without subtractions, and reflection gives those to the left. So each off-diagonal entry of
/// D has a small relative error even if the condition number of Phi is 1e1400. D phi_i = 0 at t_i gives the
/// diagonal entries.
class StableGaussian {
 public:
  /// Largest c times the length of the interval. For narrower functions use RadialBasis.
  static constexpr double largest_shape = 200;

  /// Computes D in n^2 M operations: 10 ms for 35 nodes and 0.1 s for 100; three times as long for the
  /// narrowest functions.
  /// @param times nodes, ascending; 2 to max_nodes of them
  /// @param shape c of Eq. 4.8, 1/time; 0 <= c (t_n - t_1) <= largest_shape
  /// @throws std::invalid_argument if the times are too few, too many, not finite, not ascending or too close
  /// to each other for barycentric_weights, or the shape is out of range
  StableGaussian(const Eigen::VectorXd& times, double shape);

  /// The nodes.
  [[nodiscard]] const Eigen::VectorXd& times() const noexcept { return times_; }

  /// Differentiation matrix D: D X is the derivative at the nodes of the interpolant of the values X (Eq.
  /// 4.15); 1/time. For 2 to 100 nodes of the families of nodes.hpp and c times the interval from 1e-6 to
  /// 100, errors are below 1e-12 times the largest entry, and relative errors of off-diagonal entries below
  /// 2e-11.
  [[nodiscard]] const Eigen::MatrixXd& differentiation_matrix() const noexcept { return derivative_; }

  /// 1/(Phi^-1)_ii for each node, for leave-one-out errors: the residual at node i of its function after
  /// interpolation by the others. Relative accuracy 1e-10; n^3 M operations. Empty for polynomials.
  [[nodiscard]] std::vector<Wide> last_pivots() const {
    return sides_.empty() ? std::vector<Wide>() : sides_.front().last_pivots();
  }

  /// Number of powers in the series: M of PositiveKernel; n for polynomials.
  [[nodiscard]] Eigen::Index terms() const noexcept {
    return sides_.empty() ? times_.size() : sides_.front().terms();
  }

 private:
  void differentiate(double shape);

  Eigen::VectorXd times_;
  std::vector<GaussianCardinals> sides_;  // in forward and reversed time; empty for polynomials
  Eigen::MatrixXd derivative_;
};

}  // namespace nlmech::collocation

/// @file
/// Interpolation by a kernel that is a power series with positive coefficients, without a subtraction.
#pragma once

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

}  // namespace nlmech::collocation

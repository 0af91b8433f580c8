/// @file
/// Factors of a symmetric matrix B + sigma I, dense or sparse, with the signs of its eigenvalues.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <memory>

namespace nlmech::algebraic {

/// How many eigenvalues of a symmetric matrix have which sign (Sylvester). The number of negative ones of a
/// stiffness matrix counts the directions in which an equilibrium is unstable.
struct Inertia {
  Eigen::Index negative = 0;  ///< eigenvalues below zero
  Eigen::Index zero = 0;      ///< that are zero to working precision, as far as the factors show it
  /// Are all positive?
  [[nodiscard]] bool is_positive() const { return negative == 0 && zero == 0; }
};

/// Have two compressed matrices their entries at the same places?
template <class Number>
[[nodiscard]] bool has_pattern_of(const Eigen::SparseMatrix<Number>& a,
                                  const Eigen::SparseMatrix<Number>& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

/// Solves (S^-1 B S^-1 + sigma I) x = b for one B, many shifts sigma and a diagonal S of scales.
///
/// A sparse B of more than `smallest_sparse` unknowns becomes L D L^T, with the order of least fill and no
/// exchange of pivots. For a positive definite matrix that is as good as any method; for an indefinite one a
/// pivot that happens to be small lets rounding errors grow, which the caller sees by a residual. A pivot
/// that is zero ends L D L^T; the matrix is then factorised again with its diagonal moved by eps |B|, a
/// change of the size of its own rounding, and one eigenvalue is counted as zero. All other matrices are
/// diagonalised once, after which every shift is free and no pivots are in question.
///
/// Tests hold the counts of negative eigenvalues to Eigen's, and the products of solutions with the matrix to
/// the rounding of its norm.
class SymmetricSolver {
 public:
  /// Sparse matrices of at most so many rows are treated as dense ones.
  static constexpr Eigen::Index smallest_sparse = 12;

  SymmetricSolver();
  /// Moves.
  SymmetricSolver(SymmetricSolver&&) noexcept;
  /// Moves.
  SymmetricSolver& operator=(SymmetricSolver&&) noexcept;
  ~SymmetricSolver();

  /// Takes a sparse B, both halves stored, compressed. A B of the same pattern as the last one costs no new
  /// analysis and no allocation.
  /// @param b finite
  /// @param scale diagonal of S, positive; empty: S = I
  void take(const Eigen::SparseMatrix<double>& b, const Eigen::VectorXd& scale = {});
  /// Takes a dense B.
  void take(const Eigen::MatrixXd& b, const Eigen::VectorXd& scale = {});
  /// Takes the matrix of equations, sparse if they have it so.
  /// @tparam E Equations or Loaded
  template <class E>
  void take_from(const E& equations, const Eigen::VectorXd& scale = {}) {
    if (const Eigen::SparseMatrix<double>* const b = equations.sparse()) return take(*b, scale);
    equations.matrix(dense_);
    take(dense_, scale);
  }

  /// Are all entries of the matrix taken last finite?
  [[nodiscard]] bool is_finite() const;
  /// Factorises the matrix taken last, plus @p shift times I.
  Inertia factorise(double shift = 0);
  /// x = (S^-1 B S^-1 + sigma I)^-1 b with the factors made last. @p b and @p x are different objects.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  /// After factors with negative > 0: a direction v with v^T (S^-1 B S^-1 + sigma I) v < 0, and that number.
  double negative_direction(Eigen::VectorXd& v) const;
  /// out = S^-1 B S^-1 v.
  void multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const;
  /// Largest sum of |entries| in a row of S^-1 B S^-1: a bound for its eigenvalues.
  [[nodiscard]] double norm() const;
  /// The factors are those of a matrix that differs from this one by a few eps times so much: the greatest
  /// diagonal entry of |L| |D| |L^T|, or norm() of a dense matrix. That of a positive definite one is its
  /// greatest diagonal entry.
  [[nodiscard]] double size_of_factors() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
  Eigen::MatrixXd dense_;
};

/// Scales for unknowns of different kinds, such as rotations and translations: the square roots of |B_ii|,
/// none below 1e-8 of the greatest; all 1 if B is zero or not finite. With them S^-1 B S^-1 has diagonal
/// entries of 1, and |S x|^2/2 is the energy of the unknowns, each by itself.
[[nodiscard]] Eigen::VectorXd scale_of(const Eigen::VectorXd& diagonal);

/// Scales, powers of 2, with which no row of S^-1 B S^-1 has a greatest entry far from 1, also where diagonal
/// entries are small: the square roots of the greatest entries of rows, three times over.
[[nodiscard]] Eigen::VectorXd row_scale_of(const Eigen::SparseMatrix<double>& b);

/// The diagonal of the matrix of equations.
/// @tparam E Equations or Loaded
template <class E>
[[nodiscard]] Eigen::VectorXd diagonal_of(const E& equations) {
  if (const Eigen::SparseMatrix<double>* const b = equations.sparse()) return b->diagonal();
  Eigen::MatrixXd dense;
  equations.matrix(dense);
  return dense.diagonal();
}

}  // namespace nlmech::algebraic

/// @file
/// Factorisation of a symmetric matrix B + sigma I, dense or sparse, with its inertia.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <memory>

namespace nlmech::algebraic {

/// Inertia of a symmetric matrix: numbers of negative and zero eigenvalues (Sylvester). The number of
/// negative eigenvalues of a stiffness matrix is the number of unstable directions of an equilibrium.
struct Inertia {
  Eigen::Index negative = 0;  ///< number of negative eigenvalues
  Eigen::Index zero = 0;      ///< number of eigenvalues that are zero to working precision
  /// Are all eigenvalues positive?
  [[nodiscard]] bool is_positive() const { return negative == 0 && zero == 0; }
};

/// Do two compressed matrices have the same sparsity pattern?
template <class Number>
[[nodiscard]] bool has_pattern_of(const Eigen::SparseMatrix<Number>& a,
                                  const Eigen::SparseMatrix<Number>& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

/// Solves (S^-1 B S^-1 + sigma I) x = b for one B, many shifts sigma and a diagonal S of scales.
///
/// A sparse B of more than `smallest_sparse` unknowns is factorised as L D L^T with a fill-reducing ordering
/// and no pivoting. That is stable for a positive definite matrix. For an indefinite one a small pivot lets
/// rounding errors grow; check the residual. After a zero pivot the matrix is factorised again with its
/// diagonal shifted by eps |B|, the size of its own rounding, and one eigenvalue counts as zero. All other
/// matrices are diagonalised once; further shifts need no factorisation.
///
/// Tests compare the numbers of negative eigenvalues with those of Eigen, and check the residuals of
/// solutions against the rounding of the norm of the matrix.
class SymmetricSolver {
 public:
  /// Sparse matrices with at most this many rows are treated as dense.
  static constexpr Eigen::Index smallest_sparse = 12;

  SymmetricSolver();
  /// Moves.
  SymmetricSolver(SymmetricSolver&&) noexcept;
  /// Moves.
  SymmetricSolver& operator=(SymmetricSolver&&) noexcept;
  ~SymmetricSolver();

  /// Sets a sparse B, compressed, with both triangles stored. A B with the sparsity pattern of the last one
  /// needs no symbolic analysis and no allocation.
  /// @param b finite
  /// @param scale diagonal of S, positive; empty: S = I
  void take(const Eigen::SparseMatrix<double>& b, const Eigen::VectorXd& scale = {});
  /// Sets a dense B.
  void take(const Eigen::MatrixXd& b, const Eigen::VectorXd& scale = {});
  /// Sets the matrix of equations, sparse if they store it sparse.
  /// @tparam E Equations or Loaded
  template <class E>
  void take_from(const E& equations, const Eigen::VectorXd& scale = {}) {
    if (const Eigen::SparseMatrix<double>* const b = equations.sparse()) return take(*b, scale);
    equations.matrix(dense_);
    take(dense_, scale);
  }

  /// Are all entries of the matrix set last finite?
  [[nodiscard]] bool is_finite() const;
  /// Factorises the matrix set last plus @p shift I. @return its inertia
  Inertia factorise(double shift = 0);
  /// x = (S^-1 B S^-1 + sigma I)^-1 b with the latest factors. @p b and @p x are different objects.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  /// Direction of negative curvature: v with v^T (S^-1 B S^-1 + sigma I) v < 0; needs factors with negative >
  /// 0. @return that product
  double negative_direction(Eigen::VectorXd& v) const;
  /// out = S^-1 B S^-1 v.
  void multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const;
  /// Infinity norm of S^-1 B S^-1 (largest row sum of |entries|): a bound of its eigenvalues.
  [[nodiscard]] double norm() const;
  /// Size s of the factors: they are exact for a matrix that differs by a few eps s from the given one
  /// (backward error). It is the greatest diagonal entry of |L| |D| |L^T|, or norm() for a dense matrix. For
  /// a positive definite matrix it is the greatest diagonal entry of the matrix.
  [[nodiscard]] double size_of_factors() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
  Eigen::MatrixXd dense_;
};

/// Scales for unknowns of different kinds, such as rotations and translations: sqrt |B_ii|, at least 1e-8 of
/// the greatest; all 1 if B is zero or not finite. S^-1 B S^-1 then has unit diagonal, and |S x|^2/2 is the
/// sum of the energies of the single unknowns.
[[nodiscard]] Eigen::VectorXd scale_of(const Eigen::VectorXd& diagonal);

/// Row equilibration by powers of 2: brings the greatest entry of every row of S^-1 B S^-1 near 1, also where
/// diagonal entries are small. Three iterations with the square roots of the greatest entries of the rows.
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

/// @file
/// Linear systems with B = dF/dx, dense or sparse as the equations store it.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Factors of B, of a B + d I, or of that bordered by a column and a row: by partial pivoting, sparse if
/// Equations::sparse() is not null. Dense systems are solved without allocation, sparse ones allocate.
///
/// Tests hold plain, shifted and bordered systems, dense and sparse, to a QR decomposition, to condition
/// times 100 eps.
class LinearSolver {
 public:
  /// @param equations whose B will be factorised; not kept
  explicit LinearSolver(const Equations& equations);
  ~LinearSolver();
  /// Moves.
  LinearSolver(LinearSolver&&) noexcept;
  /// Moves.
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// Factorises scale B + shift I for the B of the latest linearise().
  /// @return success, `non_finite` if an entry is, or `singular_matrix` if a pivot is 0 (sparse; dense tells
  /// by solve())
  /// @throws std::logic_error if the equations have no matrix
  [[nodiscard]] Outcome factorise(const Equations& equations, double scale = 1, double shift = 0);

  /// Factorises the matrix of size n + 1 with scale B + shift I in its corner, @p column (n) in its last
  /// column and @p row (n + 1) as its last row. Outcomes and errors as of factorise().
  [[nodiscard]] Outcome factorise_bordered(const Equations& equations, double scale, double shift,
                                           const Eigen::VectorXd& column, const Eigen::VectorXd& row);

  /// Solves with the latest factors, which must be there. @p b and @p x are different objects.
  /// @return success, or `singular_matrix` if x is not finite
  [[nodiscard]] Outcome solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

 private:
  struct Dense;
  struct Sparse;
  std::unique_ptr<Dense> dense_;
  std::unique_ptr<Sparse> sparse_;  // one of both
};

}  // namespace nlmech::algebraic

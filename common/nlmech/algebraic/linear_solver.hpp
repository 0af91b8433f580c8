/// @file
/// Linear systems with B = dF/dx, dense or sparse as the equations store it.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// LU factors of a B + d I, plain or bordered by a column and a row, with partial pivoting; sparse if
/// Equations::sparse() is not null. Dense solves do not allocate; sparse solves do.
///
/// Tests compare plain, shifted and bordered systems, dense and sparse, with a QR decomposition, within 100
/// eps times the condition number.
class LinearSolver {
 public:
  /// @param equations decide dense or sparse storage; no reference is stored
  explicit LinearSolver(const Equations& equations);
  ~LinearSolver();
  /// Moves.
  LinearSolver(LinearSolver&&) noexcept;
  /// Moves.
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// Factorises scale B + shift I for the B of the latest linearise().
  /// @return success, `non_finite` if an entry is, or `singular_matrix` if a pivot is 0 (sparse only; a dense
  /// solver reports it in solve())
  /// @throws std::logic_error if the equations have no matrix
  [[nodiscard]] Outcome factorise(const Equations& equations, double scale = 1, double shift = 0);

  /// Factorises the matrix of size n + 1 with scale B + shift I in its corner, @p column (n) in its last
  /// column and @p row (n + 1) as its last row. Outcomes and errors as of factorise().
  [[nodiscard]] Outcome factorise_bordered(const Equations& equations, double scale, double shift,
                                           const Eigen::VectorXd& column, const Eigen::VectorXd& row);

  /// Solves with the latest factors. Call factorise() or factorise_bordered() first. @p b and @p x are
  /// different objects.
  /// @return success, or `singular_matrix` if x is not finite
  [[nodiscard]] Outcome solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

 private:
  struct Dense;
  struct Sparse;
  std::unique_ptr<Dense> dense_;
  std::unique_ptr<Sparse> sparse_;  // exactly one of the two is set
};

}  // namespace nlmech::algebraic

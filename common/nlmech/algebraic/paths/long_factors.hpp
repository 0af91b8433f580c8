/// @file
/// Factors of a symmetric matrix in long double, where those in double do not tell the sign of an eigenvalue.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "nlmech/algebraic/symmetric_solver.hpp"

namespace nlmech::algebraic {

/// Solves S^-1 B S^-1 x = b and counts the signs of its eigenvalues in long double: 64 bits on x86-64, 113 on
/// aarch64.
class LongFactors {
 public:
  LongFactors();
  /// Moves.
  LongFactors(LongFactors&&) noexcept;
  /// Moves.
  LongFactors& operator=(LongFactors&&) noexcept;
  ~LongFactors();

  /// @param b both halves stored; overwritten
  /// @param scale diagonal of S, positive
  /// @return false if a pivot is zero or not finite
  bool factorise(Eigen::SparseMatrix<long double>& b, const Eigen::VectorXd& scale);
  /// Of the factors made last.
  [[nodiscard]] Inertia inertia() const;
  /// x = (S^-1 B S^-1)^-1 b.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace nlmech::algebraic

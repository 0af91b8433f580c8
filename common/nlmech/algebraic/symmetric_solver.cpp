#include "nlmech/algebraic/symmetric_solver.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nlmech/support/doubles.hpp"

namespace nlmech::algebraic {

using Sparse = Eigen::SparseMatrix<double>;

struct SymmetricSolver::Factors {
  bool is_sparse = false;
  Sparse sparse;
  Eigen::SimplicialLDLT<Sparse> ldlt;
  Eigen::MatrixXd dense;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum;
  bool is_diagonalised = false;
  Eigen::VectorXd shifted;  // eigenvalues plus shift; zeros replaced
  double norm = 0;

  Inertia factorise_sparse(double shift) {
    Inertia inertia;
    for (double moved = shift, change = eps * norm; inertia.zero < 3; moved += change, change *= 16) {
      ldlt.setShift(moved);
      ldlt.factorize(sparse);
      // Pivots that are not finite follow a pivot that is zero to rounding.
      if (ldlt.info() == Eigen::Success && ldlt.vectorD().allFinite()) break;
      ++inertia.zero;
    }
    inertia.negative = (ldlt.vectorD().array() < 0).count();
    inertia.zero = std::min<Eigen::Index>(inertia.zero, 1);
    return inertia;
  }

  Inertia factorise_dense(double shift) {
    if (!is_diagonalised) spectrum.compute(dense);
    is_diagonalised = true;
    shifted = spectrum.eigenvalues().array() + shift;
    Inertia inertia;
    const double least = eps * std::max(norm, std::abs(shift));
    for (double& value : shifted) {
      if (value == 0 || std::abs(value) < least / 16) {
        ++inertia.zero;
        value = least > 0 ? least : eps;  // scaled matrices are of size 1
      } else if (value < 0) {
        ++inertia.negative;
      }
    }
    return inertia;
  }
};

SymmetricSolver::SymmetricSolver() : factors_(std::make_unique<Factors>()) {}
SymmetricSolver::SymmetricSolver(SymmetricSolver&&) noexcept = default;
SymmetricSolver& SymmetricSolver::operator=(SymmetricSolver&&) noexcept = default;
SymmetricSolver::~SymmetricSolver() = default;

void SymmetricSolver::take(const Sparse& b, const Eigen::VectorXd& scale) {
  if (b.rows() <= smallest_sparse) {
    dense_ = b;
    return take(dense_, scale);
  }
  Factors& f = *factors_;
  f.is_sparse = true;
  if (has_pattern_of(f.sparse, b)) {
    std::copy(b.valuePtr(), b.valuePtr() + b.nonZeros(), f.sparse.valuePtr());
  } else {
    f.sparse = b;
    f.ldlt.analyzePattern(f.sparse);
  }
  Eigen::VectorXd& sums = f.shifted;
  sums.setZero(b.rows());
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    for (Sparse::InnerIterator i(f.sparse, j); i; ++i) {
      if (scale.size() > 0) i.valueRef() /= scale[i.row()] * scale[j];
      sums[j] += std::abs(i.value());
    }
  }
  f.norm = sums.maxCoeff();
  if (!sums.allFinite()) f.norm = std::numeric_limits<double>::quiet_NaN();
}

void SymmetricSolver::take(const Eigen::MatrixXd& b, const Eigen::VectorXd& scale) {
  Factors& f = *factors_;
  f.is_sparse = false;
  f.is_diagonalised = false;
  f.dense = b;
  if (scale.size() > 0) f.dense.array() /= (scale * scale.transpose()).array();
  f.norm = f.dense.allFinite() ? f.dense.cwiseAbs().rowwise().sum().maxCoeff()
                               : std::numeric_limits<double>::quiet_NaN();
}

bool SymmetricSolver::is_finite() const { return std::isfinite(factors_->norm); }

Inertia SymmetricSolver::factorise(double shift) {
  return factors_->is_sparse ? factors_->factorise_sparse(shift) : factors_->factorise_dense(shift);
}

void SymmetricSolver::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  const Factors& f = *factors_;
  if (f.is_sparse) {
    x = f.ldlt.solve(b);
    return;
  }
  const Eigen::MatrixXd& v = f.spectrum.eigenvectors();
  x.noalias() = v * (v.transpose() * b).cwiseQuotient(f.shifted);
}

double SymmetricSolver::negative_direction(Eigen::VectorXd& v) const {
  const Factors& f = *factors_;
  if (!f.is_sparse) {
    v = f.spectrum.eigenvectors().col(0);
    return f.shifted[0];
  }
  const auto& pivots = f.ldlt.vectorD();
  Eigen::Index k = 0;
  while (k < pivots.size() && !(pivots[k] < 0)) ++k;
  if (k == pivots.size()) throw std::logic_error("SymmetricSolver: no pivot is negative");
  // L^T P v = e_k
  v = Eigen::VectorXd::Unit(pivots.size(), k);
  f.ldlt.matrixU().solveInPlace(v);
  v = f.ldlt.permutationPinv() * v;
  return pivots[k];
}

void SymmetricSolver::multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
  if (factors_->is_sparse)
    out.noalias() = factors_->sparse * v;
  else
    out.noalias() = factors_->dense * v;
}

double SymmetricSolver::norm() const { return factors_->norm; }

double SymmetricSolver::size_of_factors() const {
  const Factors& f = *factors_;
  if (!f.is_sparse) return f.norm;
  const auto& pivots = f.ldlt.vectorD();
  Eigen::VectorXd sums = pivots.cwiseAbs();
  const auto lower = f.ldlt.matrixL();
  const Sparse& l = lower.nestedExpression();
  for (Eigen::Index j = 0; j < l.cols(); ++j) {
    for (Sparse::InnerIterator i(l, j); i; ++i) {
      if (i.row() > j) sums[i.row()] += i.value() * i.value() * std::abs(pivots[j]);
    }
  }
  return sums.maxCoeff();
}

Eigen::VectorXd row_scale_of(const Sparse& b) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(b.rows()), greatest;
  for (int k = 0; k < 3; ++k) {
    greatest.setZero(b.rows());
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      for (Sparse::InnerIterator i(b, j); i; ++i)
        greatest[i.row()] = std::max(greatest[i.row()], std::abs(i.value()) / (scale[i.row()] * scale[j]));
    }
    for (Eigen::Index i = 0; i < b.rows(); ++i) {
      if (greatest[i] > 0 && std::isfinite(greatest[i]))
        scale[i] *= std::exp2(std::round(std::log2(greatest[i]) / 2));
    }
  }
  return scale;
}

Eigen::VectorXd scale_of(const Eigen::VectorXd& diagonal) {
  const double greatest = diagonal.size() > 0 ? diagonal.cwiseAbs().maxCoeff() : 0;
  if (!(greatest > 0) || !diagonal.allFinite()) return Eigen::VectorXd::Ones(diagonal.size());
  return diagonal.cwiseAbs().cwiseMax(1e-16 * greatest).cwiseSqrt();
}

}  // namespace nlmech::algebraic

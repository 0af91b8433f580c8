#include "nlmech/algebraic/linear_solver.hpp"

#include <Eigen/LU>
#include <Eigen/SparseLU>

namespace nlmech::algebraic {

struct LinearSolver::Dense {
  Eigen::MatrixXd corner, whole;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;

  void load(const Equations& equations, double scale, double shift) {
    equations.matrix(corner);
    if (scale != 1) corner *= scale;
    if (shift != 0) corner.diagonal().array() += shift;
  }

  Outcome factorise(const Eigen::MatrixXd& matrix) {
    if (!matrix.allFinite()) return Outcome::non_finite;
    lu.compute(matrix);
    return Outcome::success;
  }
};

struct LinearSolver::Sparse {
  using Matrix = Eigen::SparseMatrix<double>;
  Matrix assembled;
  Eigen::SparseLU<Matrix> lu;
  Eigen::Index analysed = -1;  // number of entries of the analysed pattern

  // Builds column by column and always stores the diagonal, so that the pattern does not depend on the
  // values.
  void assemble(const Matrix& b, double scale, double shift, const Eigen::VectorXd* column,
                const Eigen::VectorXd* row) {
    const Eigen::Index n = b.rows(), size = n + (row ? 1 : 0);
    assembled.resize(size, size);
    assembled.reserve(b.nonZeros() + n + 2 * size);
    for (Eigen::Index j = 0; j < n; ++j) {
      assembled.startVec(j);
      bool has_diagonal = false;
      const auto diagonal = [&] {
        if (!has_diagonal) assembled.insertBack(j, j) = shift;
        has_diagonal = true;
      };
      for (Matrix::InnerIterator it(b, j); it; ++it) {
        if (it.row() > j) diagonal();
        assembled.insertBack(it.row(), j) = scale * it.value() + (it.row() == j ? shift : 0);
        has_diagonal = has_diagonal || it.row() == j;
      }
      diagonal();
      if (row) assembled.insertBack(n, j) = (*row)[j];
    }
    if (row) {
      assembled.startVec(n);
      for (Eigen::Index i = 0; i < n; ++i) assembled.insertBack(i, n) = (*column)[i];
      assembled.insertBack(n, n) = (*row)[n];
    }
    assembled.finalize();
  }

  Outcome factorise(const Matrix& matrix) {
    if (!matrix.coeffs().allFinite()) return Outcome::non_finite;
    if (analysed != matrix.nonZeros()) lu.analyzePattern(matrix);
    analysed = matrix.nonZeros();
    lu.factorize(matrix);
    return lu.info() == Eigen::Success ? Outcome::success : Outcome::singular_matrix;
  }
};

LinearSolver::LinearSolver(const Equations& equations) {
  if (equations.sparse()) {
    sparse_ = std::make_unique<Sparse>();
  } else {
    const Eigen::Index n = equations.size();
    dense_ =
        std::make_unique<Dense>(Dense{Eigen::MatrixXd(n, n), {}, Eigen::PartialPivLU<Eigen::MatrixXd>(n)});
  }
}

LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

Outcome LinearSolver::factorise(const Equations& equations, double scale, double shift) {
  if (dense_) {
    dense_->load(equations, scale, shift);
    return dense_->factorise(dense_->corner);
  }
  if (scale == 1 && shift == 0) return sparse_->factorise(*equations.sparse());
  sparse_->assemble(*equations.sparse(), scale, shift, nullptr, nullptr);
  return sparse_->factorise(sparse_->assembled);
}

Outcome LinearSolver::factorise_bordered(const Equations& equations, double scale, double shift,
                                         const Eigen::VectorXd& column, const Eigen::VectorXd& row) {
  const Eigen::Index n = equations.size();
  if (sparse_) {
    sparse_->assemble(*equations.sparse(), scale, shift, &column, &row);
    return sparse_->factorise(sparse_->assembled);
  }
  dense_->load(equations, scale, shift);
  dense_->whole.resize(n + 1, n + 1);
  dense_->whole.topLeftCorner(n, n) = dense_->corner;
  dense_->whole.topRightCorner(n, 1) = column;
  dense_->whole.bottomRows(1) = row.transpose();
  return dense_->factorise(dense_->whole);
}

Outcome LinearSolver::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  if (dense_) {
    x = dense_->lu.solve(b);
  } else {
    x = sparse_->lu.solve(b);
  }
  return x.allFinite() ? Outcome::success : Outcome::singular_matrix;
}

}  // namespace nlmech::algebraic

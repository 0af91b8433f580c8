#include "nlmech/algebraic/paths/path_system.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <stdexcept>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {

namespace {

// A structure buckles where its smallest eigenvalue vanishes, so the relative rounding error of that
// eigenvalue at rest carries over to critical loads. Above this error, long double is used, which takes three
// times as long; critical loads then keep six digits.
constexpr double negligible_rounding = 1e-7;

}  // namespace

/// L D L^T in long double (64 bits on x86-64, 113 on aarch64), used where factors in double do not determine
/// the sign of an eigenvalue.
struct PathSystem::LongFactors {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<long double>> ldlt;
  Eigen::SparseMatrix<long double> analysed;  // last analysed sparsity pattern

  /// Factorises S^-1 B S^-1, which overwrites @p b. @return false if a pivot is zero or not finite
  bool factorise(Eigen::SparseMatrix<long double>& b, const Eigen::VectorXd& scale) {
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      for (Eigen::SparseMatrix<long double>::InnerIterator i(b, j); i; ++i)
        i.valueRef() /= static_cast<long double>(scale[i.row()]) * scale[j];
    }
    if (!has_pattern_of(analysed, b)) {
      ldlt.analyzePattern(b);
      analysed = b;
    }
    ldlt.factorize(b);
    return ldlt.info() == Eigen::Success && ldlt.vectorD().allFinite();
  }
};

PathSystem::~PathSystem() = default;

PathSystem::PathSystem(Loaded& equations, const Eigen::VectorXd& x, double load, const Eigen::VectorXd& scale)
    : equations_(equations), scale_(scale) {
  const Eigen::Index n = equations.size();
  if (x.size() != n)
    throw invalid_argument("path: the start has {} components, the equations {}", x.size(), n);
  if (scale.size() > 0 && !(scale.size() == n && (scale.array() > 0).all()))
    throw std::invalid_argument("path: scale has another size than x, or is not positive");
  f_.resize(n);
  q_.resize(n);
  rest_.y.resize(n);
  change_.y.resize(n);
  equations_.linearise(x, load);
  ++statistics.jacobians;
  if (scale_.size() == 0) scale_ = scale_of(diagonal_of(equations_));
  const PathVector start = scaled(x, load);
  if (!linearise(start)) return;
  is_stiff_ = equations_.is_symmetric() && rounding_of_smallest_eigenvalue() > negligible_rounding &&
              equations_.long_residual(long_x(start), load, f_);
  if (is_stiff_ && !linearise(start)) return;
  solve(q_, work_);
  const double plain = work_.norm(), reach = scale_.cwiseProduct(x).norm(),
               length = plain > 1e-140 && plain < 1e140 ? plain : work_.stableNorm();
  // At or near a limit point K^-1 q is unbounded: use the displacements of the start.
  if (inertia_.zero == 0 && std::isfinite(length) && length > 0 && (reach == 0 || length <= 1e3 * reach))
    load_scale_ = length;
  else if (reach > 0)
    load_scale_ = reach;
}

Eigen::VectorXd null_direction(const PathSystem& system) {
  Eigen::VectorXd v(system.size()), next(system.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = 1 + 0.5 * std::sin(1. + static_cast<double>(i));
  for (int k = 0; k < 4; ++k) {
    system.solve(v, next);
    v = next.normalized();
  }
  return v;
}

PathVector PathSystem::scaled(const Eigen::VectorXd& x, double load) const {
  return {x.cwiseProduct(scale_), load * load_scale_};
}

LongVector PathSystem::long_x(const PathVector& at) const {
  LongVector x = at.y.cast<long double>();
  if (at.low.size() > 0) x += at.low.cast<long double>();
  return x.cwiseQuotient(scale_.cast<long double>());
}

void PathSystem::move(PathVector& at, const PathVector& step) const {
  at.m += step.m;
  if (!is_stiff_) {
    at.y += step.y;
    return;
  }
  LongVector sum = at.y.cast<long double>() + step.y.cast<long double>();
  if (at.low.size() > 0) sum += at.low.cast<long double>();
  at.y = sum.cast<double>();
  at.low = (sum - at.y.cast<long double>()).cast<double>();
}

bool PathSystem::residual(const PathVector& at) {
  x_ = at.y.cwiseQuotient(scale_);
  if (!is_stiff_ || !equations_.long_residual(long_x(at), at.m / load_scale_, f_))
    equations_.residual(x_, at.m / load_scale_, f_);
  ++statistics.right_hand_sides;
  norm_ = f_.norm();
  f_ = f_.cwiseQuotient(scale_);
  return std::isfinite(norm_);
}

bool PathSystem::linearise(const PathVector& at) {
  x_ = at.y.cwiseQuotient(scale_);
  place_ = at;
  equations_.linearise(x_, at.m / load_scale_);
  ++statistics.jacobians;
  equations_.load_vector(q_);
  q_ = q_.cwiseQuotient(scale_) / load_scale_;
  return factorise() && q_.allFinite();
}

bool PathSystem::factorise() {
  ++statistics.factorisations;
  if (equations_.is_symmetric()) {
    return factorise_symmetric();
  }
  equations_.matrix(dense_);
  if (!dense_.allFinite()) return false;
  dense_.array() /= (scale_ * scale_.transpose()).array();
  lu_.compute(dense_);
  inertia_ = {.zero = (lu_.matrixLU().diagonal().array() == 0).count()};
  if (inertia_.zero > 0) {  // at a fold to the last bit; bordered systems are refined with the true matrix
    other_ = dense_;
    other_.diagonal().array() += std::numeric_limits<double>::epsilon() * (norm_of_matrix() + q_.norm());
    lu_.compute(other_);
  }
  bool is_negative = lu_.permutationP().determinant() < 0;
  for (Eigen::Index i = 0; i < dense_.rows(); ++i) {
    if (lu_.matrixLU()(i, i) < 0) is_negative = !is_negative;
  }
  inertia_.negative = is_negative ? 1 : 0;
  return true;
}

bool PathSystem::factorise_symmetric() {
  is_long_ = is_rounded_ = false;
  if (const Eigen::SparseMatrix<double>* const k = equations_.sparse()) {
    sparse_ = *k;
  } else {
    equations_.matrix(dense_);
    sparse_ = dense_.sparseView();
  }
  // The scales of the path may make K ill-conditioned; the factors use equilibrated rows instead.
  const Eigen::VectorXd scale = row_scale_of(sparse_);
  balance_ = scale_.cwiseQuotient(scale);
  symmetric_.take(sparse_, scale);
  if (!symmetric_.is_finite()) return false;
  inertia_ = symmetric_.factorise();
  zero_ = inertia_.zero;
  work_.setZero(size());
  for (Eigen::Index j = 0; j < sparse_.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator i(sparse_, j); i; ++i)
      work_[i.row()] += std::abs(i.value()) / (scale_[i.row()] * scale_[j]);
  }
  matrix_norm_ = work_.maxCoeff();
  if (is_stiff_) static_cast<void>(factorise_long());  // on failure the factors in double are used
  return true;
}

bool PathSystem::factorise_long() {
  if (!equations_.long_matrix(long_x(place_), place_.m / load_scale_, long_matrix_))
    long_matrix_ = sparse_.cast<long double>();
  if (!long_) long_ = std::make_unique<LongFactors>();
  is_long_ = long_->factorise(long_matrix_, scale_.cwiseQuotient(balance_));
  if (is_long_) inertia_ = {.negative = (long_->ldlt.vectorD().array() < 0).count()};
  return is_long_;
}

/// Bound of the relative error of the eigenvalue of the balanced matrix nearest to zero, as computed from the
/// factors in double; by inverse iteration.
double PathSystem::rounding_of_smallest_eigenvalue() const {
  if (zero_ > 0) return HUGE_VAL;
  Eigen::VectorXd v = Eigen::VectorXd::Zero(size()), next;
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = 1 + 0.5 * std::sin(1. + static_cast<double>(i));
  for (int k = 0; k < 3; ++k) {
    symmetric_.solve(v.normalized(), next);
    v = next;
  }
  return eps * symmetric_.size_of_factors() * v.norm();
}

void PathSystem::certify() {
  if (!equations_.is_symmetric() || is_rounded_ || 64 * rounding_of_smallest_eigenvalue() < 1) return;
  is_rounded_ = is_long_ || factorise_long();
}

void PathSystem::multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
  if (is_long_)
    out =
        (long_matrix_ * v.cwiseQuotient(balance_).cast<long double>()).cast<double>().cwiseQuotient(balance_);
  else if (equations_.is_symmetric())
    out = (sparse_ * v.cwiseQuotient(scale_)).cwiseQuotient(scale_);
  else
    out.noalias() = dense_ * v;
}

void PathSystem::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  if (!equations_.is_symmetric()) {
    x = lu_.solve(b);
    return;
  }
  balanced_ = b.cwiseProduct(balance_);
  if (is_long_)
    x = long_->ldlt.solve(balanced_.cast<long double>()).cast<double>();
  else
    symmetric_.solve(balanced_, x);
  x = x.cwiseProduct(balance_);
}

void PathSystem::solve_transposed(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  if (equations_.is_symmetric())
    solve(b, x);
  else
    x = lu_.transpose().solve(b);
}

//! [mixed block elimination]
/// Accurate even if K is nearly singular: a first load from the transposed system removes from f the part
/// outside the range of K; standard block elimination follows.
void PathSystem::eliminate(const PathVector& row, double delta, double delta_transposed,
                           const PathVector& right, PathVector& out) {
  const double first = (right.m - left_.dot(right.y)) / delta_transposed;
  shortened_.y = right.y - column_ * first;
  shortened_.m = right.m - row.m * first;
  solve(shortened_.y, out.y);
  const double second = (shortened_.m - row.y.dot(out.y)) / delta;
  out.y -= right_ * second;
  out.m = first + second;
}
//! [mixed block elimination]

bool PathSystem::solve_bordered(const PathVector& row, const Eigen::VectorXd& f, double h, PathVector& out) {
  return solve_bordered(q_, row, f, h, out);
}

bool PathSystem::solve_bordered(const Eigen::VectorXd& column, const PathVector& row,
                                const Eigen::VectorXd& f, double h, PathVector& out) {
  column_ = column;
  solve_transposed(row.y, left_);
  solve(column_, right_);
  const double delta_transposed = row.m - left_.dot(column_), delta = row.m - row.y.dot(right_);
  ratio_ = delta;
  sign_ = (delta < 0 ? -1 : 1) * (inertia_.negative % 2 == 0 ? 1 : -1);
  rest_.y = f;
  rest_.m = h;
  const double size = rest_.norm();
  eliminate(row, delta, delta_transposed, rest_, out);
  for (int k = 0; k < 2; ++k) {
    multiply(out.y, work_);
    rest_.y = f - work_ - column_ * out.m;
    rest_.m = h - row.y.dot(out.y) - row.m * out.m;
    eliminate(row, delta, delta_transposed, rest_, change_);
    out.y += change_.y;
    out.m += change_.m;
  }
  multiply(out.y, work_);
  rest_.y = f - work_ - column_ * out.m;
  rest_.m = h - row.y.dot(out.y) - row.m * out.m;
  // Accept a residual at the rounding level of the product with the matrix, or 1e-3 of (f; h).
  const double floor = 1e-12 * (norm_of_matrix() + column_.norm() + row.norm()) * out.norm();
  return std::isfinite(out.norm()) && rest_.norm() <= 1e-3 * size + floor;
}

void PathSystem::multiply_at(const PathVector& at, const Eigen::VectorXd& v, Eigen::VectorXd& out) {
  ++statistics.jacobians;
  if (Eigen::SparseMatrix<long double> k;
      is_stiff_ && equations_.long_matrix(long_x(at), at.m / load_scale_, k)) {
    out = (k * v.cwiseQuotient(scale_).cast<long double>()).cast<double>().cwiseQuotient(scale_);
    return;
  }
  x_ = at.y.cwiseQuotient(scale_);
  equations_.linearise(x_, at.m / load_scale_);
  x_ = v.cwiseQuotient(scale_);
  if (const Eigen::SparseMatrix<double>* const k = equations_.sparse()) {
    out.noalias() = *k * x_;
  } else {
    equations_.matrix(other_);
    out.noalias() = other_ * x_;
  }
  out = out.cwiseQuotient(scale_);
}

double PathSystem::norm_of_matrix() const {
  return equations_.is_symmetric() ? matrix_norm_ : dense_.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace nlmech::algebraic

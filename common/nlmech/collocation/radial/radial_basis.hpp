/// @file
/// Interpolation by radial functions centred at the nodes, and its derivative (Eqs 4.12 to 4.15).
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

#include "nlmech/collocation/matrix.hpp"
#include "nlmech/collocation/radial/kernels.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::collocation {

/// Computation of D = Phi' Phi^-1.
enum class Inversion {
  solve,   ///< solution of D Phi = Phi' with the LU factors of Phi
  inverse  ///< multiplication by the inverse matrix: loses all digits at condition numbers above about 1e13
};

/// Throws std::invalid_argument unless @p shape is positive and finite; the text names @p what and the value.
void require_shape(const char* what, double shape);

/// Interpolation on an interval by the n functions phi(t - t_k) centred at its nodes t_k.
///
/// The matrix Phi is ill-conditioned for wide functions, and rounding may dominate the result.
/// Differentiation measures this.
template <class T = double>
class RadialBasis {
 public:
  /// Factorises Phi.
  /// @param times  nodes, ascending; 1 to max_nodes of them
  /// @param kernel radial function
  /// @param shape  c of Eq. 4.8, 1/time; > 0
  /// @throws std::invalid_argument if the times are too many, not finite or not ascending, or the shape is
  /// not positive and finite
  RadialBasis(const Vector<T>& times, Kernel kernel, const T& shape)
      : times_(times), kernel_(kernel), shape_(shape) {
    require_nodes("RadialBasis", times_);
    require_shape("RadialBasis", static_cast<double>(shape_));
    const Eigen::Index n = times_.size();
    values_.resize(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index k = 0; k <= j; ++k)
        values_(k, j) = values_(j, k) = phi(kernel_, shape_, T(times_[j] - times_[k]));
    }
    factorise();
  }

  /// Success; singular_matrix if Phi has no inverse in T; non_finite if an entry overflows.
  [[nodiscard]] const Status& status() const noexcept { return status_; }

  /// The nodes.
  [[nodiscard]] const Vector<T>& times() const noexcept { return times_; }

  /// Phi_jk = phi(t_j - t_k); symmetric.
  [[nodiscard]] const Matrix<T>& values() const noexcept { return values_; }

  /// Phi'_jk = d phi/dt (t_j - t_k); antisymmetric; 1/time.
  [[nodiscard]] Matrix<T> derivatives() const {
    const Eigen::Index n = times_.size();
    Matrix<T> result(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index k = 0; k < n; ++k)
        result(j, k) = phi_dot(kernel_, shape_, T(times_[j] - times_[k]), values_(j, k));
    }
    return result;
  }

  /// Phi^-1.
  /// @throws std::logic_error if status() is no success
  [[nodiscard]] Matrix<T> inverse() const {
    require_factors();
    return lu_.inverse();
  }

  /// D = Phi' Phi^-1, which maps values at the nodes to derivatives at the nodes (Eq. 4.15); 1/time.
  /// @throws std::logic_error if status() is no success
  [[nodiscard]] Matrix<T> differentiation_matrix(Inversion inversion = Inversion::solve) const {
    require_factors();
    if (inversion == Inversion::inverse) return derivatives() * lu_.inverse();
    // Because Phi is symmetric, D Phi = Phi' is equivalent to Phi D^T = Phi'^T.
    const Matrix<T> right = derivatives().transpose();
    return lu_.solve(right).transpose();
  }

  /// Interpolation row r = phi(t) Phi^-1: r X is the interpolant at @p t of the values X at the nodes.
  /// @param t   finite time; the interpolant is intended for the interval of the nodes
  /// @param row the result; no allocation if it has n entries
  /// @throws std::logic_error if status() is no success, std::invalid_argument if @p t is not finite
  void row(const T& t, RowVector<T>& row) const {
    require_factors();
    require_time("RadialBasis::row", t);
    const Eigen::Index n = times_.size();
    row.resize(n);
    // The right-hand side is stored in pivot order, for triangular solves in place.
    const auto& place = lu_.permutationP().indices();
    for (Eigen::Index k = 0; k < n; ++k) row[place[k]] = phi(kernel_, shape_, T(t - times_[k]));
    auto column = row.transpose();
    lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(column);
    lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(column);
  }

 private:
  void factorise() {
    if (!is_finite(T(values_.sum()))) {
      status_ = Status::failure(Outcome::non_finite,
                                "RadialBasis: a radial function overflows; choose a smaller shape");
      return;
    }
    lu_.compute(values_);
    const auto pivots = lu_.matrixLU().diagonal();
    if (std::all_of(pivots.begin(), pivots.end(), [](const T& p) { return p != T(0) && is_finite(p); }))
      return;
    status_ = Status::failure(Outcome::singular_matrix,
                              "RadialBasis: the matrix of the radial functions is singular; choose a larger "
                              "shape, or the polynomial limit");
  }
  void require_factors() const {
    if (!status_.ok()) throw std::logic_error(status_.text());
  }

  Vector<T> times_;
  Kernel kernel_;
  T shape_;
  Matrix<T> values_;
  Eigen::PartialPivLU<Matrix<T>> lu_;
  Status status_;
};

extern template class RadialBasis<double>;

}  // namespace nlmech::collocation

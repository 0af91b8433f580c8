/// @file
/// LU factors of a dense matrix whose size is known at run time.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace nlmech::algebraic {

/// Product a b.
[[nodiscard]] inline double product(double a, double b) { return a * b; }
/// Complex product without the check for infinities that the C++ standard requires.
[[nodiscard]] inline std::complex<double> product(const std::complex<double>& a,
                                                  const std::complex<double>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
/// 1/a by Smith's formula, which neither overflows nor underflows where the result does not.
[[nodiscard]] inline std::complex<double> reciprocal(const std::complex<double>& a) {
  if (std::abs(a.real()) >= std::abs(a.imag())) {
    const double ratio = a.imag() / a.real(), part = 1 / (a.real() + a.imag() * ratio);
    return {part, -ratio * part};
  }
  const double ratio = a.real() / a.imag(), part = 1 / (a.imag() + a.real() * ratio);
  return {ratio * part, -part};
}
/// Size of a pivot candidate: |a|.
[[nodiscard]] inline double magnitude(double a) { return std::abs(a); }
/// Size of a complex pivot candidate: |Re a| + |Im a|, as in LAPACK; within a factor of 1.5 of the modulus.
[[nodiscard]] inline double magnitude(const std::complex<double>& a) {
  return std::abs(a.real()) + std::abs(a.imag());
}

/// LU factorisation with partial pivoting, for Newton's iterations. Up to `most_of_loops` equations: plain
/// loops, which take a half to a third of the time of Eigen's LU and allocate nothing after the constructor.
/// Above: Eigen's blocked LU. The loops for double round as Eigen's unblocked LU does. Complex columns and
/// right-hand sides store all real parts, then all imaginary parts, so that the loops vectorise over rows.
/// @tparam Number double or std::complex<double>
template <class Number>
class DenseLu {
 public:
  static constexpr Eigen::Index most_of_loops =
      48;  ///< largest size for plain loops; equal speed at twice this size

  /// Workspace for a system of @p size equations.
  explicit DenseLu(Eigen::Index size) : size_(size), large_(is_large() ? size : 0) {
    if (is_large()) return;
    a_.resize(static_cast<std::size_t>(parts * size * size));
    side_.resize(static_cast<std::size_t>(parts * size));
    pivot_.resize(static_cast<std::size_t>(size));
  }

  /// Factorises @p scale @p a + @p shift I. For a singular matrix solve() returns values that are not finite,
  /// except where elimination makes the right-hand side 0 at each zero pivot.
  void compute(const Eigen::MatrixXd& a, double scale = 1, const Number& shift = 0) {
    if (is_large()) {
      large_.compute(scale * a.template cast<Number>() + shift * Large::Identity(size_, size_));
      return;
    }
    for (Eigen::Index k = 0; k < size_; ++k) {
      double* const to = column(k);
      for (Eigen::Index i = 0; i < size_; ++i) set(to, i, scale * a(i, k));
      set(to, k, get(to, k) + shift);
    }
    for (Eigen::Index k = 0; k < size_; ++k) eliminate(k);
  }
  /// Solves for the right-hand side @p b; writes the solution to @p x, which may be the same object as @p b.
  template <class V>
  void solve(const V& b, V& x) {
    if (is_large()) {
      x = large_.solve(b);
      return;
    }
    double* const y = side_.data();
    for (Eigen::Index k = 0; k < size_; ++k) set(y, k, b[k]);
    for (Eigen::Index k = 0; k < size_; ++k) swap(y, k, pivot_[at(k)]);
    for (Eigen::Index k = 0; k < size_; ++k) subtract(column(k), get(y, k), k + 1, size_, y);
    for (Eigen::Index k = size_ - 1; k >= 0; --k) {
      const Number left = get(y, k);
      x[k] = left == Number(0) ? left : divide(left, get(column(k), k));
      subtract(column(k), x[k], 0, k, y);
    }
  }

 private:
  static constexpr bool is_complex = !std::is_same_v<Number, double>;
  static constexpr Eigen::Index parts = is_complex ? 2 : 1;  // doubles per number
  using Large = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

  [[nodiscard]] bool is_large() const { return size_ > most_of_loops; }
  [[nodiscard]] static std::size_t at(Eigen::Index k) { return static_cast<std::size_t>(k); }
  [[nodiscard]] double* column(Eigen::Index k) { return a_.data() + parts * k * size_; }

  // Diagonal entry stored for a pivot: the pivot itself if real, its reciprocal if complex.
  [[nodiscard]] static Number divisor(const Number& pivot) {
    if constexpr (is_complex)
      return reciprocal(pivot);
    else
      return pivot;
  }
  [[nodiscard]] static Number divide(const Number& a, const Number& divisor) {
    if constexpr (is_complex)
      return product(a, divisor);
    else
      return a / divisor;
  }
  // Entry i of a column.
  [[nodiscard]] Number get(const double* a, Eigen::Index i) const {
    if constexpr (is_complex)
      return {a[i], a[size_ + i]};
    else
      return a[i];
  }
  void set(double* a, Eigen::Index i, const Number& value) const {
    if constexpr (is_complex) {
      a[i] = value.real();
      a[size_ + i] = value.imag();
    } else {
      a[i] = value;
    }
  }
  void swap(double* a, Eigen::Index i, Eigen::Index k) const {
    for (Eigen::Index part = 0; part < parts; ++part) std::swap(a[part * size_ + i], a[part * size_ + k]);
  }

  // y_i -= a_i factor for i in [begin, end).
  void subtract(const double* a, const Number& factor, Eigen::Index begin, Eigen::Index end,
                double* y) const {
    if constexpr (is_complex) {
      const double re = factor.real(), im = factor.imag();
      const double* const __restrict a_re = a, * const __restrict a_im = a + size_;
      double* const __restrict y_re = y, * const __restrict y_im = y + size_;
      for (Eigen::Index i = begin; i < end; ++i) {
        y_re[i] -= a_re[i] * re - a_im[i] * im;
        y_im[i] -= a_re[i] * im + a_im[i] * re;
      }
    } else {
      const double* const __restrict from = a;
      double* const __restrict to = y;
      for (Eigen::Index i = begin; i < end; ++i) to[i] -= from[i] * factor;
    }
  }
  // One elimination step: swaps the pivot of column k to the diagonal and subtracts multiples of its row.
  // Skips the subtraction if the column is zero.
  void eliminate(Eigen::Index k) {
    double* const a = column(k);
    Eigen::Index p = k;
    for (Eigen::Index i = k + 1; i < size_; ++i) {
      if (magnitude(get(a, i)) > magnitude(get(a, p))) p = i;
    }
    pivot_[at(k)] = p;
    if (p != k) {
      for (Eigen::Index j = 0; j < size_; ++j) swap(column(j), k, p);
    }
    const Number pivot = get(a, k), by = divisor(pivot);
    set(a, k, by);
    if (pivot == Number(0)) return;
    for (Eigen::Index i = k + 1; i < size_; ++i) set(a, i, divide(get(a, i), by));
    for (Eigen::Index j = k + 1; j < size_; ++j) subtract(a, get(column(j), k), k + 1, size_, column(j));
  }

  Eigen::Index size_;
  std::vector<double> a_, side_;
  std::vector<Eigen::Index> pivot_;
  Eigen::PartialPivLU<Large> large_;
};

}  // namespace nlmech::algebraic

/// @file
/// Factors of the matrices of Newton's iteration in adaptive-collocation.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "nlmech/ivp/state.hpp"

namespace nlmech::ivp::adaptive {

/// a b.
[[nodiscard]] inline double product(double a, double b) { return a * b; }
/// The same for complex numbers, without the search for infinities that C++ asks of theirs.
[[nodiscard]] inline std::complex<double> product(const std::complex<double>& a,
                                                  const std::complex<double>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
/// 1/a.
[[nodiscard]] inline double reciprocal(double a) { return 1 / a; }
/// The same by Smith's formula, which neither overflows nor underflows where the result does not.
[[nodiscard]] inline std::complex<double> reciprocal(const std::complex<double>& a) {
  if (std::abs(a.real()) >= std::abs(a.imag())) {
    const double ratio = a.imag() / a.real(), part = 1 / (a.real() + a.imag() * ratio);
    return {part, -ratio * part};
  }
  const double ratio = a.real() / a.imag(), part = 1 / (a.imag() + a.real() * ratio);
  return {ratio * part, -part};
}
/// How large a number is as a pivot.
[[nodiscard]] inline double magnitude(double a) { return std::abs(a); }
/// |Re a| + |Im a|, as LAPACK does: no root, and within a factor of 1.5 of the modulus.
[[nodiscard]] inline double magnitude(const std::complex<double>& a) {
  return std::abs(a.real()) + std::abs(a.imag());
}

/// Factors L U of shift I - J by elimination with partial pivoting: plain loops, which for the few equations
/// of most systems take a half to a third of the time of Eigen's; Eigen's, which work in blocks, for many.
/// @tparam Number double or std::complex<double> @tparam n size, or Eigen::Dynamic
template <class Number, int n>
class Factors {
 public:
  /// For so many equations.
  explicit Factors(Eigen::Index size) : size_(size) {
    if constexpr (n == Eigen::Dynamic) {
      if (is_large()) return;
      a_.resize(static_cast<std::size_t>(size * size));
      pivot_.resize(static_cast<std::size_t>(size));
    }
  }

  /// Of @p shift times I less @p j. A singular matrix makes solutions that are not finite.
  void compute(const Number& shift, const Jacobian<n>& j) {
    if constexpr (n == Eigen::Dynamic) {
      if (is_large()) {
        Large a = -j.template cast<Number>();
        a.diagonal().array() += shift;
        large_.compute(a);
        return;
      }
    }
    for (Eigen::Index k = 0; k < size_ * size_; ++k) a_[at(k)] = -j.data()[k];
    for (Eigen::Index k = 0; k < size_; ++k) column(k)[k] += shift;
    for (Eigen::Index k = 0; k < size_; ++k) eliminate(k);
  }
  /// @p x becomes the solution for the right-hand side @p x.
  void solve(Vector<Number, n>& x) const {
    if constexpr (n == Eigen::Dynamic) {
      if (is_large()) {
        x = large_.solve(x);
        return;
      }
    }
    for (Eigen::Index k = 0; k < size_; ++k) std::swap(x[k], x[pivot_[at(k)]]);
    for (Eigen::Index k = 0; k < size_; ++k) subtract(column(k), x[k], k + 1, size_, x.data());
    for (Eigen::Index k = size_ - 1; k >= 0; --k) {
      x[k] = product(x[k], column(k)[k]);
      subtract(column(k), x[k], 0, k, x.data());
    }
  }

 private:
  static constexpr bool is_fixed = n != Eigen::Dynamic;
  static constexpr std::size_t rows = is_fixed ? static_cast<std::size_t>(n) : 1;
  static constexpr Eigen::Index most_of_loops = 48;  // equations; twice as many are as fast by blocks
  using Large = Eigen::Matrix<Number, n, n>;
  struct None {};

  [[nodiscard]] bool is_large() const { return size_ > most_of_loops; }
  [[nodiscard]] static std::size_t at(Eigen::Index k) { return static_cast<std::size_t>(k); }
  [[nodiscard]] Number* column(Eigen::Index k) { return a_.data() + k * size_; }
  [[nodiscard]] const Number* column(Eigen::Index k) const { return a_.data() + k * size_; }

  // y_i -= a_i factor for i from begin to end.
  static void subtract(const Number* a, const Number& factor, Eigen::Index begin, Eigen::Index end,
                       Number* y) {
    for (Eigen::Index i = begin; i < end; ++i) y[i] -= product(a[i], factor);
  }
  // Brings the pivot of column k to the diagonal, whose reciprocal is kept there, and subtracts its row.
  void eliminate(Eigen::Index k) {
    Number* const a = column(k);
    Eigen::Index p = k;
    for (Eigen::Index i = k + 1; i < size_; ++i) {
      if (magnitude(a[i]) > magnitude(a[p])) p = i;
    }
    pivot_[at(k)] = p;
    if (p != k) {
      for (Eigen::Index j = 0; j < size_; ++j) std::swap(column(j)[k], column(j)[p]);
    }
    a[k] = reciprocal(a[k]);
    for (Eigen::Index i = k + 1; i < size_; ++i) a[i] = product(a[i], a[k]);
    for (Eigen::Index j = k + 1; j < size_; ++j) subtract(a, column(j)[k], k + 1, size_, column(j));
  }

  Eigen::Index size_;
  std::conditional_t<is_fixed, std::array<Number, rows * rows>, std::vector<Number>> a_{};
  std::conditional_t<is_fixed, std::array<Eigen::Index, rows>, std::vector<Eigen::Index>> pivot_{};
  std::conditional_t<is_fixed, None, Eigen::PartialPivLU<Large>> large_{};
};

}  // namespace nlmech::ivp::adaptive

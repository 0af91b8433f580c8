/// @file
/// Products of the small matrices of collocation as plain loops: as fast as Eigen and compiled in a tenth of
/// the time, which matters in code that is instantiated for every order.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nlmech::ivp::adaptive {

/// A number for each of s nodes.
template <int s>
using Column = Eigen::Matrix<double, s, 1>;
/// A number for each pair of nodes.
template <int s>
using Square = Eigen::Matrix<double, s, s>;

/// y = A x.
template <int s>
inline void multiply(const Square<s>& a, const double* x, double* y) {
  for (int i = 0; i < s; ++i) y[i] = a.data()[i] * x[0];
  for (int j = 1; j < s; ++j) {
    const double* const column = a.data() + j * s;
    for (int i = 0; i < s; ++i) y[i] += column[i] * x[j];
  }
}

/// y += factor times column j of A.
template <int s>
inline void add_column(const Square<s>& a, int j, double factor, double* y) {
  const double* const column = a.data() + j * s;
  for (int i = 0; i < s; ++i) y[i] += factor * column[i];
}

/// Row i of A times x.
template <int s>
[[nodiscard]] inline double row_times(const Square<s>& a, int i, const double* x) {
  double sum = 0;
  for (int j = 0; j < s; ++j) sum += a.data()[i + j * s] * x[j];
  return sum;
}

/// a times x.
template <int s>
[[nodiscard]] inline double dot(const Column<s>& a, const double* x) {
  double sum = 0;
  for (int j = 0; j < s; ++j) sum += a.data()[j] * x[j];
  return sum;
}

/// Largest of |x_0|, ..., |x_{s-1}|; not for NaN.
template <int s>
[[nodiscard]] inline double largest(const double* x) {
  double most = 0;
  for (int j = 0; j < s; ++j) most = std::max(most, std::abs(x[j]));
  return most;
}

/// Are all of x_0, ..., x_{count-1} finite?
[[nodiscard]] inline bool all_finite(const double* x, Eigen::Index count) {
  double sum = 0;
  for (Eigen::Index i = 0; i < count; ++i) sum += 0 * x[i];
  return sum == 0;
}

/// Factors of the recurrence (j + 1) P_{j+1} = (2j + 1) x P_j - j P_{j-1}, as quotients.
struct LegendreRecurrence {
  std::array<double, 16> up{};    ///< (2j + 1)/(j + 1)
  std::array<double, 16> down{};  ///< (j + 1)/(j + 2)
};
/// The factors, computed once.
inline constexpr LegendreRecurrence legendre_recurrence = [] {
  LegendreRecurrence r;
  for (std::size_t j = 0; j < r.up.size(); ++j) {
    const auto k = static_cast<double>(j);
    r.up[j] = (2 * k + 1) / (k + 1);
    r.down[j] = (k + 1) / (k + 2);
  }
  return r;
}();

/// y_i = c_0 P_0(x_i) + ... + c_degree P_degree(x_i), by Clenshaw's recurrence for all i at a time.
template <int s>
inline void legendre_sums(const double* c, int degree, const Column<s>& x, double* y) {
  Column<s> b = Column<s>::Zero(), above = b;
  for (int j = degree; j >= 1; --j) {
    const auto k = static_cast<std::size_t>(j);
    for (int i = 0; i < s; ++i) {
      const double next =
          c[j] + legendre_recurrence.up[k] * x[i] * b[i] - legendre_recurrence.down[k] * above[i];
      above[i] = b[i];
      b[i] = next;
    }
  }
  for (int i = 0; i < s; ++i) y[i] = c[0] + x[i] * b[i] - above[i] / 2;
}

}  // namespace nlmech::ivp::adaptive

/// @file
/// Truncated power series in one variable, for the Taylor coefficients of solutions.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include "nlmech/program/number_traits.hpp"
#include "nlmech/program/recurrences.hpp"
#include "nlmech/program/series_functions.hpp"
#include "nlmech/program/value_of.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech {

/// c_0 + c_1 s + ... + c_k s^k, with unknown terms beyond s^k. An operation on two series gives the lower of
/// the two orders k, so unknown terms are never used.
///
/// A series without stored coefficients is the constant 0. A constant (made from a number), such as a
/// coefficient of an equation, stores one coefficient; its order is unlimited.
///
/// There is no order relation (<, >): a program branches on value_of() of a series. An operation costs k^2/2
/// multiplications and allocates memory for its result.
///
/// The error of coefficient k of a product is at most (k + 1) eps sum |a_i b_{k-i}|. The other functions are
/// recursive; up to order 30 their errors are 2k to 3k units in the last place for series with known
/// coefficients (tests/series, in double, long double and 50 digits).
template <class T>
class PowerSeries {
 public:
  using Coefficient = T;  ///< number type

  /// The constant 0.
  PowerSeries() = default;

  /// A constant.
  template <class S>
  requires std::convertible_to<S, T> PowerSeries(const S& constant)
      : c_{static_cast<T>(constant)}, constant_(true) {}

  /// Series with the coefficients @p c; its order is their number minus one. Without coefficients: the
  /// constant 0.
  explicit PowerSeries(std::vector<T> c) : c_(std::move(c)), constant_(c_.empty()) {}

  /// The variable about the point @p at: at + s, to the order @p order >= 1.
  [[nodiscard]] static PowerSeries variable(const T& at, std::size_t order) {
    std::vector<T> c(std::max<std::size_t>(order, 1) + 1, T(0));
    c[0] = at;
    c[1] = T(1);
    return PowerSeries(std::move(c));
  }

  /// Is it a constant, known to every order?
  [[nodiscard]] bool is_constant() const { return constant_; }
  /// Number of stored coefficients: the order plus one; at most 1 for a constant.
  [[nodiscard]] std::size_t size() const { return c_.size(); }
  /// The stored coefficients.
  [[nodiscard]] const std::vector<T>& coefficients() const { return c_; }
  /// Coefficient of s^i; 0 beyond the stored ones.
  [[nodiscard]] T operator[](std::size_t i) const { return i < c_.size() ? c_[i] : T(0); }

  /// The same quantity.
  PowerSeries operator+() const { return *this; }
  /// Its negative.
  PowerSeries operator-() const {
    PowerSeries r = *this;
    for (T& c : r.c_) c = -c;
    return r;
  }

  /// Adds a series.
  PowerSeries& operator+=(const PowerSeries& b) {
    match(b);
    for (std::size_t i = 0; i < std::min(c_.size(), b.c_.size()); ++i) c_[i] += b.c_[i];
    return *this;
  }
  /// Subtracts a series.
  PowerSeries& operator-=(const PowerSeries& b) {
    match(b);
    for (std::size_t i = 0; i < std::min(c_.size(), b.c_.size()); ++i) c_[i] -= b.c_[i];
    return *this;
  }
  /// Multiplies by a series.
  PowerSeries& operator*=(const PowerSeries& b) { return *this = *this * b; }
  /// Divides by a series.
  PowerSeries& operator/=(const PowerSeries& b) { return *this = *this / b; }

  /// Sum.
  friend PowerSeries operator+(PowerSeries a, const PowerSeries& b) { return std::move(a += b); }
  /// Difference.
  friend PowerSeries operator-(PowerSeries a, const PowerSeries& b) { return std::move(a -= b); }
  /// Product (Cauchy's).
  friend PowerSeries operator*(const PowerSeries& a, const PowerSeries& b) {
    if (a.constant_) return scaled(b, a[0]);
    if (b.constant_) return scaled(a, b[0]);
    PowerSeries r(std::vector<T>(std::min(a.size(), b.size()), T(0)));
    for (std::size_t k = 0; k < r.size(); ++k) r.c_[k] = recurrence::product(a.c_.data(), b.c_.data(), k);
    return r;
  }
  /// Quotient. A divisor with c_0 = 0 gives infinities and NaN, as for numbers.
  friend PowerSeries operator/(const PowerSeries& a, const PowerSeries& b) {
    if (b.constant_) return divided(a, b[0]);
    PowerSeries r(std::vector<T>(a.constant_ ? b.size() : std::min(a.size(), b.size()), T(0)));
    for (std::size_t k = 0; k < r.size(); ++k)
      r.c_[k] = recurrence::quotient(a[k], b.c_.data(), r.c_.data(), k);
    return r;
  }

  /// The series with the coefficients next(a, r, k); a are the coefficients of this series, r those of the
  /// result below k.
  template <class Next>
  [[nodiscard]] PowerSeries by_recurrence(const Next& next) const {
    const T constant = (*this)[0];
    if (constant_) return T(next(&constant, nullptr, 0));
    std::vector<T> r(size(), T(0));
    for (std::size_t k = 0; k < r.size(); ++k) r[k] = next(c_.data(), r.data(), k);
    return PowerSeries(std::move(r));
  }
  /// The integral of g da from the expansion point, where a is this series; 0 if a is a constant.
  [[nodiscard]] PowerSeries integral_of(const PowerSeries& g) const {
    if (constant_) return {};
    if (g.constant_) {
      PowerSeries r = scaled(*this, g[0]);
      r.c_[0] = T(0);
      return r;
    }
    PowerSeries r(std::vector<T>(std::min(size(), g.size()), T(0)));
    for (std::size_t k = 1; k < r.size(); ++k)
      r.c_[k] = recurrence::slope_product(c_.data(), g.c_.data(), k) / static_cast<int>(k);
    return r;
  }
  /// Two coupled series: r_k = first(a, g, k), then g_k = second(a, r, k).
  template <class First, class Second>
  [[nodiscard]] std::pair<PowerSeries, PowerSeries> by_recurrences(const First& first,
                                                                   const Second& second) const {
    const T constant = (*this)[0];
    if (constant_) {
      const T one = first(&constant, nullptr, 0);
      return {one, T(second(&constant, &one, 0))};
    }
    std::vector<T> r(size(), T(0)), g(size(), T(0));
    for (std::size_t k = 0; k < r.size(); ++k) {
      r[k] = first(c_.data(), g.data(), k);
      g[k] = second(c_.data(), r.data(), k);
    }
    return {PowerSeries(std::move(r)), PowerSeries(std::move(g))};
  }

 private:
  /// Sets the order of a sum with @p b: a constant is extended, a longer series is truncated.
  void match(const PowerSeries& b) {
    if (b.constant_) {
      if (c_.empty() && !b.c_.empty()) c_.resize(1, T(0));
      return;
    }
    if (constant_ || c_.size() > b.c_.size()) c_.resize(b.c_.size(), T(0));
    constant_ = false;
  }
  static PowerSeries scaled(PowerSeries a, const T& s) {
    for (T& c : a.c_) c *= s;
    return a;
  }
  static PowerSeries divided(PowerSeries a, const T& s) {
    for (T& c : a.c_) c /= s;
    return a;
  }

  std::vector<T> c_;
  bool constant_ = true;
};

/// The value of the coefficient c_0.
template <class T>
[[nodiscard]] auto value_of(const PowerSeries<T>& a) {
  return value_of(a[0]);
}

extern template class PowerSeries<double>;
extern template class PowerSeries<long double>;

}  // namespace nlmech

/// @cond Doxygen cannot follow specialisations of another library's templates
// Traits of power series as entries of Eigen vectors and matrices.
template <class T>
struct Eigen::NumTraits<nlmech::PowerSeries<T>>
    : nlmech::detail::NumberTraits<nlmech::PowerSeries<T>, 50, 50, 500> {};
/// @endcond

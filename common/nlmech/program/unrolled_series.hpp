/// @file
/// Power series with one function per pass: the index of the coefficient is a compile-time constant, so all
/// sums are unrolled and all memory offsets are constants.
///
/// An expression is evaluated once for every order, as with GrowingSeries, but each time with another type:
/// UnrolledSeries<k> computes coefficient k of each operation from those below. Sums have four partial sums,
/// squares half of the products. The two products with the newest coefficients come last, so the other terms
/// do not wait for them. Arithmetic is strict IEEE: the compiler reorders nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "nlmech/program/expansion_errors.hpp"
#include "nlmech/program/number_traits.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech {

namespace unrolled {

/// Highest unrolled order of a solution; the tape computes higher ones. Instrumented code is many times
/// larger and takes minutes to compile: with a sanitizer fewer orders are unrolled.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr int most_order = 10;
#else
inline constexpr int most_order = 33;
#endif
inline constexpr std::ptrdiff_t stride =
    std::ptrdiff_t{most_order + 8} / 8 * 8;     ///< distance between series in memory
inline constexpr int not_polynomial = 1 << 20;  ///< degree of an expression that is not a polynomial in time

/// The sum of a[i] b[-i] for i = 0, ..., n - 1, in four partial sums.
template <int n>
[[nodiscard, gnu::always_inline]] inline double sum(const double* a, const double* b) {
  if constexpr (n == 0) {
    return 0;
  } else if constexpr (n == 1) {
    return a[0] * b[0];
  } else if constexpr (n == 2) {
    return a[0] * b[0] + a[1] * b[-1];
  } else if constexpr (n == 3) {
    return (a[0] * b[0] + a[1] * b[-1]) + a[2] * b[-2];
  } else {
    double s0 = a[0] * b[0], s1 = a[1] * b[-1], s2 = a[2] * b[-2], s3 = a[3] * b[-3];
    constexpr int whole = n / 4 * 4;
#pragma GCC unroll 16
    for (int i = 4; i < whole; i += 4) {
      s0 += a[i] * b[-i];
      s1 += a[i + 1] * b[-i - 1];
      s2 += a[i + 2] * b[-i - 2];
      s3 += a[i + 3] * b[-i - 3];
    }
    if constexpr (n % 4 > 0) s0 += a[whole] * b[-whole];
    if constexpr (n % 4 > 1) s1 += a[whole + 1] * b[-whole - 1];
    if constexpr (n % 4 > 2) s2 += a[whole + 2] * b[-whole - 2];
    return (s0 + s1) + (s2 + s3);
  }
}

/// The sum of a[i] a[n + 1 - i] for i = 1, ..., n: each product once.
template <int n>
[[nodiscard, gnu::always_inline]] inline double inner_square(const double* a) {
  if constexpr (n <= 0) {
    return 0;
  } else {
    const double half = 2 * sum<n / 2>(a + 1, a + n);
    if constexpr (n % 2 == 1) return half + a[(n + 1) / 2] * a[(n + 1) / 2];
    return half;
  }
}

}  // namespace unrolled

/// One pass over the operations of an expression: assigns memory in the order of the operations.
template <int k>
struct UnrolledPass {
  double* memory;  ///< series i starts at memory + i stride; null: operations are only counted
  int used;        ///< number of series with memory
  bool announced;  ///< does the problem give its discontinuities?
};

/// A power series in the pass for coefficient k, or a constant; see the head of this file. It has arithmetic,
/// roots, exponentials, sines and cosines; equations with other functions use the tape.
template <int k>
class UnrolledSeries {
 public:
  /// The constant 0.
  UnrolledSeries() = default;

  /// A constant.
  template <class S>
  requires std::convertible_to<S, double>
  [[gnu::always_inline]] UnrolledSeries(const S& constant) : value_(static_cast<double>(constant)) {}

  /// The variable number @p series, of which coefficient k is @p value.
  [[nodiscard, gnu::always_inline]] static UnrolledSeries variable(UnrolledPass<k>& pass, int series,
                                                                   double value, bool is_time) {
    UnrolledSeries v;
    v.pass_ = &pass;
    v.series_ = series;
    v.value_ = value;
    v.degree_ = is_time ? 1 : unrolled::not_polynomial;
    v.timed_ = is_time;
    return v;
  }

  /// Coefficient k.
  [[nodiscard, gnu::always_inline]] double coefficient() const { return is_constant() && k > 0 ? 0 : value_; }

  /// The same quantity.
  [[gnu::always_inline]] UnrolledSeries operator+() const { return *this; }
  /// Its negative.
  [[gnu::always_inline]] UnrolledSeries operator-() const {
    if (is_constant()) return -value_;
    return linear(*this, *this, -value_);
  }
  /// Sum.
  [[gnu::always_inline]] friend UnrolledSeries operator+(const UnrolledSeries& a, const UnrolledSeries& b) {
    if (a.is_constant() && b.is_constant()) return a.value_ + b.value_;
    return linear(a, b, a.coefficient() + b.coefficient());
  }
  /// Difference.
  [[gnu::always_inline]] friend UnrolledSeries operator-(const UnrolledSeries& a, const UnrolledSeries& b) {
    if (a.is_constant() && b.is_constant()) return a.value_ - b.value_;
    return linear(a, b, a.coefficient() - b.coefficient());
  }
  /// Product.
  [[gnu::always_inline]] friend UnrolledSeries operator*(const UnrolledSeries& a, const UnrolledSeries& b) {
    if (a.is_constant() && b.is_constant()) return a.value_ * b.value_;
    if (a.is_constant() || b.is_constant()) return linear(a, b, a.value_ * b.value_);
    UnrolledSeries r = result(a, b);
    r.degree_ = a.degree_ < unrolled::not_polynomial && b.degree_ < unrolled::not_polynomial
                    ? a.degree_ + b.degree_
                    : unrolled::not_polynomial;
    return r.keep(product(a, b));
  }
  /// Quotient. A divisor with c_0 = 0 gives infinities and NaN, as for numbers.
  [[gnu::always_inline]] friend UnrolledSeries operator/(const UnrolledSeries& a, const UnrolledSeries& b) {
    if (a.is_constant() && b.is_constant()) return a.value_ / b.value_;
    if (b.is_constant()) return linear(a, b, a.coefficient() / b.value_);
    UnrolledSeries r = result(a, b);
    if constexpr (k <= 0) return r.keep(a.value_ / b.value_);
    const double* d = b.data();
    // r_0 b_k last: the newest coefficient of the divisor
    const double rest = a.coefficient() - unrolled::sum<inner>(d + 1, r.data() + k - 1);
    return r.keep((rest - r.data()[0] * b.value_) / d[0]);
  }
  /// Adds a series.
  [[gnu::always_inline]] UnrolledSeries& operator+=(const UnrolledSeries& b) { return *this = *this + b; }
  /// Subtracts a series.
  [[gnu::always_inline]] UnrolledSeries& operator-=(const UnrolledSeries& b) { return *this = *this - b; }
  /// Multiplies by a series.
  [[gnu::always_inline]] UnrolledSeries& operator*=(const UnrolledSeries& b) { return *this = *this * b; }
  /// Divides by a series.
  [[gnu::always_inline]] UnrolledSeries& operator/=(const UnrolledSeries& b) { return *this = *this / b; }

  /// Square root, for c_0 > 0.
  [[gnu::always_inline]] friend UnrolledSeries sqrt(const UnrolledSeries& a) {
    if (a.is_constant()) return std::sqrt(a.value_);
    UnrolledSeries r = result(a, a);
    if constexpr (k <= 0) return r.keep(std::sqrt(a.value_));
    const double* d = r.data();
    return r.keep((a.value_ - unrolled::inner_square<inner>(d)) / (2 * d[0]));
  }
  /// Exponential function.
  [[gnu::always_inline]] friend UnrolledSeries exp(const UnrolledSeries& a) {
    if (a.is_constant()) return std::exp(a.value_);
    const UnrolledSeries slope = a.slope();
    UnrolledSeries r = result(a, a);
    if constexpr (k <= 0) return r.keep(std::exp(a.value_));
    return r.keep(slope.times_rest(r, a.degree_) / k);
  }
  /// Sine and cosine of one argument, by coupled recurrences.
  [[gnu::always_inline]] friend std::pair<UnrolledSeries, UnrolledSeries> sin_cos(const UnrolledSeries& a) {
    if (a.is_constant()) return {std::sin(a.value_), std::cos(a.value_)};
    const UnrolledSeries d = a.slope();
    UnrolledSeries sine = result(a, a), cosine = result(a, a);
    if constexpr (k <= 0) {
      sine.keep(std::sin(a.value_));
      cosine.keep(std::cos(a.value_));
    } else {
      const double next_sine = d.times_rest(cosine, a.degree_) / k,
                   next_cosine = d.times_rest(sine, a.degree_) / k;
      sine.keep(next_sine);
      cosine.keep(-next_cosine);
    }
    return {sine, cosine};
  }
  /// Sine.
  [[gnu::always_inline]] friend UnrolledSeries sin(const UnrolledSeries& a) { return sin_cos(a).first; }
  /// Cosine.
  [[gnu::always_inline]] friend UnrolledSeries cos(const UnrolledSeries& a) { return sin_cos(a).second; }
  /// a^p by repeated squaring; p < 0 needs c_0 != 0.
  template <std::integral P>
  [[gnu::always_inline]] friend UnrolledSeries pow(const UnrolledSeries& a, P p) {
    if (p == 0) return 1;
    UnrolledSeries r = 1, square = a;
    for (P rest = p < 0 ? -p : p;; rest /= 2, square = square * square) {
      if (rest % 2 == 1) r = r.is_constant() ? square : r * square;
      if (rest == 1) return p < 0 ? 1 / r : r;
    }
  }
  /// The value of c_0, for a branch. @throws std::invalid_argument if it depends on the state, or if the
  /// problem does not give its discontinuities
  [[gnu::always_inline]] friend double value_of(const UnrolledSeries& a) {
    if (a.is_constant()) return a.value_;
    if (!a.timed_ || !a.pass_->announced) throw_unannounced_branch(a.timed_);
    return k <= 0 ? a.value_ : a.data()[0];
  }

 private:
  static constexpr int inner = k > 0 ? k - 1 : 0;  ///< products without the newest coefficients

  [[nodiscard, gnu::always_inline]] bool is_constant() const { return pass_ == nullptr; }
  [[nodiscard, gnu::always_inline]] double* data() const {
    return pass_->memory + series_ * unrolled::stride;
  }

  /// The series of the next operation, on @p a and @p b.
  [[gnu::always_inline]] static UnrolledSeries result(const UnrolledSeries& a, const UnrolledSeries& b) {
    UnrolledSeries r;
    r.pass_ = a.is_constant() ? b.pass_ : a.pass_;
    r.series_ = r.pass_->used++;
    r.degree_ = unrolled::not_polynomial;
    r.timed_ = (a.is_constant() || a.timed_) && (b.is_constant() || b.timed_);
    return r;
  }
  /// Writes coefficient k.
  [[gnu::always_inline]] UnrolledSeries& keep(double value) {
    value_ = value;
    if constexpr (k >= 0) data()[k] = value;
    return *this;
  }
  [[gnu::always_inline]] static UnrolledSeries linear(const UnrolledSeries& a, const UnrolledSeries& b,
                                                      double value) {
    UnrolledSeries r = result(a, b);
    r.degree_ = std::max(a.is_constant() ? 0 : a.degree_, b.is_constant() ? 0 : b.degree_);
    return r.keep(value);
  }
  [[gnu::always_inline]] static double product(const UnrolledSeries& a, const UnrolledSeries& b) {
    if constexpr (k <= 0) {
      return a.value_ * b.value_;
    } else {
      if (a.series_ == b.series_) {
        return unrolled::inner_square<inner>(a.data()) + 2 * (a.data()[0] * a.value_);
      }
      if (a.degree_ == 1) return a.data()[0] * b.value_ + a.data()[1] * b.data()[k - 1];
      if (b.degree_ == 1) return b.data()[0] * a.value_ + b.data()[1] * a.data()[k - 1];
      const double old = unrolled::sum<inner>(a.data() + 1, b.data() + k - 1);
      return old + (a.data()[0] * b.value_ + a.value_ * b.data()[0]);
    }
  }
  /// The series s a'(s), for functions with a differential equation.
  [[nodiscard, gnu::always_inline]] UnrolledSeries slope() const {
    UnrolledSeries r = result(*this, *this);
    r.degree_ = degree_;
    return r.keep(k > 0 ? k * value_ : 0);
  }
  /// Coefficient k of this slope times @p r, whose coefficients below k are known.
  [[nodiscard, gnu::always_inline]] double times_rest(const UnrolledSeries& r, int polynomial_degree) const {
    if constexpr (k <= 0) {
      return 0;
    } else {
      if (polynomial_degree == 1) return data()[1] * r.data()[k - 1];
      return unrolled::sum<inner>(data() + 1, r.data() + k - 1) + value_ * r.data()[0];
    }
  }

  UnrolledPass<k>* pass_ = nullptr;
  int series_ = -1, degree_ = 0;
  bool timed_ = true;
  double value_ = 0;
};

}  // namespace nlmech

/// @cond Doxygen cannot follow specialisations of another library's templates
// Traits of these series as entries of Eigen vectors.
template <int k>
struct Eigen::NumTraits<nlmech::UnrolledSeries<k>>
    : nlmech::detail::NumberTraits<nlmech::UnrolledSeries<k>, 5, 10, 100> {};
/// @endcond

/// @file
/// Non-negative numbers with the precision of double and a larger exponent range.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace nlmech::collocation {

/// m 2^e with 1/2 <= m < 1, or zero. For products of many node differences and exponentials of squares that
/// exceed the range of double although their quotients do not. Each operation rounds once, as for double.
class Wide {
 public:
  constexpr Wide() = default;

  /// @param x non-negative, finite
  Wide(double x) {  // NOLINT(google-explicit-constructor): a double is one
    if (x == 0) return;
    int e = 0;
    m_ = std::frexp(x, &e);
    e_ = e;
  }

  /// exp(x) for |x| < 1e9; its relative error is 2.2e-16 plus the absolute error of x.
  [[nodiscard]] static Wide exp(double x) {
    // ln 2 in two parts; the first has enough trailing zeros to make its product with k exact.
    constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    const double k = std::nearbyint(x / (ln2_high + ln2_low));
    Wide result(std::exp((x - k * ln2_high) - k * ln2_low));
    result.e_ += static_cast<std::int64_t>(k);
    return result;
  }

  /// Conversion to double: infinite above its range, zero below.
  [[nodiscard]] double value() const {
    constexpr std::int64_t bound = 4000;  // beyond every exponent of a double
    return std::ldexp(m_, static_cast<int>(e_ > bound ? bound : (e_ < -bound ? -bound : e_)));
  }

  /// Decimal logarithm; minus infinity for zero.
  [[nodiscard]] double log10() const {
    constexpr double log10_2 = 0.30102999566398119521;
    return std::log10(m_) + static_cast<double>(e_) * log10_2;
  }

  /// Product.
  [[nodiscard]] friend Wide operator*(Wide a, Wide b) { return normal(a.m_ * b.m_, a.e_ + b.e_); }

  /// Quotient; @p b is not zero.
  [[nodiscard]] friend Wide operator/(Wide a, Wide b) { return normal(a.m_ / b.m_, a.e_ - b.e_); }

  /// Sum.
  [[nodiscard]] friend Wide operator+(Wide a, Wide b) {
    if (a.e_ < b.e_) std::swap(a, b);
    return normal(a.m_ + scaled(b.m_, b.e_ - a.e_), a.e_);
  }

 private:
  static constexpr std::int64_t zero_exponent = -(std::int64_t{1} << 60);

  /// For m = 0 or 1/4 < m < 2.
  [[nodiscard]] static Wide normal(double m, std::int64_t e) {
    Wide result;
    if (m == 0) return result;
    const bool large = m >= 1, small = m < 0.5;
    result.m_ = large ? m / 2 : (small ? m * 2 : m);
    result.e_ = large ? e + 1 : (small ? e - 1 : e);
    return result;
  }

  /// m 2^e for e <= 0; zero if below the last digit of 1/2.
  [[nodiscard]] static double scaled(double m, std::int64_t e) {
    constexpr std::int64_t bias = 1023, digits = 64;
    constexpr int fraction = 52;
    if (e < -digits) return 0;
    return m * std::bit_cast<double>(static_cast<std::uint64_t>(bias + e) << fraction);
  }

  double m_ = 0;
  std::int64_t e_ = zero_exponent;
};

}  // namespace nlmech::collocation

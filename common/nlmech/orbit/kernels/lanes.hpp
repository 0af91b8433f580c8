/// @file
/// Vectors of four and five doubles as the Taylor kernels use them, without special instructions. Internal.
#pragma once

namespace nlmech::orbit::kernels {

/// For any processor: the compiler makes of it what the architecture has. Products are rounded.
struct Baseline {
  static constexpr bool fuses = false;  ///< multiply_add() and fused() round once
  struct Four {
    using Lanes [[gnu::vector_size(32)]] = double;
    Lanes v;

    [[gnu::always_inline]] static Four all(double x) { return {Lanes{x, x, x, x}}; }
    [[gnu::always_inline]] static Four load(const double* from) {
      return {Lanes{from[0], from[1], from[2], from[3]}};
    }
    [[gnu::always_inline]] void store(double* to) const {
      for (int i = 0; i < 4; ++i) to[i] = v[i];
    }
    [[gnu::always_inline]] friend Four operator+(const Four& a, const Four& b) { return {a.v + b.v}; }
    [[gnu::always_inline]] friend Four operator-(const Four& a, const Four& b) { return {a.v - b.v}; }
    [[gnu::always_inline]] friend Four operator*(const Four& a, const Four& b) { return {a.v * b.v}; }
    [[gnu::always_inline]] friend Four operator/(const Four& a, const Four& b) { return {a.v / b.v}; }
    /// a b + c
    [[gnu::always_inline]] friend Four multiply_add(const Four& a, const Four& b, const Four& c) {
      return {a.v * b.v + c.v};
    }
    /// Of the first three lanes.
    [[gnu::always_inline]] friend double sum3(const Four& a) { return (a.v[0] + a.v[1]) + a.v[2]; }
  };
  struct Five {
    Four low;
    double high;

    [[gnu::always_inline]] static Five zero() { return {Four::all(0), 0}; }
    /// The first three lanes of r, then a and b.
    [[gnu::always_inline]] static Five of(Four r, double a, double b) {
      r.v[3] = a;
      return {r, b};
    }
    [[gnu::always_inline]] friend Five operator+(const Five& a, const Five& b) {
      return {a.low + b.low, a.high + b.high};
    }
    [[gnu::always_inline]] friend Five operator*(const Five& a, double b) {
      return {a.low * Four::all(b), a.high * b};
    }
    /// a b + c
    [[gnu::always_inline]] friend Five multiply_add(const Five& a, double b, const Five& c) {
      return {multiply_add(a.low, Four::all(b), c.low), a.high * b + c.high};
    }
    [[gnu::always_inline]] Four four() const { return low; }
    [[gnu::always_inline]] double fourth() const { return low.v[3]; }
    [[gnu::always_inline]] double fifth() const { return high; }
  };
  [[gnu::always_inline]] static double fused(double a, double b, double c) { return a * b + c; }
};

}  // namespace nlmech::orbit::kernels

/// @file
/// The lanes of lanes.hpp in AVX registers, with fused multiply-adds. Internal to the kernels.
#pragma once

#include <immintrin.h>

namespace nlmech::orbit::kernels {

struct QuadAvx2 {
  __m256d v;

  [[gnu::always_inline]] static QuadAvx2 all(double x) { return {_mm256_set1_pd(x)}; }
  [[gnu::always_inline]] static QuadAvx2 load(const double* from) { return {_mm256_loadu_pd(from)}; }
  [[gnu::always_inline]] void store(double* to) const { _mm256_storeu_pd(to, v); }
  [[gnu::always_inline]] friend QuadAvx2 operator+(QuadAvx2 a, QuadAvx2 b) {
    return {_mm256_add_pd(a.v, b.v)};
  }
  [[gnu::always_inline]] friend QuadAvx2 operator-(QuadAvx2 a, QuadAvx2 b) {
    return {_mm256_sub_pd(a.v, b.v)};
  }
  [[gnu::always_inline]] friend QuadAvx2 operator*(QuadAvx2 a, QuadAvx2 b) {
    return {_mm256_mul_pd(a.v, b.v)};
  }
  [[gnu::always_inline]] friend QuadAvx2 multiply_add(QuadAvx2 a, QuadAvx2 b, QuadAvx2 c) {
    return {_mm256_fmadd_pd(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend double sum3(QuadAvx2 a) {
    const __m128d low = _mm256_castpd256_pd128(a.v), high = _mm256_extractf128_pd(a.v, 1);
    return _mm_cvtsd_f64(_mm_add_sd(_mm_add_sd(low, _mm_unpackhi_pd(low, low)), high));
  }
};

struct Avx2 {
  static constexpr bool fuses = true;  ///< multiply_add() and fused() round once
  using Four = QuadAvx2;
  struct Five {
    Four low;
    double high;

    [[gnu::always_inline]] static Five zero() { return {Four::all(0), 0}; }
    [[gnu::always_inline]] static Five of(Four r, double a, double b) {
      return {{_mm256_blend_pd(r.v, _mm256_set1_pd(a), 8)}, b};
    }
    [[gnu::always_inline]] friend Five operator+(Five a, Five b) { return {a.low + b.low, a.high + b.high}; }
    [[gnu::always_inline]] friend Five operator*(Five a, double b) {
      return {a.low * Four::all(b), a.high * b};
    }
    [[gnu::always_inline]] friend Five multiply_add(Five a, double b, Five c) {
      return {multiply_add(a.low, Four::all(b), c.low), Avx2::fused(a.high, b, c.high)};
    }
    [[gnu::always_inline]] Four four() const { return low; }
    [[gnu::always_inline]] double fourth() const { return low.v[3]; }
    [[gnu::always_inline]] double fifth() const { return high; }
  };
  [[gnu::always_inline]] static double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }
};

}  // namespace nlmech::orbit::kernels

/// @file
/// The lanes of lanes.hpp in AVX-512 registers: five doubles in one. Internal to the kernels.
#pragma once

#include <immintrin.h>

namespace nlmech::orbit::kernels {

struct QuadAvx512 {
  __m256d v;

  [[gnu::always_inline]] static QuadAvx512 all(double x) { return {_mm256_set1_pd(x)}; }
  [[gnu::always_inline]] static QuadAvx512 load(const double* from) { return {_mm256_loadu_pd(from)}; }
  [[gnu::always_inline]] void store(double* to) const { _mm256_storeu_pd(to, v); }
  [[gnu::always_inline]] friend QuadAvx512 operator+(QuadAvx512 a, QuadAvx512 b) {
    return {_mm256_add_pd(a.v, b.v)};
  }
  [[gnu::always_inline]] friend QuadAvx512 operator-(QuadAvx512 a, QuadAvx512 b) {
    return {_mm256_sub_pd(a.v, b.v)};
  }
  [[gnu::always_inline]] friend QuadAvx512 operator*(QuadAvx512 a, QuadAvx512 b) {
    return {_mm256_mul_pd(a.v, b.v)};
  }
  [[gnu::always_inline]] friend QuadAvx512 multiply_add(QuadAvx512 a, QuadAvx512 b, QuadAvx512 c) {
    return {_mm256_fmadd_pd(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend double sum3(QuadAvx512 a) {
    const __m128d low = _mm256_castpd256_pd128(a.v), high = _mm256_extractf128_pd(a.v, 1);
    return _mm_cvtsd_f64(_mm_add_sd(_mm_add_sd(low, _mm_unpackhi_pd(low, low)), high));
  }
};

struct Avx512 {
  static constexpr bool fuses = true;  ///< multiply_add() and fused() round once
  using Four = QuadAvx512;
  struct Five {
    __m512d v;

    [[gnu::always_inline]] static Five zero() { return {_mm512_setzero_pd()}; }
    [[gnu::always_inline]] static Five of(Four r, double a, double b) {
      const __m256d low = _mm256_blend_pd(r.v, _mm256_set1_pd(a), 8);
      return {__builtin_shufflevector(low, _mm256_set1_pd(b), 0, 1, 2, 3, 4, 5, 6, 7)};
    }
    [[gnu::always_inline]] friend Five operator+(Five a, Five b) { return {_mm512_add_pd(a.v, b.v)}; }
    [[gnu::always_inline]] friend Five operator*(Five a, double b) {
      return {_mm512_mul_pd(a.v, _mm512_set1_pd(b))};
    }
    [[gnu::always_inline]] friend Five multiply_add(Five a, double b, Five c) {
      return {_mm512_fmadd_pd(a.v, _mm512_set1_pd(b), c.v)};
    }
    [[gnu::always_inline]] Four four() const { return {__builtin_shufflevector(v, v, 0, 1, 2, 3)}; }
    [[gnu::always_inline]] double fourth() const { return v[3]; }
    [[gnu::always_inline]] double fifth() const { return v[4]; }
  };
  [[gnu::always_inline]] static double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }
};

}  // namespace nlmech::orbit::kernels

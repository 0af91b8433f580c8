/// @file
/// AVX2 with fused multiply-adds. Internal to the kernels, for sources that are compiled for it.
#pragma once

#include <immintrin.h>

#include "nlmech/support/kernels/pack.hpp"

namespace nlmech::simd {

/// Operations of Pack in AVX registers.
struct Avx2 {
  static constexpr int lanes = 4;      ///< doubles per register
  static constexpr bool fuses = true;  ///< multiply_add() rounds once

  /// See Pack.
  /// @{
  [[gnu::always_inline]] static double multiply_add(double a, double b, double c) {
    return __builtin_fma(a, b, c);
  }
  [[gnu::always_inline]] static __m128d multiply_add(__m128d a, __m128d b, __m128d c) {
    return _mm_fmadd_pd(a, b, c);
  }
  [[gnu::always_inline]] static __m256d multiply_add(__m256d a, __m256d b, __m256d c) {
    return _mm256_fmadd_pd(a, b, c);
  }
  template <class V>
  [[gnu::always_inline]] static V subtract_product(V a, V b, V c) {
    return multiply_add(-a, b, c);
  }
  [[gnu::always_inline]] static __m128d larger(__m128d a, __m128d b) { return _mm_max_pd(a, b); }
  [[gnu::always_inline]] static __m256d larger(__m256d a, __m256d b) { return _mm256_max_pd(a, b); }
  [[gnu::always_inline]] static __m128d smaller(__m128d a, __m128d b) { return _mm_min_pd(a, b); }
  [[gnu::always_inline]] static __m256d smaller(__m256d a, __m256d b) { return _mm256_min_pd(a, b); }
  template <class Mask>
  [[gnu::always_inline]] static Mask both(Mask a, Mask b) {
    return a & b;
  }
  [[gnu::always_inline]] static unsigned bits(Vectors<4>::Mask m) {
    return static_cast<unsigned>(_mm256_movemask_pd(__m256d(m)));
  }
  /// @}
};

}  // namespace nlmech::simd

/// @file
/// Instructions of every processor of the architecture. Internal to the kernels.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "nlmech/support/kernels/pack.hpp"

namespace nlmech::simd {

/// Operations of Pack for the baseline, mostly left to the compiler. Products are rounded.
struct Baseline {
  static constexpr int lanes = 2;       ///< doubles per register
  static constexpr bool fuses = false;  ///< multiply_add() rounds product and sum

  /// a b + c
  template <class V>
  [[gnu::always_inline]] static V multiply_add(V a, V b, V c) {
    return a * b + c;
  }
  /// c - a b
  template <class V>
  [[gnu::always_inline]] static V subtract_product(V a, V b, V c) {
    return c - a * b;
  }
  // Intrinsics for two lanes: GCC 12 repeats known comparisons and splits a mask that is used as bits.
#if defined(__SSE2__)
  /// See Pack.
  /// @{
  [[gnu::always_inline]] static __m128d larger(__m128d a, __m128d b) { return _mm_max_pd(a, b); }
  [[gnu::always_inline]] static __m128d smaller(__m128d a, __m128d b) { return _mm_min_pd(a, b); }
  template <class Mask>
  [[gnu::always_inline]] static Mask both(Mask a, Mask b) {
    return Mask(_mm_and_pd(__m128d(a), __m128d(b)));
  }
  template <class Mask>
  [[gnu::always_inline]] static unsigned bits(Mask m) {
    return static_cast<unsigned>(_mm_movemask_pd(__m128d(m)));
  }
  /// @}
#else
  /// See Pack.
  /// @{
  template <class V>
  [[gnu::always_inline]] static V larger(V a, V b) {
    return a > b ? a : b;
  }
  template <class V>
  [[gnu::always_inline]] static V smaller(V a, V b) {
    return a < b ? a : b;
  }
  template <class Mask>
  [[gnu::always_inline]] static Mask both(Mask a, Mask b) {
    return a & b;
  }
  template <class Mask>
  [[gnu::always_inline]] static unsigned bits(Mask m) {
    return (m[0] != 0 ? 1u : 0u) | (m[1] != 0 ? 2u : 0u);
  }
  /// @}
#endif
};

}  // namespace nlmech::simd

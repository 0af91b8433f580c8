/// @file
/// AVX-512 F, DQ and VL. Internal to the kernels, for sources that are compiled for it.
#pragma once

#include "nlmech/support/kernels/avx2.hpp"

namespace nlmech::simd {

/// Operations of Pack in AVX-512 registers, and in shorter ones as Avx2.
struct Avx512 : Avx2 {
  static constexpr int lanes = 8;  ///< doubles per register

  /// See Pack. The masked forms of max and min avoid a false warning of the unmasked ones about an
  /// uninitialised operand (GCC bug 105593); the code is the same.
  /// @{
  using Avx2::larger;
  using Avx2::multiply_add;
  using Avx2::smaller;
  using Avx2::subtract_product;
  [[gnu::always_inline]] static __m512d multiply_add(__m512d a, __m512d b, __m512d c) {
    return _mm512_fmadd_pd(a, b, c);
  }
  [[gnu::always_inline]] static __m512d subtract_product(__m512d a, __m512d b, __m512d c) {
    return _mm512_fnmadd_pd(a, b, c);
  }
  [[gnu::always_inline]] static __m512d larger(__m512d a, __m512d b) {
    return _mm512_maskz_max_pd(0xff, a, b);
  }
  [[gnu::always_inline]] static __m512d smaller(__m512d a, __m512d b) {
    return _mm512_maskz_min_pd(0xff, a, b);
  }
  [[gnu::always_inline]] static unsigned bits(Vectors<8>::Mask m) { return _mm512_movepi64_mask(__m512i(m)); }
  /// @}
};

}  // namespace nlmech::simd

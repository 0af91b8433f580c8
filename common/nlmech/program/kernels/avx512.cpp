#include "nlmech/support/kernels/avx512.hpp"

#include "nlmech/program/kernels/lanes.hpp"

namespace nlmech::tape {

namespace {

// Eight products at once, the rest under a mask.
struct Avx512Sum {
  [[gnu::always_inline]] static double of(const double* a, const double* b, int n) {
    if (n < 3) {
      double few = 0;
      for (int i = 0; i < n; ++i) few = __builtin_fma(a[i], b[-i], few);
      return few;
    }
    __m512d s = _mm512_setzero_pd();
    int i = 0;
    for (; i + 8 <= n; i += 8) {
      s = _mm512_fmadd_pd(_mm512_loadu_pd(a + i), reversed(_mm512_loadu_pd(b - i - 7)), s);
    }
    if (i < n) {
      const auto few = static_cast<__mmask8>((1U << static_cast<unsigned>(n - i)) - 1U);
      const __m512d later = _mm512_maskz_loadu_pd(few, a + i);
      const __m512d earlier = _mm512_maskz_loadu_pd(mirrored(few), b - i - 7);
      s = _mm512_fmadd_pd(later, reversed(earlier), s);
    }
    const __m256d half =
        _mm256_add_pd(_mm512_maskz_extractf64x4_pd(0xf, s, 0), _mm512_maskz_extractf64x4_pd(0xf, s, 1));
    const __m128d pair = _mm_add_pd(_mm256_castpd256_pd128(half), _mm256_extractf128_pd(half, 1));
    return _mm_cvtsd_f64(pair) + _mm_cvtsd_f64(_mm_unpackhi_pd(pair, pair));
  }
  [[gnu::always_inline]] static __m512d reversed(__m512d v) {
    return _mm512_maskz_permutexvar_pd(0xff, _mm512_set_epi64(0, 1, 2, 3, 4, 5, 6, 7), v);
  }
  // The lowest m bits become the highest of eight.
  [[gnu::always_inline]] static __mmask8 mirrored(__mmask8 few) {
    return static_cast<__mmask8>(~(0xffU >> static_cast<unsigned>(__builtin_popcount(few))));
  }
};

}  // namespace

const Replay avx512_replay = Replayer<One<Avx512Sum>>::run;
const LaneKernel avx512_lanes = lane_kernel<ManyInFours<simd::Pack<simd::Avx512, 16>>>;

}  // namespace nlmech::tape

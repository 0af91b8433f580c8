#include "nlmech/support/kernels/avx2.hpp"

#include "nlmech/program/kernels/lanes.hpp"

namespace nlmech::tape {

namespace {

// Sums four products at once in two vector sums, the remainder one by one.
struct Avx2Sum {
  [[gnu::always_inline]] static double of(const double* a, const double* b, int n) {
    double rest = 0;
    if (n < 4) {
      for (int i = 0; i < n; ++i) rest = __builtin_fma(a[i], b[-i], rest);
      return rest;
    }
    __m256d s0 = _mm256_mul_pd(_mm256_loadu_pd(a), reversed(b));
    __m256d s1 = _mm256_setzero_pd();
    int i = 4;
    for (; i + 8 <= n; i += 8) {
      s1 = _mm256_fmadd_pd(_mm256_loadu_pd(a + i), reversed(b - i), s1);
      s0 = _mm256_fmadd_pd(_mm256_loadu_pd(a + i + 4), reversed(b - i - 4), s0);
    }
    if (i + 4 <= n) {
      s1 = _mm256_fmadd_pd(_mm256_loadu_pd(a + i), reversed(b - i), s1);
      i += 4;
    }
    for (; i < n; ++i) rest = __builtin_fma(a[i], b[-i], rest);
    const __m256d s = _mm256_add_pd(s0, s1);
    const __m128d pair = _mm_add_pd(_mm256_castpd256_pd128(s), _mm256_extractf128_pd(s, 1));
    return (_mm_cvtsd_f64(pair) + _mm_cvtsd_f64(_mm_unpackhi_pd(pair, pair))) + rest;
  }
  // b[0], b[-1], b[-2], b[-3]
  [[gnu::always_inline]] static __m256d reversed(const double* b) {
    return _mm256_permute4x64_pd(_mm256_loadu_pd(b - 3), 0x1b);
  }
};

}  // namespace

const Replay avx2_replay = Replayer<One<Avx2Sum>>::run;
const LaneKernel avx2_lanes = lane_kernel<ManyInFours<simd::Pack<simd::Avx2, 8>>>;

}  // namespace nlmech::tape

#include "nlmech/support/kernels/baseline.hpp"

#include "nlmech/program/kernels/lanes.hpp"

namespace nlmech::tape {

namespace {

struct BaselineSum {
  [[gnu::always_inline]] static double of(const double* a, const double* b, int n) {
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    int i = 0;
    for (; i + 4 <= n; i += 4) {
      s0 += a[i] * b[-i];
      s1 += a[i + 1] * b[-i - 1];
      s2 += a[i + 2] * b[-i - 2];
      s3 += a[i + 3] * b[-i - 3];
    }
    for (; i < n; ++i) s0 += a[i] * b[-i];
    return (s0 + s1) + (s2 + s3);
  }
};

}  // namespace

const Replay baseline_replay = Replayer<One<BaselineSum>>::run;
const LaneKernel baseline_lanes = lane_kernel<ManyRounded<simd::Pack<simd::Baseline, 4>>>;

}  // namespace nlmech::tape

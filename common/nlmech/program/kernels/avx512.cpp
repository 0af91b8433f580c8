#include "nlmech/support/kernels/avx512.hpp"

#include "nlmech/program/kernels/lanes.hpp"

namespace nlmech::tape {

const LaneKernel avx512_lanes = lane_kernel<ManyInFours<simd::Pack<simd::Avx512, 16>>>;

}  // namespace nlmech::tape

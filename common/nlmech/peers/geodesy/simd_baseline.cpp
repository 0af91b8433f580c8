#include "nlmech/peers/geodesy/simd_methods.hpp"
#include "nlmech/support/kernels/baseline.hpp"

namespace nlmech::peers::geodesy {

const SimdTable baseline_peers = simd_table<simd::Widest<simd::Baseline>>;

}  // namespace nlmech::peers::geodesy

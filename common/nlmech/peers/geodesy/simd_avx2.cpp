#include "nlmech/peers/geodesy/simd_methods.hpp"
#include "nlmech/support/kernels/avx2.hpp"

namespace nlmech::peers::geodesy {

const SimdTable avx2_peers = simd_table<simd::Widest<simd::Avx2>>;

}  // namespace nlmech::peers::geodesy

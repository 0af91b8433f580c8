#include "nlmech/peers/geodesy/simd_methods.hpp"
#include "nlmech/support/kernels/avx512.hpp"

namespace nlmech::peers::geodesy {

const SimdTable avx512_peers = simd_table<simd::Widest<simd::Avx512>>;

}  // namespace nlmech::peers::geodesy

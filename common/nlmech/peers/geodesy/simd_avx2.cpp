#include "nlmech/geodesy/kernels/lanes_avx2.hpp"
#include "nlmech/peers/geodesy/simd_methods.hpp"

namespace nlmech::peers::geodesy {

const SimdTable avx2_peers = simd_table<nlmech::geodesy::kernels::Quad>;

}  // namespace nlmech::peers::geodesy

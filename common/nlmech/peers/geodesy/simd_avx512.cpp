#include "nlmech/geodesy/kernels/lanes_avx512.hpp"
#include "nlmech/peers/geodesy/simd_methods.hpp"

namespace nlmech::peers::geodesy {

const SimdTable avx512_peers = simd_table<nlmech::geodesy::kernels::Octet>;

}  // namespace nlmech::peers::geodesy

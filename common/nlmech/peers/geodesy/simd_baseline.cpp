#include "nlmech/geodesy/kernels/lanes.hpp"
#include "nlmech/peers/geodesy/simd_methods.hpp"

namespace nlmech::peers::geodesy {

const SimdTable baseline_peers =
    simd_table<nlmech::geodesy::kernels::Pair<nlmech::geodesy::kernels::Baseline>>;

}  // namespace nlmech::peers::geodesy

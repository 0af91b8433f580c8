#include "nlmech/orbit/kernels/lanes.hpp"
#include "nlmech/orbit/kernels/taylor_kernel.hpp"

namespace nlmech::orbit::kernels {

const Kernel baseline_kernel = kernel<Baseline>;

}  // namespace nlmech::orbit::kernels

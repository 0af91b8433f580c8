#include "nlmech/orbit/kernels/lanes_avx2.hpp"
#include "nlmech/orbit/kernels/taylor_kernel.hpp"

namespace nlmech::orbit::kernels {

const Kernel avx2_kernel = kernel<Avx2>;

}  // namespace nlmech::orbit::kernels

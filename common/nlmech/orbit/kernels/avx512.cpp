#include "nlmech/orbit/kernels/lanes_avx512.hpp"
#include "nlmech/orbit/kernels/taylor_kernel.hpp"

namespace nlmech::orbit::kernels {

const Kernel avx512_kernel = kernel<Avx512>;

}  // namespace nlmech::orbit::kernels

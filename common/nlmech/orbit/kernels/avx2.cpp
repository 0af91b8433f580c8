#include "nlmech/support/kernels/avx2.hpp"
#include "nlmech/orbit/kernels/taylor_kernel.hpp"

namespace nlmech::orbit::kernels {

const Kernel avx2_kernel = kernel<simd::Avx2>;

}  // namespace nlmech::orbit::kernels

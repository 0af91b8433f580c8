#include "nlmech/support/kernels/avx2.hpp"
#include "nlmech/geodesy/kernels/reverse_kernel.hpp"

namespace nlmech::geodesy::kernels {

const Kernel avx2_kernel = kernel<simd::Avx2>;

}  // namespace nlmech::geodesy::kernels

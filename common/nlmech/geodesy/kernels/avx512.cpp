#include "nlmech/support/kernels/avx512.hpp"
#include "nlmech/geodesy/kernels/reverse_kernel.hpp"

namespace nlmech::geodesy::kernels {

const Kernel avx512_kernel = kernel<simd::Avx512>;

}  // namespace nlmech::geodesy::kernels

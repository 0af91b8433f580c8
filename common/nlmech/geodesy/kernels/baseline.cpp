#include "nlmech/support/kernels/baseline.hpp"
#include "nlmech/geodesy/kernels/reverse_kernel.hpp"

namespace nlmech::geodesy::kernels {

const Kernel baseline_kernel = kernel<simd::Baseline>;

}  // namespace nlmech::geodesy::kernels

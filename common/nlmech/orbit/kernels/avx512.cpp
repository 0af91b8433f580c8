#include "nlmech/support/kernels/avx512.hpp"
#include "nlmech/orbit/kernels/ensemble_kernel.hpp"
#include "nlmech/orbit/kernels/taylor_kernel.hpp"

namespace nlmech::orbit::kernels {

const Kernel avx512_kernel = kernel<simd::Avx512>;
const EnsembleKernel avx512_ensemble = ensemble_kernel<simd::Avx512>;

}  // namespace nlmech::orbit::kernels

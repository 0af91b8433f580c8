#include "nlmech/support/kernels/avx2.hpp"
#include "nlmech/orbit/kernels/ensemble_kernel.hpp"
#include "nlmech/orbit/kernels/taylor_kernel.hpp"

namespace nlmech::orbit::kernels {

const Kernel avx2_kernel = kernel<simd::Avx2>;
const EnsembleKernel avx2_ensemble = ensemble_kernel<simd::Avx2>;

}  // namespace nlmech::orbit::kernels

#include "nlmech/support/kernels/baseline.hpp"
#include "nlmech/orbit/kernels/ensemble_kernel.hpp"
#include "nlmech/orbit/kernels/taylor_kernel.hpp"

namespace nlmech::orbit::kernels {

const Kernel baseline_kernel = kernel<simd::Baseline>;
const EnsembleKernel baseline_ensemble = ensemble_kernel<simd::Baseline>;

}  // namespace nlmech::orbit::kernels

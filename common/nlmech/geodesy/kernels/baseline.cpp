#include "nlmech/geodesy/kernels/lanes.hpp"
#include "nlmech/geodesy/kernels/reverse_kernel.hpp"

namespace nlmech::geodesy::kernels {

const Kernel baseline_kernel = kernel<Baseline, Pair<Baseline>>;

}  // namespace nlmech::geodesy::kernels

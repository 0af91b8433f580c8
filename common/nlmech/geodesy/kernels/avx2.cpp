#include "nlmech/geodesy/kernels/lanes_avx2.hpp"
#include "nlmech/geodesy/kernels/reverse_kernel.hpp"

namespace nlmech::geodesy::kernels {

const Kernel avx2_kernel = kernel<Avx2, Quad>;

}  // namespace nlmech::geodesy::kernels

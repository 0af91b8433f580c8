#include "nlmech/geodesy/kernels/lanes_avx512.hpp"
#include "nlmech/geodesy/kernels/reverse_kernel.hpp"

namespace nlmech::geodesy::kernels {

const Kernel avx512_kernel = kernel<Avx512, Octet>;

}  // namespace nlmech::geodesy::kernels

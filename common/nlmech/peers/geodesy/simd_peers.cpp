#include "nlmech/peers/geodesy/simd_peers.hpp"

#include <stdexcept>
#include <string>

namespace nlmech::peers::geodesy {

std::string_view to_string(SimdMethod method) noexcept {
  switch (method) {
    case SimdMethod::two_arctangents: return "two arctangents";
    case SimdMethod::bowring1976_1: return "Bowring 1976, 1 iteration";
    case SimdMethod::bowring1976_2: return "Bowring 1976, 2 iterations";
    case SimdMethod::bowring1985_1: return "Bowring 1985, 1 iteration";
    case SimdMethod::bowring1985_2: return "Bowring 1985, 2 iterations";
    case SimdMethod::fukushima2006_1: return "Fukushima 2006, 1 iteration";
    case SimdMethod::fukushima2006_2: return "Fukushima 2006, 2 iterations";
  }
  return "unknown";
}

void run(SimdMethod method, InstructionSet set, const nlmech::geodesy::Ellipsoid& e,
         std::span<const double> x, std::span<const double> y, std::span<const double> z,
         std::span<double> latitude, std::span<double> longitude, std::span<double> height) {
  const std::size_t size = x.size();
  const bool equal = y.size() == size && z.size() == size && latitude.size() == size &&
                     longitude.size() == size && height.size() == size;
  if (!equal || size % 8 != 0) {
    throw std::invalid_argument("peers::geodesy::run: sizes must be equal and a multiple of 8, x has " +
                                std::to_string(size));
  }
  require_available(set);
  const SimdTable* table = &baseline_peers;
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) table = &avx2_peers;
  if (set == InstructionSet::avx512) table = &avx512_peers;
#endif
  const UnitEllipsoid k{e.a(), 1 / e.a(), 1 - e.f(), e.e2(), e.e2() / (1 - e.e2())};
  const SimdArrays arrays{x.data(),         y.data(),      z.data(), latitude.data(),
                          longitude.data(), height.data(), size};
  (*table)[static_cast<std::size_t>(method)](k, arrays);
}

}  // namespace nlmech::peers::geodesy

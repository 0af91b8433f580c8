#include <stdexcept>

#include "nlmech/peers/geodesy/geographiclib.hpp"

namespace nlmech::peers::geodesy {
namespace {
[[noreturn]] void refuse() { throw std::logic_error("this build has no GeographicLib (NLMECH_PEERS)"); }
}  // namespace

bool geographiclib_available() noexcept { return false; }

nlmech::geodesy::Geodetic geographiclib_reverse(const nlmech::geodesy::Ellipsoid&,
                                                const nlmech::geodesy::Cartesian&) {
  refuse();
}

void geographiclib_reverse_degrees(const nlmech::geodesy::Ellipsoid&, std::span<const double>,
                                   std::span<const double>, std::span<const double>, std::span<double>,
                                   std::span<double>, std::span<double>) {
  refuse();
}

}  // namespace nlmech::peers::geodesy

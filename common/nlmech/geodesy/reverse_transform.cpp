#include "nlmech/geodesy/reverse_transform.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "nlmech/geodesy/tangent_fit.hpp"

namespace nlmech::geodesy {
namespace {

const kernels::Kernel& kernel_of(InstructionSet set) {
  require_available(set);
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return kernels::avx2_kernel;
  if (set == InstructionSet::avx512) return kernels::avx512_kernel;
#endif
  return kernels::baseline_kernel;
}

/// Smallest number of Newton corrections that brings the error below rounding; -1 if two are not enough. Each
/// squares the error, with a factor of about 2 e^2 q below 1.
int corrections_for(const TangentFit& fit) {
  if (fit.error < 5e-17) return 0;
  if (fit.error < 3e-9) return 1;
  return fit.error < 5e-5 ? 2 : -1;
}

}  // namespace

namespace kernels {

void redo(const ClosestPoint& exact, double x, double y, double z, const Arrays& out, std::size_t index,
          Tally& tally) noexcept {
  const GeodeticPoint p = exact({x, y, z});
  out.latitude[index] = p.position.latitude;
  out.longitude[index] = p.position.longitude;
  out.height[index] = p.position.height;
  ++tally.fallbacks;
  if (p.outcome == Outcome::success) return;
  if (tally.non_finite++ == 0) tally.first_non_finite = index;
}

}  // namespace kernels

Status BatchReport::status() const {
  if (non_finite == 0) return {};
  return Status::failure(Outcome::non_finite,
                         "ReverseTransform: " + std::to_string(non_finite) + " of " + std::to_string(points) +
                             " points have a NaN or infinite coordinate, or overflow, first at index " +
                             std::to_string(first_non_finite) + "; remove these points");
}

ReverseTransform::ReverseTransform(const Ellipsoid& ellipsoid, InstructionSet set)
    : exact_(ellipsoid), set_(set) {
  const kernels::Kernel& kernel = kernel_of(set);
  // Start with an empty range of validity: without a fit every point is computed by exact_.
  constants_.a = ellipsoid.a();
  constants_.e2 = ellipsoid.e2();
  constants_.nearest2 = std::numeric_limits<double>::infinity();
  constants_.farthest2 = 0;

  // The squares of all distances of the range must be representable.
  const bool default_size = ellipsoid.a() > 1e-120 && ellipsoid.a() < 1e120;
  if (default_size && std::abs(ellipsoid.f()) <= 0.25) {
    const TangentFit fit = fit_tangent(ellipsoid);
    corrections_ = corrections_for(fit);
    if (corrections_ >= 0) {
      const double nearest = ellipsoid.a() / fit.q_max;
      constants_.nearest2 = nearest * nearest;
      constants_.farthest2 = 1e300;
      for (std::size_t i = 0; i < TangentFit::q_terms; ++i) {
        for (std::size_t j = 0; j < TangentFit::m_terms; ++j)
          constants_.tangent[i][j] = fit.coefficient[i][j];
      }
    }
  }
  const int form = corrections_ < 0 ? 0 : corrections_;
  one_ = kernel.point[form];
  many_ = kernel.batch[form];
}

BatchReport ReverseTransform::operator()(std::span<const double> x, std::span<const double> y,
                                         std::span<const double> z, std::span<double> latitude,
                                         std::span<double> longitude, std::span<double> height) const {
  const std::size_t size = x.size();
  if (y.size() != size || z.size() != size || latitude.size() != size || longitude.size() != size ||
      height.size() != size) {
    std::string sizes;
    for (std::size_t n : {size, y.size(), z.size(), latitude.size(), longitude.size(), height.size()}) {
      sizes += ' ';
      sizes += std::to_string(n);
    }
    throw std::invalid_argument(
        "ReverseTransform: x, y, z, latitude, longitude, height must be of one size, are" + sizes);
  }
  const kernels::Tally tally =
      many_(constants_, exact_,
            {x.data(), y.data(), z.data(), latitude.data(), longitude.data(), height.data(), size});
  return {size, tally.fallbacks, tally.non_finite, tally.first_non_finite};
}

}  // namespace nlmech::geodesy

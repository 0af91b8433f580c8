/// @file
/// Interface of the kernels of all instruction sets for ReverseTransform. Internal.
#pragma once

#include <cstddef>

namespace nlmech::geodesy {
class ClosestPoint;
}

namespace nlmech::geodesy::kernels {

/// Constants of the ellipsoid for a kernel.
struct Constants {
  static constexpr int q_terms = 5, m_terms = 6;
  double a = 0, e2 = 0;
  /// Squares of the limits of the distance from the centre in which the kernel is valid.
  double nearest2 = 0, farthest2 = 0;
  double tangent[q_terms][m_terms] = {};  ///< F(q, m) = sum over i, j of tangent[i][j] q^i m^j
};

/// Result for one point; if `valid` is false, ClosestPoint must compute it.
struct Position {
  double latitude, longitude, height;
  bool valid;
};

struct Arrays {
  const double *x, *y, *z;
  double *latitude, *longitude, *height;
  std::size_t size;
};

/// Numbers of points of a batch computed by ClosestPoint, and of points without a finite result.
struct Tally {
  std::size_t fallbacks = 0, non_finite = 0, first_non_finite = 0;
};

/// Computes one point of a batch by ClosestPoint. Compiled for the baseline.
void redo(const ClosestPoint& exact, double x, double y, double z, const Arrays& out, std::size_t index,
          Tally& tally) noexcept;

using OnePoint = Position (*)(const Constants&, double x, double y, double z) noexcept;
using ManyPoints = Tally (*)(const Constants&, const ClosestPoint&, const Arrays&) noexcept;

/// One kernel, in three forms: with 0, 1 or 2 Newton corrections after the economised series.
struct Kernel {
  OnePoint point[3];
  ManyPoints batch[3];
};

extern const Kernel baseline_kernel;
extern const Kernel avx2_kernel;
extern const Kernel avx512_kernel;

}  // namespace nlmech::geodesy::kernels

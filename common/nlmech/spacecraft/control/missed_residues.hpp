/// @file
/// What an inversion of Laplace transforms leaves out: residues beyond the frequencies at which it looks.
#pragma once

#include <cmath>
#include <complex>
#include <functional>

namespace nlmech::spacecraft {

/// What was found outside a contour.
struct MissedResidues {
  double amplitude = 0;  ///< of the oscillations that are left out, at their beginning; NaN if F was not
                         ///< finite somewhere
  std::complex<double> near{};  ///< about where the largest of them lies, or where F is not finite
};

/// The inner boundary of a sector.
struct SectorBoundary {
  double centre = 0;    ///< of the sector, on the real axis
  double radius = 1;    ///< at the angle 0, positive
  bool talbot = false;  ///< the contour of Talbot, radius phi/sin phi, or a circle?

  /// Distance from the centre at an angle of 0 to 3 pi/4.
  [[nodiscard]] double at(double angle) const {
    return talbot && angle > 0 ? radius * angle / std::sin(angle) : radius;
  }
  /// Its derivative by the angle.
  [[nodiscard]] double slope(double angle) const {
    const double s = std::sin(angle);
    return talbot && angle > 0 ? radius * (s - angle * std::cos(angle)) / (s * s) : 0;
  }
};

/// Sums of the residues of F in the sector of 0 to 135 degrees beyond a boundary: (1/2 pi i) times the
/// integrals of F, and of F s, along the boundaries of 17 pieces of the sector, each four times as large as
/// the one before, by Gauss's rule.
///
/// A simple pole between the rays of 0 and 135 degrees shows with its residue, wherever it lies up to 4^17 =
/// 1.7e10 times the boundary; a double one, whose residue can be 0, by the integral of F s as far as |s| t =
/// 1000, and beyond with a part of it only. Where F is analytic there, quadrature leaves less than 1e-12 of
/// the largest |F s|. Some 1100 values of F.
/// @param time at which f is wanted, by which the amplitude of a double pole grows
[[nodiscard]] MissedResidues missed_residues(
    const std::function<std::complex<double>(std::complex<double>)>& transform, double time,
    const SectorBoundary& boundary);

}  // namespace nlmech::spacecraft

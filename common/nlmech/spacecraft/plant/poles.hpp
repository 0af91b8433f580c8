/// @file
/// Poles and zeros of the open-loop transfer functions.
///
/// The poles other than the double pole at s = 0, and the zeros of theta/u, are eigenvalues of symmetric
/// problems and lie on the imaginary axis. They are bracketed by sign changes, and the argument principle in
/// z = s^2 detects missed ones. Zeros of y(x)/u are found in the same way; if the count shows that some are
/// off the axis, the search covers the plane of z.
#pragma once

#include <vector>

#include "nlmech/spacecraft/plant/plant.hpp"
#include "nlmech/spacecraft/plant/roots.hpp"

namespace nlmech::spacecraft {

/// Poles or zeros on the imaginary axis.
struct Frequencies {
  std::vector<double> omega;  ///< positive, rising, rad/s
  int counted = 0;            ///< count by the argument principle up to midway between the last and the next
  Status status;              ///< success: as many were found as counted
};

/// The first @p count poles omega_n > 0 of both transfer functions, s = +-j omega_n; relative accuracy 1e-12
/// (tests/spacecraft).
/// @throws std::invalid_argument if count is not positive
[[nodiscard]] Frequencies poles(const Plant& plant, int count);

/// The first @p count zeros omega > 0 of theta/u: resonances with the hub locked (anti-resonances of the
/// hub); relative accuracy 1e-12.
/// @throws std::invalid_argument if count is not positive
[[nodiscard]] Frequencies hub_zeros(const Plant& plant, int count);

/// Zeros of y(x)/u.
struct Zeros {
  std::vector<Complex> s;  ///< those with Im s >= 0, by modulus, then by real part
  int counted = 0;         ///< count of zeros in z = s^2 by the argument principle
  Status status;           ///< success: as many were found as counted
};

/// All zeros of y(x)/u with |Re s^2| and |Im s^2| up to @p omega^2; the square is enlarged slightly if a zero
/// lies on its boundary. If s is a zero, so are -s and conj(s): a zero on the imaginary axis is listed once,
/// a real zero with both signs, any other with its mirror image -conj(s).
/// @param x place of the deflection, above 0 up to L, ft, where y is not always 0, as at a pinned tip
/// @throws std::invalid_argument if x or omega is out of range
[[nodiscard]] Zeros deflection_zeros(const Plant& plant, double x, double omega);

}  // namespace nlmech::spacecraft

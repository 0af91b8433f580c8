/// @file
/// Poles and zeros of the open-loop transfer functions.
///
/// The poles but the double one at s = 0, and the zeros of theta/u, are those of symmetric problems and lie
/// on the imaginary axis. They are bracketed there by sign changes, and the argument principle in z = s^2
/// says whether any was missed. Zeros of y(x)/u are looked for in the same way, and where the count says that
/// some are not on the axis, in the whole plane of z.
#pragma once

#include <vector>

#include "nlmech/spacecraft/plant/plant.hpp"
#include "nlmech/spacecraft/plant/roots.hpp"

namespace nlmech::spacecraft {

/// Points of the imaginary axis.
struct Frequencies {
  std::vector<double> omega;  ///< positive, rising, rad/s
  int counted = 0;            ///< by the argument principle up to the middle between the last and the next
  Status status;              ///< success: as many were found as counted
};

/// The first @p count poles omega_n > 0 of both transfer functions, s = +-j omega_n; right to 1e-12 of
/// themselves (tests/spacecraft).
/// @throws std::invalid_argument if count is not positive
[[nodiscard]] Frequencies poles(const Plant& plant, int count);

/// The first @p count zeros omega > 0 of theta/u: the resonances with the hub locked (anti-resonances of the
/// hub), to 1e-12 of themselves.
/// @throws std::invalid_argument if count is not positive
[[nodiscard]] Frequencies hub_zeros(const Plant& plant, int count);

/// Zeros of y(x)/u.
struct Zeros {
  std::vector<Complex> s;  ///< those with Im s >= 0, by modulus, then by real part
  int counted = 0;         ///< by the argument principle, of z = s^2
  Status status;           ///< success: as many were found as counted
};

/// All zeros of y(x)/u with |Re s^2| and |Im s^2| up to @p omega^2; the side of that square is made a little
/// longer if it meets a zero. With s also -s and the conjugate of s are zeros: one on the imaginary axis is
/// listed once, a real one with both signs, any other with its mirror image -conj(s).
/// @param x above 0 up to L: y(0) is always 0
/// @throws std::invalid_argument if x or omega is out of range
[[nodiscard]] Zeros deflection_zeros(const Plant& plant, double x, double omega);

}  // namespace nlmech::spacecraft

/// @file
/// The four radial functions of Eq. 4.8 and their time derivatives.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string_view>

namespace nlmech::collocation {

/// Radial function phi(r) of the distance r from its centre, with a shape parameter c > 0 (Eq. 4.8).
enum class Kernel {
  gaussian,             ///< exp(-(c r)^2)
  inverse_quadratic,    ///< 1/(1 + (c r)^2)
  multiquadric,         ///< sqrt(1 + (c r)^2)
  inverse_multiquadric  ///< 1/sqrt(1 + (c r)^2)
};

/// Value phi at r = t - t_k.
/// @param c shape, 1/time
/// @param r time since the source t_k, of either sign
///
/// Accuracy: 4 units in the last place in double, times 1 + (c r)^2 for the Gaussian.
template <class T>
[[nodiscard]] T phi(Kernel kernel, const T& c, const T& r) {
  using std::exp, std::sqrt;
  const T u = c * r, q = 1 + u * u;
  switch (kernel) {
    case Kernel::gaussian: return exp(-u * u);
    case Kernel::inverse_quadratic: return 1 / q;
    case Kernel::multiquadric: return sqrt(q);
    case Kernel::inverse_multiquadric: return 1 / sqrt(q);
  }
  throw std::invalid_argument("phi: no such kernel");
}

/// Derivative d phi/dt at r = t - t_k; 1/time.
/// @param c     shape, 1/time
/// @param r     time since the source t_k, of either sign
/// @param value phi(kernel, c, r); used for the Gaussian only
///
/// Accuracy: 8 units in the last place in double, times 1 + (c r)^2 for the Gaussian.
template <class T>
[[nodiscard]] T phi_dot(Kernel kernel, const T& c, const T& r, const T& value) {
  using std::sqrt;
  const T u = c * r, q = 1 + u * u;
  switch (kernel) {
    case Kernel::gaussian: return -2 * c * u * value;
    case Kernel::inverse_quadratic: return -2 * c * u / (q * q);
    case Kernel::multiquadric: return c * u / sqrt(q);
    case Kernel::inverse_multiquadric: return -c * u / (q * sqrt(q));
  }
  throw std::invalid_argument("phi_dot: no such kernel");
}

/// phi_dot() that evaluates phi itself.
template <class T>
[[nodiscard]] T phi_dot(Kernel kernel, const T& c, const T& r) {
  return phi_dot(kernel, c, r, kernel == Kernel::gaussian ? phi(kernel, c, r) : T(0));
}

/// As on a command line: "inverse-multiquadric".
[[nodiscard]] std::string_view to_string(Kernel kernel);

}  // namespace nlmech::collocation

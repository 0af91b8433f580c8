/// @file
/// Natural frequencies with Timoshenko beams as appendages: shear deformation and rotary inertia.
///
/// At s = j omega the inertial deflection w, the rotation psi of the section, the moment M and the shear V
/// obey
///
///     w' = psi + V/(kappa G A),  psi' = M/EI,  M' = -V - omega^2 rho_I psi,  V' = -omega^2 rho w,
///
/// w(0) = r theta, psi(0) = theta, M(L) = omega^2 I_tip psi(L), V(L) = omega^2 m w(L), and without a torque
/// omega^2 I_hub theta + 2 (r V(0) + M(0)) = 0.
#pragma once

#include <vector>

#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::spacecraft {

/// Parameters of a Timoshenko beam in addition to Parameters.
struct ShearBeam {
  double shear_stiffness;  ///< kappa G A, lb; positive
  double rotary_inertia;   ///< rho I per length, slug ft; at least 0
};

/// Beam of a solid cross section, with A = mass per length/density, rho I = density times I, G = E/(2 (1 +
/// nu)).
/// @param parameters E, second moment I, mass per length
/// @param density slug/ft^3; positive
/// @param poisson Poisson's ratio nu, above -1, at most 1/2
/// @param shear_coefficient kappa, 5/6 for a rectangle; positive
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] ShearBeam solid_section(const Parameters& parameters, double density, double poisson,
                                      double shear_coefficient);

/// The first @p count natural frequencies omega_n > 0 of a hub with two Timoshenko appendages, rad/s: sign
/// changes of the determinant of the boundary conditions above.
///
/// Tests compare them with a transition matrix (1e-9) and, for a stiff section, with Euler-Bernoulli theory
/// (1e-12).
/// @param highest upper end of the search, rad/s; if fewer than @p count lie below it, fewer are returned
/// @throws std::invalid_argument as require_physical() and require_cantilever(), or naming the value that is
/// out of range
[[nodiscard]] std::vector<double> timoshenko_frequencies(const Parameters& parameters, const ShearBeam& beam,
                                                         int count, double highest);

}  // namespace nlmech::spacecraft

/// @file
/// Timoshenko's beam as second model of the appendage: shear deformation and rotary inertia.
///
/// States of the motion for theta = 1: inertial deflection w, rotation psi of the section, moment M, shear V;
///
///     w' = psi + V/(kappa G A),  psi' = M/EI,  M' = -V + s^2 rho_I psi,  V' = s^2 rho w,
///
/// w(0) = r, psi(0) = 1, M(L) = -s^2 I_tip psi(L), V(L) = -s^2 m w(L), and s^2 B = -(r V(0) + M(0)).
#pragma once

#include <vector>

#include "nlmech/spacecraft/plant/plant.hpp"

namespace nlmech::spacecraft {

/// What Timoshenko's beam has beyond Parameters.
struct ShearBeam {
  double shear_stiffness;  ///< kappa G A, lb; positive
  double rotary_inertia;   ///< rho I per length, slug ft; at least 0
};

/// Section of a solid material: from density and Poisson's ratio, with the second moment and the mass per
/// length of @p parameters: A = mass per length/density, rho I = density times I, G = E/(2 (1 + nu)).
/// @param parameters E, I, mass per length
/// @param density slug/ft^3; positive
/// @param poisson Poisson's ratio nu, above -1, at most 1/2
/// @param shear_coefficient kappa, 5/6 for a rectangle; positive
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] ShearBeam solid_section(const Parameters& parameters, double density, double poisson,
                                      double shear_coefficient);

/// Hub with two Timoshenko appendages.
///
/// Tests hold it to a transition matrix made by Taylor's series (1e-9, deflections 1e-8), and with a stiff
/// section to Euler and Bernoulli's (1e-12).
class TimoshenkoPlant {
 public:
  /// @throws std::invalid_argument as require_physical(), or naming the value of @p beam out of range
  TimoshenkoPlant(const Parameters& parameters, const ShearBeam& beam);

  /// What it was made of.
  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  /// The rest of what it was made of.
  [[nodiscard]] const ShearBeam& beam() const { return beam_; }

  /// theta/u and y(x)/u with y = w - (r + x) theta. Unlike Plant it divides by the determinant at once:
  /// digits are lost very near a frequency of the locked hub, and where both wave numbers coincide (a real s
  /// above the cut-off).
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Response response(Complex s, double x) const;
  /// B(s) of one appendage, slug ft^2.
  [[nodiscard]] Complex inertia(Complex s) const;
  /// sqrt(kappa G A/rho_I): above it the second kind of wave travels; infinite without rotary inertia.
  [[nodiscard]] double cutoff() const;
  /// The first @p count poles omega_n > 0, by sign changes of the denominator on the axis.
  /// @param highest search up to here at most, rad/s
  [[nodiscard]] std::vector<double> poles(int count, double highest) const;

 private:
  struct Solution;
  [[nodiscard]] Solution solve(Complex s, double x) const;
  Parameters parameters_;
  ShearBeam beam_;
};

}  // namespace nlmech::spacecraft

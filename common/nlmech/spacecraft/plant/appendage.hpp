/// @file
/// One appendage moved by its root: the exact solution of Eqs. 3.15-3.16 at any complex s, without truncation
/// and without overflow or cancellation, small s and large.
///
/// With w = y + (r + x) theta, sigma^4 = -beta = -s^2 rho/EI and theta = 1 the field equation is w'''' =
/// sigma^4 w with w(0) = r, w'(0) = 1, EI w''(L) = -s^2 I_tip w'(L), EI w'''(L) = s^2 m w(L). All results are
/// quotients with one denominator, the entire function D_0 of s^2 that vanishes where the hub-locked
/// appendage resonates: D_0 = f^2 + f' f'''/beta at L without tip (Eq. 3.37). Numerators and denominator are
/// kept apart, so that nothing is lost at such a resonance, and share a factor exp(-exponent), so that
/// nothing overflows.
#pragma once

#include <cstdint>

#include "nlmech/spacecraft/motion.hpp"
#include "nlmech/spacecraft/parameters.hpp"
#include "nlmech/spacecraft/plant/jet.hpp"

namespace nlmech::spacecraft {

/// How the appendage is evaluated.
enum class Evaluation : std::uint8_t {
  automatic,  ///< krylov for |beta|^(1/4) L < 2.5, waves above
  krylov,     ///< power series in beta, without cancellation at small s
  waves       ///< exponentials that decay from root and tip, without overflow at large s
};

/// Exact appendage, Euler and Bernoulli's beam. Immutable; every function may be called from many threads.
///
/// Accuracy (tests/spacecraft, against 110 digits, with and without tip): B(s), g_3(x) and the
/// transfer functions within 1e-14 max(1, |s G'/G|) of themselves on the imaginary axis for |s| from 1e-8 to
/// 1e8, for real s of both signs, and in the plane.
class Appendage {
 public:
  /// @throws std::invalid_argument as require_physical()
  explicit Appendage(const Parameters& parameters);

  /// What it was made of.
  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

  /// The motion for theta = 1 at @p s. Finite for every finite s with |s|^2 rho L^4/EI below 1e200, even on a
  /// hub-locked resonance, where its determinant is 0.
  [[nodiscard]] Motion<Complex> motion(Complex s, Evaluation evaluation = Evaluation::automatic) const;
  /// The same with derivatives by s (the common factor exp(-exponent) held fixed).
  [[nodiscard]] Motion<Jet> motion_with_slope(Complex s) const;
  /// The same at s = j omega, in real arithmetic: faster.
  [[nodiscard]] Motion<double> motion_at_frequency(double omega) const;

  /// B D_0, with B = (r S_0 - M_0)/(s^2 theta), slug ft^2: torque on the root by one appendage, divided by
  /// the angular acceleration. At s = 0 it is D_0 times the inertia of the appendage.
  template <class T>
  [[nodiscard]] T inertia(const Motion<T>& motion) const {
    return inertia_unit_ * motion.inertia;
  }
  /// g_3(x) D_0/s^2 with g_3 = y(x)/theta (Eq. 3.35), ft s^2. Divided by s^2, for g_3 ~ s^2 at small s.
  /// @param motion of this appendage
  /// @param x 0 to L, ft; not checked
  template <class T>
  [[nodiscard]] T deflection(const Motion<T>& motion, double x) const {
    return deflection_unit_ * relative_deflection(motion, ratios_, x / parameters_.length);
  }

  /// B(s), slug ft^2; infinite or very large on a hub-locked resonance.
  [[nodiscard]] Complex inertia(Complex s) const;
  /// g_3(x) = y(x)/theta, ft; infinite or very large on a hub-locked resonance.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Complex deflection(Complex s, double x) const;
  /// Slope y'(x)/theta (g_4 of Eq. 3.35), -; same poles.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Complex slope(Complex s, double x) const;
  /// Bending moment EI y''(x)/theta, lb ft; M_0 at x = 0.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Complex moment(Complex s, double x) const;
  /// Shear force EI y'''(x)/theta, lb; S_0 at x = 0.
  /// @throws std::invalid_argument if x is outside 0 to L
  [[nodiscard]] Complex shear(Complex s, double x) const;

  /// @throws std::invalid_argument naming x, if it is outside 0 to L
  void require_place(double x) const;
  /// beta L^4 = s^2 rho L^4/EI: s^2 times this.
  [[nodiscard]] double beta_unit() const { return beta_unit_; }
  /// r/L, m/(rho L), I_tip/(rho L^3).
  [[nodiscard]] const Ratios& ratios() const { return ratios_; }

 private:
  Parameters parameters_;
  Ratios ratios_;
  double beta_unit_;        ///< rho L^4/EI, s^2
  double inertia_unit_;     ///< rho L^3
  double deflection_unit_;  ///< L rho L^4/EI
};

}  // namespace nlmech::spacecraft

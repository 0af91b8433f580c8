/// @file
/// Generalised state space solution in the closed form of the source (Elgohary 2015, Eqs. 3.24-3.42),
/// corrected, for any complex number type. In double precision it loses digits at small and large s and
/// overflows; it serves for comparison with class Appendage. Options select the formulas as printed.
#pragma once

#include <array>
#include <cmath>
#include <complex>

#include "nlmech/spacecraft/parameters.hpp"

namespace nlmech::spacecraft {

/// Formulas taken as printed; the default is the corrected solution.
struct AsPrinted {
  bool cosine = false;       ///< cos(sigma x) in place of f, with the constants of Eq. 3.33 (Eqs. 3.32-3.34);
                             ///< correct: f is the mean of cos and cosh
  bool literal_x = false;    ///< (r + x) g_2(x) - g_1(x) in Eqs. 3.38-3.42 at x; correct: at L
  bool minus_in_z1 = false;  ///< minus before z_6 in the first row of Eq. 3.28; correct: plus
};

/// f and its first three derivatives with respect to x.
template <class C>
struct CharacteristicFunction {
  C f;   ///< (cos(sigma x) + cosh(sigma x))/2, sigma^4 = -beta: Eq. 3.30
  C f1;  ///< f'
  C f2;  ///< f''
  C f3;  ///< f'''
};

/// Closed-form solution at one s.
template <class C>
class GssSolution {
 public:
  /// Solves the tip conditions for z_5(0) and z_6(0), theta = 1.
  /// @param parameters physical (not checked)
  /// @param s not 0
  GssSolution(const Parameters& parameters, const C& s, const AsPrinted& printed = {})
      : parameters_(parameters), printed_(printed), square_(s * s) {
    using std::sqrt;
    const C ei = C(parameters.youngs_modulus) * parameters.second_moment;
    beta_ = square_ * parameters.mass_per_length / ei;
    // Eq. 3.31. f is the same for all four roots of -beta; the cosine is not.
    sigma_ = sqrt(C(C(0, 1) * sqrt(beta_)));
    const double l = parameters.length, reach = parameters.hub_radius + l;
    const CharacteristicFunction<C> k = characteristic(l);
    const std::array<C, 6> forced = forced_part(l);
    C a11 = k.f, a12 = -k.f3 / beta_, a21 = k.f1, a22 = k.f, e1 = -forced[4], e2 = -forced[5];
    if (parameters.has_tip()) {
      const C alpha = square_ * parameters.tip_inertia / ei, gamma = square_ * parameters.tip_mass / ei;
      a11 -= alpha * k.f3 / beta_;
      a12 -= alpha * k.f2 / beta_;
      a21 += gamma * k.f2 / beta_;
      a22 += gamma * k.f1 / beta_;
      e1 -= alpha * (forced[3] + 1.);
      e2 += gamma * (forced[2] + reach);
    }
    const C determinant = a11 * a22 - a12 * a21;
    z5_ = (e1 * a22 - a12 * e2) / determinant;
    z6_ = (a11 * e2 - e1 * a21) / determinant;
  }

  /// g_1 to g_6 at x: the state of Eq. 3.34 for theta = 1.
  [[nodiscard]] std::array<C, 6> state(double x) const {
    const CharacteristicFunction<C> k = characteristic(x);
    std::array<C, 6> z = forced_part(x);
    const C double_integral = beta_ * x + k.f3;
    z[0] += (1. - k.f) * z5_ / beta_ +
            (printed_.minus_in_z1 ? C(-double_integral) : double_integral) * z6_ / (beta_ * beta_);
    z[1] += (1. - k.f) * z6_ / beta_ - k.f1 * z5_ / beta_;
    z[2] -= (k.f2 * z5_ + k.f1 * z6_) / beta_;
    z[3] -= (k.f3 * z5_ + k.f2 * z6_) / beta_;
    z[4] += k.f * z5_ - k.f3 * z6_ / beta_;
    z[5] += k.f1 * z5_ + k.f * z6_;
    return z;
  }

  /// u/(s^2 theta) = J + 2 m (r + L) g_3(L) + 2 I_tip g_4(L) + 2 rho ((r + L) g_2(L) - g_1(L)) (Eq. 3.42).
  /// @param x place of the deflection, ft; used by the equation as printed only
  [[nodiscard]] C effective_inertia(double x) const {
    const Parameters& p = parameters_;
    const std::array<C, 6> end = state(p.length);
    const double at = printed_.literal_x ? x : p.length;
    const std::array<C, 6> there = state(at);
    C sum = p.total_inertia() + 2. * p.mass_per_length * ((p.hub_radius + at) * there[1] - there[0]);
    if (p.has_tip()) {
      sum += 2. * p.tip_mass * (p.hub_radius + p.length) * end[2];
      sum += 2. * p.tip_inertia * end[3];
    }
    return sum;
  }

  /// theta/u.
  [[nodiscard]] C theta(double x) const { return 1. / (square_ * effective_inertia(x)); }
  /// y(x)/u.
  [[nodiscard]] C deflection(double x) const { return state(x)[2] * theta(x); }

 private:
  [[nodiscard]] CharacteristicFunction<C> characteristic(double x) const {
    using std::cos;
    using std::cosh;
    using std::sin;
    using std::sinh;
    const C a = sigma_ * x, c = cos(a), s = sin(a), square = sigma_ * sigma_;
    if (printed_.cosine) return {c, -sigma_ * s, -square * c, square * sigma_ * s};
    const C ch = cosh(a), sh = sinh(a);
    return {(c + ch) / 2., sigma_ * (sh - s) / 2., square * (ch - c) / 2., square * sigma_ * (s + sh) / 2.};
  }
  /// I_1 to I_6 of Eq. 3.33 by f.
  [[nodiscard]] std::array<C, 6> forced_part(double x) const {
    const CharacteristicFunction<C> k = characteristic(x);
    const double r = parameters_.hub_radius;
    std::array<C, 6> z = {-(r * k.f2 + k.f1) / beta_ - r * x * x / 2 - x * x * x / 6,
                          -(r * k.f3 + k.f2) / beta_ - r * x - x * x / 2,
                          r * k.f - k.f3 / beta_ - r - x,
                          r * k.f1 + k.f - 1.,
                          r * k.f2 + k.f1,
                          r * k.f3 + k.f2};
    if (printed_.cosine) {
      // f'' and f''' vanish at 0; for the cosine, terms with its derivatives at 0 remain.
      const C square = sigma_ * sigma_;
      z[0] -= square * (r + x) / beta_;
      z[1] += 1. / square;
      z[4] += square * (r + x);
      z[5] += square;
    }
    return z;
  }

  Parameters parameters_;
  AsPrinted printed_;
  C square_, beta_, sigma_, z5_, z6_;
};

}  // namespace nlmech::spacecraft

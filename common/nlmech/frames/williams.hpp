/// @file
/// Williams' equation: load on a shallow toggle of two members as a function of the drop of the apex.
#pragma once

#include "nlmech/frames/stability_functions.hpp"
#include "nlmech/program/value_of.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// Two equal members with clamped bases and a rigid, symmetric apex (Williams 1964 as given by Elgohary 2015,
/// Eqs 2.17-2.21, with rho = P l^2/(pi^2 EI), P compression, and a minus before 3 AE sin(beta)/(5 l^2)
/// in 2.21).
///
///     W = 2 (F + P sin beta)             P = (EA/l) (delta sin beta - 0.6 delta^2/l)
///     F = 6 EI d_5 delta/l^3             6 d_5 = g_a(n) + n,  n = -P l^2/EI
///
/// The last line replaces the chain d_1 ... d_5 of Eq. 2.20 (a test compares them to 45 digits); it has no
/// singularity at P = 0 and holds in tension. Of the factor 0.6 in 0.6 delta^2/l, 0.5 is the rotation of the
/// chord and 0.1 the antisymmetric bowing at P = 0. Defaults are those of Table 2.1 (inch, pound) for the
/// first case.
struct Williams {
  double height = 0.32;   ///< of the apex over the bases, l sin beta; positive
  double length = 12.94;  ///< l of a member; above the height
  double ea = 1.885e6;    ///< EA of a member, a force
  double ei = 9.27e3;     ///< EI of a member, force times length squared

  /// Compression P of a member (2.18).
  template <class T>
  [[nodiscard]] T compression(const T& delta) const {
    return ea / length * (delta * (height / length) - 0.6 * delta * delta / length);
  }

  /// Load W in equilibrium with the apex @p delta below its position at rest.
  template <class T>
  [[nodiscard]] T load(const T& delta) const {
    const T p = compression<T>(delta), n = -p * (length * length / ei);
    const T six_d5 = stability_functions<T>(n).antisymmetric.value + n;
    return 2 * (ei / (length * length * length) * six_d5 * delta + p * (height / length));
  }

  /// dW/ddelta; zero at limit points.
  template <class T>
  [[nodiscard]] T stiffness(const T& delta) const {
    const T n = -compression<T>(delta) * (length * length / ei);
    const T slope = ea / length * (height / length - 1.2 * delta / length);  // dP/ddelta
    const StabilityFunction<T> g = stability_functions<T>(n).antisymmetric;
    const T n_slope = -slope * (length * length / ei);
    return 2 * (ei / (length * length * length) * (g.value + n + (g.slope + 1) * n_slope * delta) +
                slope * (height / length));
  }

  /// `wrong_branch` where the compression is at or past the pole of d_5, `non_finite`, or success. Between
  /// the clamped buckling load and that pole the equation holds, though the member would buckle.
  [[nodiscard]] Outcome outcome(double delta) const {
    const double n = -compression(delta) * (length * length / ei);
    if (!(n > antisymmetric_pole))
      return n <= antisymmetric_pole ? Outcome::wrong_branch : Outcome::non_finite;
    return Outcome::success;
  }
};

}  // namespace nlmech::frames

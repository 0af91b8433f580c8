/// @file
/// Loads on a toggle in 50 digits by the textbook's stability functions, with the numbers of Table 2.1.
#pragma once

#include "tests/frames/oracle.hpp"

namespace nlmech::chapters::oracle {

using frames::oracle::Real;

/// Load W, pounds, of a toggle of a given height at a deflection, both in inches.
using Load = Real (*)(double height, const Real& deflection);

inline constexpr double length = 12.94, ea = 1.885e6, ei = 9.27e3;

/// Eqs 2.17 to 2.19, with 6 d_5 = 2 (s + s c) + n.
[[nodiscard]] inline Real williams_load(double height, const Real& deflection) {
  const Real l = length, sine = height / l;
  const Real p = ea / l * (deflection * sine - 3 * deflection * deflection / (5 * l));
  const Real n = -p * l * l / ei;
  const frames::oracle::Textbook<Real> t = frames::oracle::textbook(n);
  return 2 * (ei * (2 * (t.s + t.sc) + n) / (l * l * l) * deflection + p * sine);
}

/// One beam-column per member with clamped ends: 2 dPi/d delta at dPi/dN = 0, where the energy is Pi = EI/(2
/// l) g_a turn^2 + N stretch - N^2 l/(2 EA). It is concave in N: bracketed Newton's iteration.
[[nodiscard]] inline Real element_load(double height, const Real& deflection) {
  const Real l = length, base = sqrt(l * l - Real(height) * height), rise = height - deflection;
  const Real chord = sqrt(base * base + rise * rise), turn = atan(rise / base) - atan(height / base);
  Real low = -39, high = 400;              // n = N l^2/EI; the energy's pole is at -4 pi^2
  Real n = (chord - l) * l * ea / ei - 1;  // of a bar, but not 0
  Real g = 0;
  for (int i = 0; i < 100; ++i) {
    const auto at = frames::oracle::exact(n).antisymmetric;
    const Real excess = l / 2 * at.slope * turn * turn + (chord - l) - n * ei / (l * ea);
    const Real fall = l / 2 * at.curvature * turn * turn - ei / (l * ea);
    (excess > 0 ? low : high) = n;
    g = at.value;
    const Real next = n - excess / fall;
    if (abs(next - n) < 1e-22) break;
    n = next > low && next < high ? next : Real((low + high) / 2);
  }
  return 2 * (-ei / l * g * turn * base / (chord * chord) - n * ei / (l * l) * rise / chord);
}

/// Deflection of the far branch, to 1e-17 inch.
[[nodiscard]] inline double deflection_under(Load load, double height, double pounds) {
  Real low = height > 0.4 ? 0.55 : 0, high = 0.8;
  for (int i = 0; i < 56; ++i) {
    const Real middle = (low + high) / 2;
    (load(height, middle) < pounds ? low : high) = middle;
  }
  return static_cast<double>(low);
}

/// The largest load up to a deflection of 0.4 in: ternary search on an interval with one maximum.
[[nodiscard]] inline double limit_load(Load load, double height) {
  Real low = 0.05, high = 0.4;
  for (int i = 0; i < 50; ++i) {
    const Real a = (2 * low + high) / 3, b = (low + 2 * high) / 3;
    if (load(height, a) < load(height, b)) {
      low = a;
    } else {
      high = b;
    }
  }
  return static_cast<double>(load(height, low));
}

}  // namespace nlmech::chapters::oracle

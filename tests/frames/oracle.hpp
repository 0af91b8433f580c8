/// @file
/// References for the tests of frames: the textbook's stability functions in 50 digits, and random members.
#pragma once

#include <cmath>
#include <limits>

#include "nlmech/frames/beam_column.hpp"
#include "nlmech/frames/stability_functions.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/random.hpp"

namespace nlmech::frames::oracle {

/// 50 digits.
using Real = ExtendedReal<50>;

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline const double pi = std::acos(-1.0);

/// s and s c of Livesley and Chandler, from the general solution of EI w'''' = N w'', as functions of n.
template <class T>
struct Textbook {
  T s;   ///< moment at the rotated end for a unit rotation, over EI/l
  T sc;  ///< moment at the other end
};

template <class T>
[[nodiscard]] Textbook<T> textbook(const T& n) {
  using std::cos;
  using std::cosh;
  using std::sin;
  using std::sinh;
  using std::sqrt;
  if (value_of(n) < 0) {
    const T x = sqrt(-n), below = 2 - 2 * cos(x) - x * sin(x);
    return {x * (sin(x) - x * cos(x)) / below, x * (x - sin(x)) / below};
  }
  const T x = sqrt(n), below = 2 - 2 * cosh(x) + x * sinh(x);
  return {x * (x * cosh(x) - sinh(x)) / below, x * (sinh(x) - x) / below};
}

/// g_a = 2 s (1 + c), g_s = 2 s (1 - c) with two derivatives by dual numbers. At least 25 of 50 digits remain
/// for |n| >= 1e-4.
[[nodiscard]] inline StabilityFunctions<Real> exact(const Real& n) {
  using D = Dual<Dual<Real, 1>, 1>;
  const D variable = D::variable(Dual<Real, 1>::variable(n, 0), 0);
  const Textbook<D> t = textbook(variable);
  const auto parts = [](const D& g) {
    return StabilityFunction<Real>{g.value.value, g.value.partial[0], g.partial[0].partial[0]};
  };
  return {parts(2 * (t.s + t.sc)), parts(2 * (t.s - t.sc))};
}

/// |a/b - 1| in units of eps.
[[nodiscard]] inline double error(double a, const Real& b) {
  return std::abs(static_cast<double>(Real(Real(a) / b - 1))) / eps;
}

using tests::between;

/// A member of length about 1 and EA = 1, with EI from 1e-6 to 1e-2, in any direction.
[[nodiscard]] inline BeamColumn random_member() {
  const double direction = *between(-pi, pi), length = *between(0.5, 2);
  return {length * std::cos(direction), length * std::sin(direction), 1, std::pow(10, *between(-6, -2))};
}

/// Random displacements with strains of some percent, bending of some tenths, and a rotation of up to @p
/// turn.
[[nodiscard]] inline Vector<double, 6> random_displacements(const BeamColumn& m, double turn) {
  const double angle = *between(-turn, turn), stretch = 1 + *between(-0.05, 0.05);
  const double c = std::cos(angle) * stretch, s = std::sin(angle) * stretch;
  const double x = *between(-1, 1), y = *between(-1, 1);
  Vector<double, 6> d;
  d << x, y, angle + *between(-0.5, 0.5), x + (c - 1) * m.dx - s * m.dy, y + s * m.dx + (c - 1) * m.dy,
      angle + *between(-0.5, 0.5);
  return d;
}

}  // namespace nlmech::frames::oracle

/// @file
/// Right-hand sides with all operations that a tape knows.
#pragma once

#include <vector>

#include "nlmech/program/vector.hpp"
#include "nlmech/support/instruction_set.hpp"

namespace nlmech::tests {

/// Every operation that a right-hand side may have, with constants on both sides, on the time, and in sums
/// that the tape gathers.
struct Tangle {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T& t, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    const T &a = x[0], &b = x[1], &c = x[2];
    const T line = 2 * t - 1, one = 1;
    T sum = a * b - 0.3 * a + b / 3.0 - (one + one) * (c - a);
    sum += 0.1 * (0.7 * c) - (b - (c - t));
    sum -= 1 - a * a;
    sum /= 4.0;
    f[0] = sum + sqrt(b) * line - a / b + 0.5 / c - pow(c, 3) * 0.01 + pow(a, -2) / 7.0;
    const T s = sin(a * b), r = cos(a * b) + sin(line) - cos(line) * s;
    f[1] = -r * exp(-c) + log(b) * tanh(a) - exp(0.5 * t) / 9.0 + +a * T(0) + T(2) * T(0.25);
    f[2] = pow(b, -1.5) - tan(a / 4.0) + 0.2 * sinh(a - b) - cosh(t) * 0.1 + pow(c, 0.7) - line * line;
  }
};

/// Functions that a tape makes of their slopes: each of a state, of the time and of a constant.
struct Inverses {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T& t, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    const T &a = x[0], &b = x[1], &c = x[2];
    const T constant = 0.5;
    f[0] = asin(a * c / 2.0) - acos(t) * b + asin(constant);
    f[1] = atan(a - b) + erf(c * c - t) - atan2(b, a * c) + acos(constant) + erf(constant);
    f[2] = atan2(T(2), -b) - atan2(-c, T(-1)) + atan(t * t) * a + atan2(constant, T(-3)) + atan(constant);
  }
};

/// A few operations to the highest order, all of them to the first ones: every order is code of its own.
struct Few {
  static constexpr int dimension = 3;
  template <class T>
  void operator()(const T& t, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    f[0] = x[1] * x[2] - sin(x[0]) * t;
    f[1] = x[0] * x[0] - 1 / x[2];
    f[2] = sqrt(x[1]) - x[2];
  }
};

/// Where all of them are defined.
inline const Vector<double, 3> point(0.6, 1.2, 0.9);

/// Those that this processor has.
inline std::vector<InstructionSet> sets() {
  std::vector<InstructionSet> all;
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (available(set)) all.push_back(set);
  }
  return all;
}

}  // namespace nlmech::tests

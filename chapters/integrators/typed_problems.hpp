/// @file
/// Typed equations and the same problems in C++, side by side: for benchmarks and tests of the one against
/// the other.
#pragma once

#include <cmath>
#include <string_view>

#include "nlmech/program/vector.hpp"

namespace nlmech::chapters::integrators {

/// Ueda's oscillator.
struct Ueda {
  static constexpr int dimension = 2;  ///< x, x'
  /// As one types it.
  static constexpr std::string_view text = "x'' + k x' + x^3 = B cos(t); k = 0.05; B = 7.5";
  static constexpr double k = 0.05, force = 7.5;  ///< damping, amplitude
  /// A state on the way.
  static Vector<double, 2> state() { return {3, 4}; }
  /// dx/dt.
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& f) const {
    using std::cos;
    f[0] = x[1];
    f[1] = force * cos(t) - k * x[1] - x[0] * x[0] * x[0];
  }
};

/// Lorenz (1963).
struct Convection {
  static constexpr int dimension = 3;  ///< u, v, w
  /// As one types it.
  static constexpr std::string_view text =
      "u' = sigma (v - u); v' = r u - v - u w; w' = u v - b w; sigma = 10; r = 28; b = 8/3";
  static constexpr double sigma = 10, r = 28, b = 8.0 / 3;  ///< parameters
  /// A state on the way.
  static Vector<double, 3> state() { return {1, 1, 1}; }
  /// dx/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 3>& x, Vector<T, 3>& f) const {
    f[0] = sigma * (x[1] - x[0]);
    f[1] = r * x[0] - x[1] - x[0] * x[2];
    f[2] = x[0] * x[1] - b * x[2];
  }
};

/// Van der Pol's oscillator.
struct Relaxation {
  static constexpr int dimension = 2;  ///< x, x'
  /// As one types it.
  static constexpr std::string_view text = "x'' - mu (1 - x^2) x' + x = 0; mu = 5";
  static constexpr double mu = 5;  ///< damping
  /// A state on the way.
  static Vector<double, 2> state() { return {2, 0.1}; }
  /// dx/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& x, Vector<T, 2>& f) const {
    f[0] = x[1];
    f[1] = mu * (1 - x[0] * x[0]) * x[1] - x[0];
  }
};

/// Two rods with a bob at the end of each, solved by hand for the accelerations.
struct DoublePendulum {
  static constexpr int dimension = 4;  ///< a, b, a', b'
  /// As one types it: both accelerations stand in both equations.
  static constexpr std::string_view text =
      "(m1 + m2) l1 a'' + m2 l2 b'' cos(a - b) + m2 l2 b'^2 sin(a - b) + (m1 + m2) g sin(a) = 0\n"
      "l2 b'' + l1 a'' cos(a - b) - l1 a'^2 sin(a - b) + g sin(b) = 0\n"
      "m1 = 1; m2 = 1; l1 = 1; l2 = 1; g = 9.81";
  static constexpr double m1 = 1, m2 = 1, l1 = 1, l2 = 1, g = 9.81;  ///< masses, lengths, weight of a mass
  /// A state on the way.
  static Vector<double, 4> state() { return {2, 1, 0.1, -0.2}; }
  /// dx/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 4>& x, Vector<T, 4>& f) const {
    using std::cos;
    using std::sin;
    const T c = cos(x[0] - x[1]), s = sin(x[0] - x[1]);
    const T p = -m2 * l2 * x[3] * x[3] * s - (m1 + m2) * g * sin(x[0]),
            q = l1 * x[2] * x[2] * s - g * sin(x[1]);
    const T det = (m1 + m2) * l1 * l2 - m2 * l1 * l2 * c * c;
    f[0] = x[2];
    f[1] = x[3];
    f[2] = (l2 * p - m2 * l2 * c * q) / det;
    f[3] = ((m1 + m2) * l1 * q - l1 * c * p) / det;
  }
};

/// A satellite of Earth and Moon (Arenstorf).
struct Satellite {
  static constexpr int dimension = 4;  ///< x, y, x', y'
  /// As one types it.
  static constexpr std::string_view text =
      "x'' = x + 2 y' - (1 - mu) (x + mu)/D1 - mu (x - 1 + mu)/D2\n"
      "y'' = y - 2 x' - (1 - mu) y/D1 - mu y/D2\n"
      "D1 = ((x + mu)^2 + y^2)^1.5; D2 = ((x - 1 + mu)^2 + y^2)^1.5; mu = 0.012277471";
  static constexpr double mu = 0.012277471;  ///< share of the Moon
  /// A state on the way.
  static Vector<double, 4> state() { return {0.5, 0.3, -0.2, -1.2}; }
  /// dx/dt.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 4>& x, Vector<T, 4>& f) const {
    using std::pow;
    const T a = x[0] + mu, b = x[0] - 1 + mu;
    const T p = pow(a * a + x[1] * x[1], 1.5), q = pow(b * b + x[1] * x[1], 1.5);
    f[0] = x[2];
    f[1] = x[3];
    f[2] = x[0] + 2 * x[3] - (1 - mu) * a / p - mu * b / q;
    f[3] = x[1] - 2 * x[2] - (1 - mu) * x[1] / p - mu * x[1] / q;
  }
};

}  // namespace nlmech::chapters::integrators

/// @file
/// Hand-written equations for benchmarks: on the array type of a peer library, and as problems that nlmech
/// methods inline. A test checks them against the .ode files of the same problems.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "nlmech/problems/problem.hpp"
#include "nlmech/program/value_of.hpp"

namespace nlmech::chapters {

/// Free Duffing oscillator.
struct PlainDuffing {
  static constexpr int dimension = 2;           ///< position and velocity
  double natural_frequency = 1, hardening = 1;  ///< parameters of duffing.ode
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double /*t*/) const {
    dxdt[0] = x[1];
    dxdt[1] = -natural_frequency * natural_frequency * x[0] - hardening * x[0] * x[0] * x[0];
  }
  /// The acceleration for every type of number.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 1>& q, const Vector<T, 1>& /*v*/, Vector<T, 1>& a) const {
    const T& x = q[0];
    a[0] = -(natural_frequency * (natural_frequency * x)) - hardening * (x * x * x);
  }
  /// dx/dt for every type of number.
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
};

/// Duffing oscillator under an impact load.
struct PlainImpact {
  static constexpr int dimension = 2;                                    ///< position and velocity
  double natural_frequency = 1, hardening = 1, slope = 2, duration = 1;  ///< parameters of impact.ode
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double t) const {
    dxdt[0] = x[1];
    dxdt[1] = force(t) - natural_frequency * natural_frequency * x[0] - hardening * x[0] * x[0] * x[0];
  }
  /// The acceleration for every type of number.
  template <class T>
  void acceleration(const T& t, const Vector<T, 1>& q, const Vector<T, 1>& /*v*/, Vector<T, 1>& a) const {
    const T& x = q[0];
    a[0] = force(t) - natural_frequency * (natural_frequency * x) - hardening * (x * x * x);
  }
  /// dx/dt for every type of number.
  template <class T>
  void operator()(const T& t, const Vector<T, 2>& x, Vector<T, 2>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
  /// Times in the interval at which the slope of the force jumps, in the direction of integration.
  [[nodiscard]] std::vector<double> discontinuities(double from, double to) const {
    std::vector<double> times;
    for (const double t : {0.0, duration / 2, duration}) {
      if (t > std::min(from, to) && t < std::max(from, to)) times.push_back(t);
    }
    if (to < from) std::reverse(times.begin(), times.end());
    return times;
  }

 private:
  template <class T>
  T force(const T& t) const {
    const auto now = value_of(t);
    if (now < 0 || now >= duration) return T(0);
    if (now < duration / 2) return slope * t;
    return slope * (duration - t);
  }
};

/// Lorenz equations.
struct PlainLorenz {
  static constexpr int dimension = 3;      ///< u, v, w
  double sigma = 10, r = 28, b = 8.0 / 3;  ///< parameters
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double /*t*/) const {
    slopes(x, dxdt);
  }
  /// dx/dt for every type of number.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 3>& x, Vector<T, 3>& dxdt) const {
    slopes(x, dxdt);
  }

 private:
  template <class In, class Out>
  void slopes(const In& x, Out&& dxdt) const {
    dxdt[0] = sigma * (x[1] - x[0]);
    dxdt[1] = x[0] * (r - x[2]) - x[1];
    dxdt[2] = x[0] * x[1] - b * x[2];
  }
};

/// The chain of three masses.
struct PlainChain {
  static constexpr int dimension = 6;  ///< positions and velocities
  double m1 = 2, m2 = 1, m3 = 0.5, c1 = 0, c2 = 0.05, c3 = 0, c4 = 0, k1 = 2, k2 = 1, k3 = 0.5, k4 = 0,
         l1 = 0.2, l2 = 0, l3 = 0, l4 = 0, force = 0.2,
         frequency = std::sqrt(0.5);  ///< parameters of three-dof.ode
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double t) const {
    const double e1 = spring(k1, c1, l1, x[0], x[3]), e2 = spring(k2, c2, l2, x[0] - x[1], x[3] - x[4]);
    const double e3 = spring(k3, c3, l3, x[1] - x[2], x[4] - x[5]), e4 = spring(k4, c4, l4, x[2], x[5]);
    dxdt[0] = x[3], dxdt[1] = x[4], dxdt[2] = x[5];
    dxdt[3] = (-e1 - e2) / m1;
    dxdt[4] = (force * std::cos(frequency * t) + e2 - e3) / m2;
    dxdt[5] = (e3 - e4) / m3;
  }
  /// The accelerations for every type of number. Cubic terms with coefficient 0 are not evaluated.
  template <class T>
  void acceleration(const T& t, const Vector<T, 3>& q, const Vector<T, 3>& v, Vector<T, 3>& a) const {
    using std::cos;
    const auto element = [](double k, double c, double l, const T& d, const T& rate) {
      T f = k * d + c * rate;
      if (l != 0) f += l * (d * d * d);
      return f;
    };
    const T e1 = element(k1, c1, l1, q[0], v[0]), e2 = element(k2, c2, l2, T(q[0] - q[1]), T(v[0] - v[1]));
    const T e3 = element(k3, c3, l3, T(q[1] - q[2]), T(v[1] - v[2])), e4 = element(k4, c4, l4, q[2], v[2]);
    a[0] = (-e1 - e2) / m1;
    a[1] = (force * cos(frequency * t) + e2 - e3) / m2;
    a[2] = (e3 - e4) / m3;
  }
  /// dx/dt for every type of number.
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }

 private:
  static double spring(double k, double c, double l, double d, double rate) {
    return k * d + c * rate + l * d * d * d;
  }
};

/// Two-body problem.
struct PlainTwoBody {
  static constexpr int dimension = 6;  ///< positions and velocities
  double mu = 1;                       ///< gravitational parameter
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double /*t*/) const {
    const double square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const double factor = -mu / (square * std::sqrt(square));
    dxdt[0] = x[3];
    dxdt[1] = x[4];
    dxdt[2] = x[5];
    dxdt[3] = factor * x[0];
    dxdt[4] = factor * x[1];
    dxdt[5] = factor * x[2];
  }
  /// The acceleration for every type of number.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 3>& q, const Vector<T, 3>& /*v*/, Vector<T, 3>& a) const {
    using std::sqrt;
    const T square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const T factor = -mu / (square * sqrt(square));
    for (int i = 0; i < 3; ++i) a[i] = factor * q[i];
  }
  /// dx/dt for every type of number.
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    problems::first_order_form(*this, t, x, dxdt);
  }
};

}  // namespace nlmech::chapters

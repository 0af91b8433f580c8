/// @file
/// References for the tests of orbits: Kepler's motion in 50 digits from Kepler's equation, one branch per
/// conic, independent of universal variables; and random orbits.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "nlmech/orbit/state.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/random.hpp"

namespace nlmech::orbit::oracle {

/// 50 digits.
using Real = ExtendedReal<50>;

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline const double pi = std::acos(-1.0);

template <class T>
[[nodiscard]] BasicState<T> as(const State& s) {
  return {s.position.template cast<T>(), s.velocity.template cast<T>()};
}

template <class T>
[[nodiscard]] T length(const Vector3<T>& v) {
  using std::sqrt;
  return sqrt(v.dot(v));
}

/// |a - b|/|b|, b in 50 digits.
[[nodiscard]] inline double relative_distance(const Vector3<double>& a, const Vector3<Real>& b) {
  const Vector3<Real> d = a.cast<Real>() - b;
  return static_cast<double>(Real(length(d) / length(b)));
}

/// The root of an increasing function between two bounds: bisection, then Newton's iteration.
template <class F>
[[nodiscard]] Real root(const F& value_and_slope, Real low, Real high) {
  for (int i = 0; i < 40; ++i) {
    const Real middle = (low + high) / 2;
    (value_and_slope(middle).first < 0 ? low : high) = middle;
  }
  Real x = (low + high) / 2;
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = value_and_slope(x);
    if (slope == 0 || abs(value) <= Real(1e-49) * abs(slope) * (1 + abs(x))) break;
    Real next = x - value / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    (value_and_slope(next).first < 0 ? low : high) = next;
    x = next;
  }
  return x;
}

/// Kepler's motion by E - e sin E = M, e sinh H - H = N, or Barker's equation, in the frame of the periapsis;
/// for straight lines with e = 1 and the line as axis.
[[nodiscard]] inline BasicState<Real> kepler(const State& start, double time, double gravity) {
  const BasicState<Real> s = as<Real>(start);
  const Real mu = gravity, r0 = length(s.position), alpha = 2 / r0 - s.velocity.dot(s.velocity) / mu;
  const Vector3<Real> h = cross(s.position, s.velocity);
  const Real p = h.dot(h) / mu, along = s.position.dot(s.velocity) / sqrt(mu);  // p, sigma
  const Vector3<Real> to_periapsis = cross(s.velocity, h) / mu - s.position / r0;
  const Real e = length(to_periapsis);
  const Vector3<Real> x = e == 0 ? Vector3<Real>(s.position / r0) : Vector3<Real>(to_periapsis / e);
  Vector3<Real> y = Vector3<Real>::Zero();
  if (p > 0) y = cross(Vector3<Real>(h / length(h)), x);
  const auto in_frame = [&](const Real& px, const Real& py, const Real& vx, const Real& vy) {
    return BasicState<Real>{px * x + py * y, vx * x + vy * y};
  };
  if (alpha > 0) {
    const Real a = 1 / alpha, n = sqrt(mu * alpha) * alpha, b = sqrt(a * p);
    const Real e0 = e == 0 ? Real(0) : Real(atan2(along * sqrt(alpha), 1 - r0 * alpha));
    const Real m = e0 - e * sin(e0) + n * Real(time);
    const Real anomaly =
        root([&](const Real& E) { return std::pair<Real, Real>(E - e * sin(E) - m, 1 - e * cos(E)); }, m - 2,
             m + 2);
    const Real rate = n / (1 - e * cos(anomaly));
    return in_frame(a * (cos(anomaly) - e), b * sin(anomaly), -a * sin(anomaly) * rate,
                    b * cos(anomaly) * rate);
  }
  if (alpha < 0) {
    const Real a = -1 / alpha, n = sqrt(-mu * alpha) * -alpha, b = sqrt(a * p);
    const Real h0 = asinh(along * sqrt(-alpha) / e);
    const Real m = e * sinh(h0) - h0 + n * Real(time);
    Real bound = 1;
    while (e * sinh(bound) - bound < abs(m)) bound *= 2;
    const Real H =
        root([&](const Real& u) { return std::pair<Real, Real>(e * sinh(u) - u - m, e * cosh(u) - 1); },
             -bound, bound);
    const Real rate = n / (e * cosh(H) - 1);
    return in_frame(a * (e - cosh(H)), b * sinh(H), -a * sinh(H) * rate, b * cosh(H) * rate);
  }
  // Parabola: r = (p + d^2)/2 with d = tan(nu/2) sqrt(p), here `along`; 2 sqrt(mu) t = p d + d^3/3.
  const Real m = p * along + along * along * along / 3 + 2 * sqrt(mu) * Real(time);
  Real bound = 1;
  while (p * bound + bound * bound * bound / 3 < abs(m)) bound *= 2;
  const Real d =
      root([&](const Real& u) { return std::pair<Real, Real>(p * u + u * u * u / 3 - m, p + u * u); }, -bound,
           bound);
  const Real r = (p + d * d) / 2, rate = sqrt(mu) / r;
  return in_frame((p - d * d) / 2, sqrt(p) * d, -d * rate, sqrt(p) * rate);
}

using tests::between;

/// A state with the given distance, speed over circular speed, and angle from the outward direction, in a
/// random plane.
[[nodiscard]] inline State random_state(double r, double mu, double speed, double flight) {
  const auto turn = [](double angle, int i, int j, Vector3<double>& v) {
    const double c = std::cos(angle), s = std::sin(angle), a = v[i], b = v[j];
    v[i] = c * a - s * b;
    v[j] = s * a + c * b;
  };
  const double v = speed * std::sqrt(mu / r);
  State s{{r, 0, 0}, {v * std::cos(flight), v * std::sin(flight), 0}};
  const double first = *between(-pi, pi), second = *between(-pi, pi), third = *between(-pi, pi);
  for (Vector3<double>* u : {&s.position, &s.velocity}) {
    turn(first, 0, 1, *u);
    turn(second, 1, 2, *u);
    turn(third, 0, 1, *u);
  }
  return s;
}

/// The low and the eccentric orbit of the dissertation, Eqs 3.71 and 3.73.
inline const State low_orbit{{1.702547136867679e6, 6.353992417071098e6, 0},
                             {-7.886014053829254e3, 2.113051097224035e3, 0}};
inline const State eccentric_orbit{{2.096434265330419e6, 7.823999192941453e6, 0},
                                   {-8.834757074967362e3, 2.367266023562654e3, 0}};
inline constexpr double earth_mu = 3.986004418e14;

/// At the periapsis of an ellipse with a = 1, mu = 1.
[[nodiscard]] inline State at_periapsis(double e) {
  return {{1 - e, 0, 0}, {0, std::sqrt((1 + e) / (1 - e)), 0}};
}

}  // namespace nlmech::orbit::oracle

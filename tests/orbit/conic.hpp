/// @file
/// Kepler's motion by its classical equations in any type of number, one branch per conic: a reference
/// independent of universal variables.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "nlmech/orbit/state.hpp"

namespace nlmech::orbit::oracle {

template <class T>
[[nodiscard]] BasicState<T> as(const State& s) {
  BasicState<T> wide;
  for (int i = 0; i < 3; ++i) wide.position[i] = T(s.position[i]), wide.velocity[i] = T(s.velocity[i]);
  return wide;
}

template <class T>
[[nodiscard]] T length(const Vector3<T>& v) {
  using std::sqrt;
  return sqrt(v.dot(v));
}

/// The root of an increasing function between two bounds, by bracketed Newton's iteration.
template <class T, class F>
[[nodiscard]] T root_of(const F& value_and_slope, T low, T high, T x) {
  using std::abs;
  for (int i = 0; i < 2000; ++i) {
    const auto [value, slope] = value_and_slope(x);
    if (value == 0) break;
    (value < 0 ? low : high) = x;
    T next = slope > 0 ? T(x - value / slope) : low;
    if (!(next > low && next < high) || i % 16 == 15) next = (low + high) / 2;
    const T change = abs(T(next - x));
    x = next;
    if (change <= std::numeric_limits<T>::epsilon() * abs(x) / 2) break;
  }
  return x;
}

/// Kepler's motion by E - e sin E = M, e sinh H - H = N, or Barker's equation, in the frame of the periapsis;
/// for straight lines with e = 1 and the line as axis.
template <class T>
[[nodiscard]] BasicState<T> conic(const BasicState<T>& s, const T& t, const T& mu) {
  using std::abs, std::asinh, std::atan2, std::cos, std::cosh, std::floor, std::log, std::pow, std::sin,
      std::sinh, std::sqrt;
  const T r0 = length(s.position), alpha = 2 / r0 - s.velocity.dot(s.velocity) / mu;
  const Vector3<T> h = cross(s.position, s.velocity);
  const T p = h.dot(h) / mu, along = s.position.dot(s.velocity) / sqrt(mu);
  const Vector3<T> apse = cross(s.velocity, h) / mu - s.position / r0;
  const T e = length(apse);
  const Vector3<T> x = e == 0 ? Vector3<T>(s.position / r0) : Vector3<T>(apse / e);
  Vector3<T> y = Vector3<T>::Zero();
  if (p > 0) y = cross(Vector3<T>(h / length(h)), x);
  const auto in_frame = [&](const T& px, const T& py, const T& vx, const T& vy) {
    return BasicState<T>{px * x + py * y, vx * x + vy * y};
  };
  if (alpha > 0) {
    const T a = 1 / alpha, n = sqrt(mu * alpha) * alpha, b = sqrt(a * p), turn = 2 * atan2(T(0), T(-1));
    const T e0 = e == 0 ? T(0) : T(atan2(T(along * sqrt(alpha)), T(1 - r0 * alpha)));
    T m = e0 - e * sin(e0) + n * t;
    m -= turn * floor(T(m / turn + T(0.5)));
    const T E = root_of<T>([&](const T& u) { return std::pair<T, T>(u - e * sin(u) - m, 1 - e * cos(u)); },
                           m - 2, m + 2, m + e * sin(m));
    const T rate = n / (1 - e * cos(E));
    return in_frame(a * (cos(E) - e), b * sin(E), -a * sin(E) * rate, b * cos(E) * rate);
  }
  if (alpha < 0) {
    const T a = -1 / alpha, n = sqrt(-mu * alpha) * -alpha, b = sqrt(a * p);
    const T h0 = asinh(T(along * sqrt(-alpha) / e)), m = e * sinh(h0) - h0 + n * t;
    T bound = 1;
    while (e * sinh(bound) - bound < abs(m)) bound *= 2;
    const T H = root_of<T>([&](const T& u) { return std::pair<T, T>(e * sinh(u) - u - m, e * cosh(u) - 1); },
                           -bound, bound, asinh(T(m / e)));
    const T rate = n / (e * cosh(H) - 1);
    return in_frame(a * (e - cosh(H)), b * sinh(H), -a * sinh(H) * rate, b * cosh(H) * rate);
  }
  // Parabola: r = (p + d^2)/2 with d = tan(nu/2) sqrt(p), here `along`; 2 sqrt(mu) t = p d + d^3/3.
  const T m = p * along + along * along * along / 3 + 2 * sqrt(mu) * t;
  T bound = 1;
  while (p * bound + bound * bound * bound / 3 < abs(m)) bound *= 2;
  const T d = root_of<T>([&](const T& u) { return std::pair<T, T>(p * u + u * u * u / 3 - m, p + u * u); },
                         -bound, bound, T(0));
  const T r = (p + d * d) / 2, rate = sqrt(mu) / r;
  return in_frame((p - d * d) / 2, sqrt(p) * d, -d * rate, sqrt(p) * rate);
}

template <class T>
[[nodiscard]] BasicState<T> conic(const State& start, double time, double gravity) {
  return conic<T>(as<T>(start), T(time), T(gravity));
}

}  // namespace nlmech::orbit::oracle

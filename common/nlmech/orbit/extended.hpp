/// @file
/// Orbits in any type of number: references in extended precision by the recursion of Expansion.
#pragma once

#include <cmath>

#include "nlmech/orbit/expansion.hpp"

namespace nlmech::orbit {

/// Moves @p s by @p time, of either sign, with series of @p order (at least 4) whose step makes the last
/// terms of the velocity @p tolerance times the larger of |v| and the circular speed. Two calls with other
/// orders and tolerances tell the digits. Not checked: a body that falls into the centre never arrives.
template <class T>
[[nodiscard]] BasicState<T> continue_analytically(BasicState<T> s, T time, const BasicGravity<T>& gravity,
                                                  int order, const T& tolerance) {
  using std::abs;
  using std::max;
  using std::min;
  using std::pow;
  using std::sqrt;
  Expansion<T> series(gravity, order);
  while (time != 0) {
    series.expand(s, order);
    const T circular = gravity.mu / sqrt(s.position.dot(s.position));
    const T speed = sqrt(max(T(s.velocity.dot(s.velocity)), circular));
    T h = abs(time);
    for (int k = order - 1; k <= order; ++k) {
      const Vector3<T> c = series.coefficient(k);
      const T last = k * sqrt(c.dot(c));
      if (last != 0) h = min(h, T(pow(T(tolerance * speed / last), T(1) / (k - 1))));
    }
    if (time < 0) h = -h;
    const BasicState<T> change = series.increments(h, order, order - 1);
    s.position += change.position;
    s.velocity += change.velocity;
    time -= h;
  }
  return s;
}

}  // namespace nlmech::orbit

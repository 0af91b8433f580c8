/// @file
/// The classical Runge-Kutta method, independent of series and of the library.
#pragma once

#include <array>
#include <cstddef>

namespace nlmech::tests {

/// The state at @p t1 of dx/dt = field(t, x) from @p x at @p t0 by @p steps equal steps: the error decreases
/// with their fourth power, and rounding errors of eps a step add up.
template <std::size_t n, class Field>
[[nodiscard]] std::array<double, n> runge_kutta(const Field& field, std::array<double, n> x, double t0,
                                                double t1, int steps) {
  using State = std::array<double, n>;
  const auto moved = [](const State& from, double by, const State& slope) {
    State to = from;
    for (std::size_t i = 0; i < n; ++i) to[i] += by * slope[i];
    return to;
  };
  const double h = (t1 - t0) / steps;
  for (int k = 0; k < steps; ++k) {
    const double t = t0 + k * h;
    const State a = field(t, x), b = field(t + h / 2, moved(x, h / 2, a)),
                c = field(t + h / 2, moved(x, h / 2, b)), d = field(t + h, moved(x, h, c));
    for (std::size_t i = 0; i < n; ++i) x[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return x;
}

}  // namespace nlmech::tests

/// @file
/// Taylor series in time of the motion about a centre, for any number type, order and zonal field; and
/// reference orbits in extended precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "nlmech/orbit/gravity.hpp"

namespace nlmech::orbit {

/// The recurrence of analytic continuation, Eqs 3.61-3.68 of Elgohary 2015 as corrected, in normalised
/// coefficients x_n = x^(n)/n!, which have no binomial coefficients in Leibniz' rule:
///
///     f = r.r,  g_p = f^(-p/2):   f_0 g_n = -(1/n) sum_{m=1}^{n} ((p/2) m + n - m) f_m g_{n-m}     (3.66)
///     r'' = -mu g_3 r:            r_{n+2} = -mu sum_{m=0}^{n} r_m g_{n-m} / ((n + 1)(n + 2))       (3.68)
///
/// and, for zonal harmonics, with q = g_1, s = z q (the sine of the latitude) and w_k = R^k q^(k+2),
///
///     r'' = mu [(-g_3 + q sum_k J_k w_k P'_{k+1}(s)) r - z^ sum_k J_k w_k P'_k(s)],
///
/// with the Legendre polynomials and their derivatives by recurrences and products of series by Cauchy's
/// formula. Quotients by integers are divisions: rounded reciprocals have the same relative error in every
/// step, and the energy drifts linearly. The sums have four independent parts.
///
/// Storage is allocated only at construction. The kernels of AnalyticContinuation have a faster recurrence
/// for a point mass; this class serves all other cases and extended precision.
///
/// Tests compare coefficients with those of Kepler motion in extended precision, and check the order of a
/// step, the lower of both degrees (observed within 0.1 to 0.3).
template <class T>
class Expansion {
 public:
  /// Storage for coefficients up to @p order, at least 2, in the field @p gravity (both not checked).
  /// @param true_division false: multiplies by rounded -mu/((n + 1)(n + 2)), to show the error
  Expansion(const BasicGravity<T>& gravity, int order, bool true_division = true)
      : gravity_(gravity), degree_(gravity.degree()), order_(order), true_division_(true_division) {
    for (Row* row : {&f_, &g_, &q_, &sine_, &axial_, &radial_, &field_, &square_}) resize(*row);
    for (Row& row : r_) resize(row);
    if (degree_ == 0) return;
    for (auto* family : {&legendre_, &slope_, &weight_})
      for (Row& row : *family) resize(row);
  }

  /// Sets mu and R in other units.
  void set_units(const T& mu, const T& radius) {
    gravity_.mu = mu;
    gravity_.radius = radius;
  }

  /// Computes the coefficients about @p s, up to @p order, at most that of the constructor.
  void expand(const BasicState<T>& s, int order) {
    for (std::size_t i = 0; i < 3; ++i) {
      r_[i][0] = s.position[static_cast<int>(i)];
      r_[i][1] = s.velocity[static_cast<int>(i)];
    }
    // [coefficient by coefficient]
    for (int n = 0; n + 2 <= order; ++n) {
      const auto k = static_cast<std::size_t>(n);
      f_[k] = square(r_[0], k) + square(r_[1], k) + square(r_[2], k);
      power(g_, 3, k);
      field_[k] = -g_[k];
      if (degree_ > 0) zonal(k);
      const T divisor = T((n + 1) * (n + 2));
      for (std::size_t i = 0; i < 3; ++i) {
        T sum = product(r_[i], field_, k);
        if (degree_ > 0 && i == 2) sum -= axial_[k];
        r_[i][k + 2] = true_division_ ? T(gravity_.mu * sum / divisor) : T(gravity_.mu / divisor * sum);
      }
    }
    // [coefficient by coefficient]
  }

  /// r_k of the latest expand().
  [[nodiscard]] Vector3<T> coefficient(int k) const {
    const auto i = static_cast<std::size_t>(k);
    return {r_[0][i], r_[1][i], r_[2][i]};
  }

  /// Change of the state in the time @p h by Horner's rule: the position series to @p position_degree, the
  /// velocity series to @p velocity_degree (which uses the coefficient velocity_degree + 1 of the position).
  [[nodiscard]] BasicState<T> increments(const T& h, int position_degree, int velocity_degree) const {
    BasicState<T> change{coefficient(position_degree),
                         T(velocity_degree + 1) * coefficient(velocity_degree + 1)};
    for (int k = position_degree - 1; k >= 1; --k) change.position = change.position * h + coefficient(k);
    for (int k = velocity_degree; k >= 2; --k) change.velocity = change.velocity * h + T(k) * coefficient(k);
    return {change.position * h, change.velocity * h};
  }

 private:
  using Row = std::vector<T>;
  static constexpr std::size_t most = 8;  ///< P'_7 is needed for J_6

  void resize(Row& row) const { row.resize(static_cast<std::size_t>(order_) + 1); }

  /// sum_{m=0}^{n} a_m b_{n-m}
  static T product(const Row& a, const Row& b, std::size_t n) {
    T part[4] = {T(0), T(0), T(0), T(0)};
    std::size_t m = 0;
    for (; m + 3 <= n; m += 4) {
      for (std::size_t i = 0; i < 4; ++i) part[i] += a[m + i] * b[n - m - i];
    }
    for (; m <= n; ++m) part[m % 4] += a[m] * b[n - m];
    return (part[0] + part[1]) + (part[2] + part[3]);
  }
  /// sum_{m=0}^{n} a_m a_{n-m}, each product once.
  static T square(const Row& a, std::size_t n) {
    T sum = T(0);
    for (std::size_t m = 0; 2 * m < n; ++m) sum += a[m] * a[n - m];
    sum += sum;
    if (n % 2 == 0) sum += a[n / 2] * a[n / 2];
    return sum;
  }
  /// Coefficient n of f^(-p/2).
  void power(Row& g, int p, std::size_t n) {
    using std::sqrt;
    if (n == 0) {
      const T inverse = 1 / sqrt(f_[0]);
      g[0] = p == 1 ? inverse : T(inverse / f_[0]);
      return;
    }
    T part[2] = {T(0), T(0)};  // twice the sum: (p m + 2 (n - m)) = 2 n + (p - 2) m is an integer
    for (std::size_t m = 1; m <= n; ++m) {
      const int weight = 2 * static_cast<int>(n) + (p - 2) * static_cast<int>(m);
      part[m % 2] += T(weight) * (f_[m] * g[n - m]);
    }
    g[n] = -(part[0] + part[1]) / (T(2 * static_cast<int>(n)) * f_[0]);
  }

  /// Coefficient n of all series of the zonal terms; expand() uses field_ and axial_.
  void zonal(std::size_t n) {
    power(q_, 1, n);
    sine_[n] = product(r_[2], q_, n);
    square_[n] = square(q_, n);
    legendre_[0][n] = T(n == 0 ? 1 : 0);
    legendre_[1][n] = sine_[n];
    slope_[1][n] = legendre_[0][n];
    const std::size_t top =
        std::min(static_cast<std::size_t>(degree_) + 1, most - 1);  // bound for the compiler
    for (std::size_t k = 1; k < top; ++k) {
      const T by_sine = product(sine_, legendre_[k], n);
      slope_[k + 1][n] = product(sine_, slope_[k], n) + T(k + 1) * legendre_[k][n];
      legendre_[k + 1][n] = (T(2 * k + 1) * by_sine - T(k) * legendre_[k - 1][n]) / T(k + 1);
    }
    weight_[2][n] = gravity_.radius * gravity_.radius * square(square_, n);
    for (std::size_t k = 2; k + 1 < top; ++k)
      weight_[k + 1][n] = gravity_.radius * product(weight_[k], q_, n);
    T radial = T(0), axial = T(0);
    for (std::size_t k = 2; k < top; ++k) {
      const T& j = gravity_.zonal[k - 2];
      if (j == T(0)) continue;
      radial += j * product(weight_[k], slope_[k + 1], n);
      axial += j * product(weight_[k], slope_[k], n);
    }
    radial_[n] = radial;
    axial_[n] = axial;
    field_[n] += product(q_, radial_, n);
  }

  BasicGravity<T> gravity_;
  int degree_, order_;
  bool true_division_;
  std::array<Row, 3> r_;
  Row f_, g_, q_, sine_, axial_, radial_, field_, square_;
  std::array<Row, most> legendre_, slope_, weight_;  ///< P_k, P'_k and w_k at [k]
};

/// Propagates @p s by @p time, of either sign, with series of @p order (at least 4). The step size makes the
/// last terms of the velocity @p tolerance times the larger of |v| and the circular speed. Compare two calls
/// with different orders and tolerances to estimate the error. Not checked: the loop does not end for a body
/// that falls into the centre.
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

/// @file
/// Izzo's iteration for one arc of Lambert's problem, without allocation. Internal to the component.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/orbit/state.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"

namespace nlmech::orbit::detail {

/// Do two positions span a plane?
enum class Span { plane, opposite, same };

/// Geometry of Lambert's problem. Differences that vanish in a limit (180 degrees, r_1 = r_2, nearly one
/// direction) are computed as products, so that each number is accurate to some eps for positions within some
/// eps of the given ones (backward stable).
struct Chord {
  double r1, r2;                   ///< distances
  double s;                        ///< half the perimeter of the triangle
  double lambda;                   ///< sqrt(1 - c/s), c the chord; negative the long way
  double complement;               ///< 1 - lambda^2 = c/s
  double plus;                     ///< 1 + rho, rho = (r_1 - r_2)/c
  double minus;                    ///< 1 - rho
  double sigma;                    ///< sqrt(1 - rho^2)
  double speed;                    ///< sqrt(mu/(2 s))
  double rate;                     ///< sqrt(2 mu/s^3): T = rate times the time of flight
  Vector3<double> out1, out2;      ///< unit vectors along the positions
  Vector3<double> ahead1, ahead2;  ///< unit vectors normal to them, in the direction of motion

  /// Changes to the long way.
  void turn() {
    lambda = -lambda;
    ahead1 = -ahead1;
    ahead2 = -ahead2;
  }
};

/// Computes @p k for the short way. For opposite positions, which span no plane, @p normal defines it, unless
/// null. @return what the positions span
[[nodiscard]] inline Span make_chord(const Vector3<double>& from, const Vector3<double>& to, double mu,
                                     const Vector3<double>* normal, Chord& k) {
  k.r1 = std::sqrt(from.dot(from));
  k.r2 = std::sqrt(to.dot(to));
  k.out1 = from / k.r1;
  k.out2 = to / k.r2;
  const Vector3<double> both = k.out1 + k.out2, difference = to - from;
  const double c = std::sqrt(difference.dot(difference)), cosine2 = std::sqrt(both.dot(both));
  k.s = (k.r1 + k.r2 + c) / 2;
  // s - c = r_1 r_2 (1 + cos theta)/(2 s), and 2 (1 + cos theta) = |out1 + out2|^2.
  const double mean = std::sqrt(k.r1 * k.r2);
  k.lambda = mean * cosine2 / (2 * k.s);
  k.complement = c / k.s;
  k.speed = std::sqrt(mu / (2 * k.s));
  k.rate = 2 * k.speed / k.s;
  // Normal from the difference of the positions, or from the sum of the directions if that is shorter:
  // accurate to the rounding of the data.
  const bool wide = cosine2 < 1;
  Vector3<double> n;
  if (wide) {
    n = cross(k.out1, both);
  } else if (k.r1 < k.r2) {
    n = cross(k.out1, difference) / k.r2;
  } else {
    n = cross(k.out2, difference) / k.r1;
  }
  Span span = Span::plane;
  const double sine = std::sqrt(n.dot(n)), difference_of_squares = difference.dot(from + to);
  if (!(sine > 8 * std::numeric_limits<double>::epsilon())) {
    span = wide ? Span::opposite : Span::same;
    if (normal == nullptr || !wide) return span;
    n = *normal - normal->dot(k.out1) * k.out1;
    n /= std::sqrt(n.dot(n));
    k.lambda = 0;
    k.complement = 1;
    k.out2 = -k.out1;
    k.sigma = 2 * mean / c;
  } else {
    n /= sine;
    k.sigma = std::min(mean / c * (wide ? std::sqrt(4 - cosine2 * cosine2) : 2 * sine / cosine2), 1.0);
  }
  // r_1 - r_2 = (r_1^2 - r_2^2)/(r_1 + r_2)
  const double larger = 1 + std::abs(difference_of_squares) / ((k.r1 + k.r2) * c);
  const double smaller = k.sigma * k.sigma / larger;
  k.plus = k.r1 < k.r2 ? smaller : larger;
  k.minus = k.r1 < k.r2 ? larger : smaller;
  k.ahead1 = cross(n, k.out1);
  k.ahead2 = cross(n, k.out2);
  return span;
}

/// Time of flight T as a function of Izzo's x for M revolutions: a = s/(2 (1 - x^2)), x = 1 for the parabola,
/// x > 1 for hyperbolas.
///
///     y^2 = 1 - lambda^2 (1 - x^2),  eta = y - lambda x,  sin psi = eta (1 - x^2)^(1/2)
///     T = (M pi + psi - sin psi cos psi)/(1 - x^2)^(3/2) + 2 lambda eta
///
/// (Izzo's Eqs 9 and 18 to 20 rearranged). For M = 0 and small psi the quotient is eta^3 (2/3) F(3, 1; 5/2;
/// sin^2 (psi/2)), which holds through the parabola.
struct TimeCurve {
  double lambda, complement;
  double turns;  ///< M pi

  /// T and its derivatives at one x.
  struct At {
    double y, t, d1, d2, d3;
  };

  [[nodiscard]] static double series(double z) {
    constexpr int terms = 24;  // (z/1)^n (3)_n/(5/2)_n: 0.2^24 is below eps
    static constexpr auto coefficient = [] {
      std::array<double, terms> c = {2.0 / 3};
      for (std::size_t n = 1; n < c.size(); ++n) {
        const auto k = static_cast<double>(n);
        c[n] = c[n - 1] * (2 + k) / (1.5 + k);
      }
      return c;
    }();
    // Four independent sums, of every fourth power.
    const double z2 = z * z, z4 = z2 * z2;
    std::array<double, 4> sum = {};
    for (std::size_t n = terms; n > 0; n -= 4) {
      for (std::size_t i = 0; i < 4; ++i) sum[i] = sum[i] * z4 + coefficient[n - 4 + i];
    }
    return (sum[0] + z * sum[1]) + z2 * (sum[2] + z * sum[3]);
  }

  /// T without derivatives; also y, eta and q = 1 - x^2.
  [[nodiscard]] double time(double x, double& y, double& eta, double& q) const {
    q = (1 - x) * (1 + x);
    y = std::sqrt(complement + lambda * lambda * x * x);
    const double lx = lambda * x;
    eta = lx > 0 ? complement / (y + lx) : y - lx;
    const double cosine = q > 0 ? x * y + lambda * q : std::sqrt(1 - eta * eta * q);
    if (turns == 0 && cosine > 0.6) {
      const double z = eta * eta * q / (2 * (1 + cosine));
      if (z > -0.2) return eta * (eta * eta * series(z) + 2 * lambda);
    }
    if (q > 0) {
      const double root = std::sqrt(q), sine = eta * root;
      return (turns + std::atan2(sine, cosine) - sine * cosine) / (q * root) + 2 * lambda * eta;
    }
    const double root = std::sqrt(-q), psi = std::asinh(eta * root), l2 = lambda * lambda;
    const double lead = lambda > 0 ? complement * (x * x * (1 + l2) - l2) / (x + lambda * y) : x - lambda * y;
    return (lead - psi / root) / -q;
  }

  /// Izzo's Eq. 22. Near the parabola, where it is 0/0, the same equations are solved for the derivatives
  /// without (1 - x^2) T'''; the relative error of T' is then below 1e-4.
  [[nodiscard]] At at(double x) const {
    At a;
    double eta, q;
    a.t = time(x, a.y, eta, q);
    const double l2 = lambda * lambda, inverse = 1 / a.y, inverse2 = inverse * inverse;
    const double g2 = 2 * complement * l2 * lambda * (inverse2 * inverse), g3 = 3 * g2 * l2 * x * inverse2;
    if (turns == 0 && std::abs(x - 1) < 0.02) {
      const double part = q / (7 * x);
      a.d1 = (part * g3 - 3 * a.t - g2) / (5 * x + 8 * part);
      a.d2 = (g3 - 8 * a.d1) / (7 * x);
      a.d3 = 0;
      return a;
    }
    // 2 - 2 lambda^3 x/y without cancellation for lambda near 1
    const double per = 1 / q;
    a.d1 = (3 * a.t * x - 2 * (eta + lambda * x * complement) * inverse) * per;
    a.d2 = (3 * a.t + 5 * x * a.d1 + g2) * per;
    a.d3 = (7 * x * a.d2 + 8 * a.d1 - g3) * per;
    return a;
  }

  /// T at x = 1 and M = 0 (parabola).
  [[nodiscard]] double parabola() const {
    const double below = lambda > 0 ? complement / (1 + lambda) : 1 - lambda;  // 1 - lambda
    return below * (1 + lambda + lambda * lambda) * (2.0 / 3);
  }
  /// T at x = 0 (ellipse of minimum energy).
  [[nodiscard]] double middle() const {
    const double root = std::sqrt(complement);
    return turns + std::atan2(root, lambda) + lambda * root;
  }
};

/// Result of a root search.
struct Found {
  double x = 0;
  int iterations = 0;
  bool ok = false;
};

/// Bisection point of a bracket; geometric in the distance to x = -1 or 1 where the distances of its ends
/// differ much.
[[nodiscard]] inline double halfway(double low, double high) {
  if (high == std::numeric_limits<double>::infinity()) return 3 * low + 4;
  const double a = 1 + low, b = 1 + high;
  if (b > 4 * a && b < 2) return (a > 0 ? std::sqrt(a * b) : b / 16) - 1;
  const double c = 1 - low, d = 1 - high;
  if (c > 4 * d && d >= 0) return 1 - (d > 0 ? std::sqrt(c * d) : c / 16);
  if (a > 2 && b > 4 * a) return std::sqrt(a * b) - 1;
  return low + (high - low) / 2;
}

/// Root of T(x) = @p wanted between @p low and @p high, where T decreases (@p falls) or increases, by
/// Householder's iteration of third order from @p x. halfway() replaces an iterate outside the bracket, and
/// every eighth one.
[[nodiscard]] inline Found find_root(const TimeCurve& curve, double wanted, double low, double high, double x,
                                     bool falls) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  if (!(x > low && x < high)) x = halfway(low, high);
  double before = std::numeric_limits<double>::infinity();  // unknown in the first step and after halfway()
  for (int i = 1; i <= 400; ++i) {
    const TimeCurve::At a = curve.at(x);
    const double f = a.t - wanted;
    // converged to the rounding of T and x
    if (std::abs(f) <= eps * (2 * wanted + std::abs(x * a.d1))) return {x, i, true};
    ((f > 0) == falls ? low : high) = x;
    // Ratios of derivatives: products would underflow for fast hyperbolas.
    const double u = f / a.d1, second = u * (a.d2 / a.d1), third = u * u * (a.d3 / a.d1);
    const double change = -u * (1 - second / 2) / (1 - second + third / 6), size = std::abs(change);
    const double next = x + change, scale = eps / 2 * (std::abs(x) + a.y);
    const bool inside = next > low && next < high;
    // Converged if the step is below rounding, if the next one will be by the rate of decrease, or if f is
    // rounding of T.
    if (size <= scale) return {inside ? next : x, i, true};
    const bool shrinks = before < std::numeric_limits<double>::infinity();
    if (inside && shrinks && size * (size / before) <= scale / 16) return {next, i, true};
    if (std::abs(f) <= 64 * eps * wanted && !(size < before / 2)) return {x, i, true};
    if (inside && i % 8 != 0) {
      x = next;
      before = size;
      continue;
    }
    const double middle = halfway(low, high);
    if (!(middle > low && middle < high)) return {x, i, x > -1};
    x = middle;
    before = std::numeric_limits<double>::infinity();
  }
  return {x, 400, false};
}

/// x of the minimum time of flight with at least one revolution, between 0 and 1, by Halley's iteration for
/// T' = 0.
[[nodiscard]] inline Found find_minimum(const TimeCurve& curve, TimeCurve::At& a) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double steep =
      curve.lambda > 0 ? 2 * curve.lambda * curve.lambda * curve.lambda / std::sqrt(curve.complement) : 0;
  double low = 0, high = 1, x = 2 / (3 * curve.middle() + steep);
  for (int i = 1; i <= 400; ++i) {
    a = curve.at(x);
    (a.d1 < 0 ? low : high) = x;
    const double change = -2 * a.d1 * a.d2 / (2 * a.d2 * a.d2 - a.d1 * a.d3);
    double next = x + change;
    // T is flat: an error of sqrt(eps)/10 in x is 1e-18 in T; the tighter tolerance is for d2.
    if (std::abs(change) <= 1e-11 * x || a.d1 == 0) return {x, i, true};
    if (!(next > low && next < high) || i % 8 == 0) next = low + (high - low) / 2;
    if (!(high - low > 4 * eps * high)) return {x, i, true};
    x = next;
  }
  return {x, 400, false};
}

/// Initial guess for no revolution: Izzo's Eq. 30, or the limit for lambda = 1 where that is closer.
[[nodiscard]] inline double single_start(const TimeCurve& curve, double wanted) {
  const double middle = curve.middle(), parabola = curve.parabola(), l = curve.lambda;
  if (wanted >= middle) {
    const double x = std::cbrt(middle / wanted), y = std::cbrt(1 + wanted * wanted / 9.8696044010893586);
    return std::max(x * x - 1, l > 0 ? -std::sqrt(1 - 1 / y) : -1.0);
  }
  if (wanted < parabola) {
    const double below = l > 0 ? curve.complement / (1 + l) : 1 - l;  // 1 - lambda
    const double fifth = below * (1 + l + l * l + l * l * l + l * l * l * l);
    return 2.5 * parabola * (parabola - wanted) / (wanted * fifth) + 1;
  }
  return std::exp2(std::log(middle / wanted) / std::log(middle / parabola)) - 1;
}

/// Outcome of the search for one arc.
enum class Arrived { yes, no_such_arc, lost };

/// x for the arc that takes T = @p wanted.
[[nodiscard]] inline Arrived find_x(const Chord& k, double wanted, int revolutions, LambertBranch branch,
                                    Found& found) {
  constexpr double pi = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();
  // From T = 1e21 on, 1 + x (or 1 - x) has hardly a significant bit; below 1e-150, x^2 overflows.
  if (!(wanted > 1e-150 && wanted < 1e21)) return Arrived::lost;
  const TimeCurve curve{k.lambda, k.complement, revolutions * pi};
  if (revolutions == 0) {
    found = find_root(curve, wanted, -1, infinity, single_start(curve, wanted), true);
    return found.ok ? Arrived::yes : Arrived::lost;
  }
  const bool low = branch == LambertBranch::low;
  if (wanted <= curve.turns + curve.parabola()) return Arrived::no_such_arc;  // T is at least this
  if (wanted >= curve.middle()) {
    const double ratio = low ? (curve.turns + pi) / (8 * wanted) : 8 * wanted / curve.turns;
    const double root = std::cbrt(ratio), square = root * root, x = (square - 1) / (square + 1);
    found = low ? find_root(curve, wanted, -1, 0, x, true) : find_root(curve, wanted, 0, 1, x, false);
    return found.ok ? Arrived::yes : Arrived::lost;
  }
  TimeCurve::At a;
  const Found bottom = find_minimum(curve, a);
  const double above = wanted - a.t;
  if (above < -4 * std::numeric_limits<double>::epsilon() * wanted) return Arrived::no_such_arc;
  found = bottom;
  if (above <= 4 * std::numeric_limits<double>::epsilon() * wanted) return Arrived::yes;
  const double reach = std::sqrt(2 * above / a.d2);
  found = low ? find_root(curve, wanted, 0, bottom.x, bottom.x - reach, true)
              : find_root(curve, wanted, bottom.x, 1, bottom.x + reach, false);
  found.iterations += bottom.iterations;
  return found.ok ? Arrived::yes : Arrived::lost;
}

/// Velocities at both ends of the arc with this x (Izzo, section 3.3).
inline void velocities(const Chord& k, double x, Vector3<double>& v1, Vector3<double>& v2) {
  const double y = std::sqrt(k.complement + k.lambda * k.lambda * x * x), lx = k.lambda * x,
               ly = k.lambda * y;
  const double across = k.speed * k.sigma * (lx < 0 ? k.complement / (y - lx) : y + lx);
  const double ratio1 = k.s / k.r1, ratio2 = k.s / k.r2;
  v1 = (k.speed * ratio1 * (ly * k.minus - x * k.plus)) * k.out1 + (across * ratio1) * k.ahead1;
  v2 = (k.speed * ratio2 * (x * k.minus - ly * k.plus)) * k.out2 + (across * ratio2) * k.ahead2;
}

}  // namespace nlmech::orbit::detail

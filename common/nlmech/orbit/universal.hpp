/// @file
/// Stumpff functions, and Kepler's equation in universal variables, for any number type.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "nlmech/orbit/state.hpp"
#include "nlmech/program/value_of.hpp"

namespace nlmech::orbit {

/// c_n(psi) = sum_{k>=0} (-psi)^k/(2k + n)!, n = 0 to 3.
///
/// Tests check relative errors of c2 and c3 up to 8 eps, errors of c0 and c1 up to 8 eps max(1, |c|), and all
/// to 1e-47 in 50 digits.
template <class T>
struct Stumpff {
  T c0;  ///< cos sqrt(psi), or cosh sqrt(-psi)
  T c1;  ///< sin x/x with x = sqrt(psi), or sinh x/x
  T c2;  ///< (1 - cos x)/x^2, or (cosh x - 1)/x^2
  T c3;  ///< (x - sin x)/x^3, or (sinh x - x)/x^3
};

namespace detail {

/// c_2 and c_3 by their power series. Each Horner step divides by a product of small integers.
template <class T>
[[nodiscard]] Stumpff<T> stumpff_series(const T& psi) {
  using Number = decltype(value_of(psi));
  // The last term is below eps for |psi| <= 4: 4^k/(2k + 2)! falls below 2^-53 at k = 11, 1e-50 at k = 26.
  constexpr int terms = std::numeric_limits<Number>::digits <= 64 ? 12 : 30;
  T c2 = T(1), c3 = T(1);
  for (int k = terms; k >= 1; --k) {
    c2 = 1 - psi * c2 / ((2 * k + 1) * (2 * k + 2));
    c3 = 1 - psi * c3 / ((2 * k + 2) * (2 * k + 3));
  }
  c2 = c2 / 2;
  c3 = c3 / 6;
  return {1 - psi * c2, 1 - psi * c3, c2, c3};
}

/// c_n and c_{n+1} for double and |psi| <= 4, by power series whose last term is below eps: reciprocals of
/// factorials in place of divisions, even and odd terms in four sums that do not wait for each other.
template <std::size_t n>
[[nodiscard]] std::array<double, 2> stumpff_pair(double psi) {
  constexpr std::size_t terms = 14 - n;
  static_assert(terms % 2 == 0);
  static constexpr auto inverse_factorial = [] {
    std::array<double, 28> f = {1};
    double product = 1;  // exact up to 22!; the total rounding error is below one ulp
    for (std::size_t i = 1; i < f.size(); ++i) f[i] = 1 / (product *= static_cast<double>(i));
    return f;
  }();
  const double square = psi * psi;
  double even = inverse_factorial[2 * terms + n], next_even = inverse_factorial[2 * terms + n + 1], odd = 0,
         next_odd = 0;
  for (std::size_t k = terms; k > 0; k -= 2) {
    odd = inverse_factorial[2 * k + n - 2] + square * odd;
    next_odd = inverse_factorial[2 * k + n - 1] + square * next_odd;
    even = inverse_factorial[2 * k + n - 4] + square * even;
    next_even = inverse_factorial[2 * k + n - 3] + square * next_even;
  }
  return {even - psi * odd, next_even - psi * next_odd};
}

[[nodiscard]] inline Stumpff<double> stumpff_series(double psi) {
  const auto [c2, c3] = stumpff_pair<2>(psi);
  return {1 - psi * c2, 1 - psi * c3, c2, c3};
}

}  // namespace detail

/// Stumpff functions for any finite @p psi, without cancellation: by power series for |psi| <= 4, else by
/// functions of the half argument. Relative errors of c_2 and c_3 are at most 8 eps for psi <= pi^2 (the
/// range of propagate_kepler(), which subtracts whole revolutions); infinite where cosh overflows.
template <class T>
[[nodiscard]] Stumpff<T> stumpff(const T& psi) {
  using std::cos;
  using std::cosh;
  using std::sin;
  using std::sinh;
  using std::sqrt;
  const auto value = value_of(psi);
  if (value <= 4 && value >= -4) return detail::stumpff_series(psi);
  if (value > 0) {
    const T x = sqrt(psi), s = sin(x / 2), c = cos(x / 2), sine = 2 * s * c;
    return {1 - 2 * s * s, sine / x, 2 * s * s / psi, (x - sine) / (psi * x)};
  }
  const T x = sqrt(-psi), s = sinh(x / 2), c = cosh(x / 2), sine = 2 * s * c;
  return {1 + 2 * s * s, sine / x, -2 * s * s / psi, (x - sine) / (psi * x)};
}

namespace detail {

/// Kepler motion from a state, in the units |r_0| = 1 and mu = 1. The universal variable s satisfies ds/dt =
/// 1/r;
///
///     t = U_1 + sigma U_2 + U_3,   r = U_0 + sigma U_1 + U_2,   U_n = s^n c_n(alpha s^2)
///
/// with sigma = r_0.v_0 and alpha = 1/a (R. H. Battin, An introduction to the mathematics and methods of
/// astrodynamics, AIAA 1999, section 4.5). t increases with s for every conic, so the root is unique.
template <class T>
struct Universal {
  T alpha;  ///< 1/a
  T sigma;  ///< r_0.v_0

  /// All quantities at one s.
  struct At {
    T s, u0, u1, u2, u3;
    T time, r;
    T slope;  ///< dr/ds
  };
  [[nodiscard]] At at(const T& s) const {
    const Stumpff<T> c = stumpff(T(alpha * s * s));
    const T u1 = s * c.c1, u2 = s * s * c.c2, u3 = s * s * s * c.c3;
    return {
        s, c.c0, u1, u2, u3, u1 + sigma * u2 + u3, c.c0 + sigma * u1 + u2, sigma * c.c0 + (1 - alpha) * u1};
  }
};

/// Universal variable of a position, measured from the periapsis, in the units |r_0| = 1 and mu = 1.
/// @param e eccentricity; not read for ellipses, and positive for other conics
template <class T>
[[nodiscard]] T variable_since_periapsis(const T& alpha, const T& sigma, const T& e) {
  using std::asinh;
  using std::atan2;
  using std::sqrt;
  if (alpha > 0) {
    const T k = sqrt(alpha);
    return atan2(T(sigma * k), T(1 - alpha)) / k;  // e sin E and e cos E
  }
  if (!(alpha < 0)) return sigma / e;
  const T k = sqrt(T(-alpha));
  return asinh(T(sigma * k / e)) / k;
}

/// Result of solve().
template <class T>
struct Solved {
  typename Universal<T>::At at;  ///< quantities at the root
  int iterations = 0;            ///< number of evaluations
};

/// Initial guess of the root at time @p t > 0.
template <class T>
[[nodiscard]] T guess(const Universal<T>& u, const T& t) {
  using std::log;
  using std::pow;
  using std::sqrt;
  if (u.alpha > 0) return t * u.alpha;  // M in place of E: error at most e
  // s + s^3/6 = t, the parabola from its vertex; less on a hyperbola far out: t ~ (e/2) exp(..).
  const T w = 3 * t + (t < T(1e10) ? T(sqrt(8 + 9 * t * t)) : 3 * t), root = pow(w, T(1) / 3);
  T s = root - 2 / root;
  if (u.alpha < 0) {
    const T k = sqrt(T(-u.alpha)), far = 2 * t * k * -u.alpha / (u.sigma * k + 1 - u.alpha);
    if (far > 1) s = std::min(s, T(log(far) / k));
  }
  return s;
}

/// The root at time @p t, of either sign, by Laguerre's iteration with n = 5 (B. A. Conway, An improved
/// algorithm due to Laguerre for the solution of Kepler's equation, Celest. Mech. 39 (1986) 199-211)
/// safeguarded by a bracket: bisection replaces an iterate outside it, and every eighth one, so the iteration
/// ends for every orbit. Ellipses need 3 to 7 evaluations.
template <class T>
[[nodiscard]] Solved<T> solve(const Universal<T>& forwards, const T& time) {
  using std::abs;
  using std::pow;
  using std::sqrt;
  const T eps = std::numeric_limits<T>::epsilon();
  const bool back = time < 0;
  const Universal<T> u{forwards.alpha, back ? T(-forwards.sigma) : forwards.sigma};
  const T t = abs(time);
  // Laguerre's iteration is cubic: errors in units of s, and of the scale r/r' on which r changes.
  static const T enough = pow(eps, T(2) / 5), straight = pow(eps, T(1) / 3);
  const auto converged = [&](const T& from, const T& to, const auto& at) {
    const T change = abs(to - from);
    return change <= enough * from && change * abs(at.slope) <= straight * at.r;
  };
  T low = 0, high = u.alpha > 0 ? T(8 / sqrt(u.alpha)) : std::numeric_limits<T>::infinity();  // E < 8
  Solved<T> found;
  T s = std::min(guess(u, t), high);
  bool settled = t == 0;
  if (settled) s = 0;
  for (;; ++found.iterations) {
    auto& at = found.at = u.at(s);
    if (settled || found.iterations > 8 * std::numeric_limits<T>::digits) break;
    const T miss = at.time - t;
    if (miss == 0) break;
    (miss < 0 ? low : high) = s;
    const T under = 16 * at.r * at.r - 20 * miss * at.slope;
    T next = s - 5 * miss / (at.r + sqrt(abs(under)));
    const bool inside = next > low && next < high;
    if (!inside || found.iterations % 8 == 7) {
      if (inside && converged(s, next, at)) {
        settled = true;  // converged, no bisection needed
      } else if (high < std::numeric_limits<T>::infinity()) {
        next = low + (high - low) / 2;
        settled = next == low || next == high || high - low <= eps * high;
      } else {
        next = 2 * s + t;
      }
    } else {
      settled = converged(s, next, at);
    }
    s = next;
  }
  if (back) {
    auto& at = found.at;
    at.s = -at.s, at.u1 = -at.u1, at.u3 = -at.u3, at.time = -at.time, at.slope = -at.slope;
  }
  return found;
}

/// Subtracts whole revolutions of an ellipse from @p time; the result is at most half a period. @p turns
/// receives their number.
template <class T>
[[nodiscard]] T within_one_turn(const T& alpha, const T& time, T& turns) {
  using std::acos;
  using std::round;
  using std::sqrt;
  turns = T(0);
  if (!(alpha > 0)) return time;
  const T period = 2 * acos(T(-1)) / (alpha * sqrt(alpha));
  turns = round(T(time / period));
  if (turns == 0) return time;
  if constexpr (std::is_floating_point_v<T>) {
    return std::fma(-turns, period, time);
  } else {
    return time - turns * period;
  }
}

}  // namespace detail

}  // namespace nlmech::orbit

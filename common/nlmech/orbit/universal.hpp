/// @file
/// Kepler's equation in universal variables, for any type of number.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "nlmech/orbit/state.hpp"
#include "nlmech/orbit/stumpff.hpp"

namespace nlmech::orbit::detail {

/// The motion from a state, in the units |r_0| = 1 and mu = 1. The universal variable s has ds/dt = 1/r;
///
///     t = U_1 + sigma U_2 + U_3,   r = U_0 + sigma U_1 + U_2,   U_n = s^n c_n(alpha s^2)
///
/// with sigma = r_0.v_0 and alpha = 1/a (R. H. Battin, An introduction to the mathematics and methods of
/// astrodynamics, AIAA 1999, section 4.5). t grows with s for every conic, so the root is the only one.
template <class T>
struct Universal {
  T alpha;  ///< 1/a
  T sigma;  ///< r_0.v_0

  /// Everything at one s.
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

/// The universal variable of a position, counted from the periapsis, in the units |r_0| = 1 and mu = 1.
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

/// Where a search for the root stands.
template <class T>
struct Solved {
  typename Universal<T>::At at;  ///< at the root
  int iterations = 0;            ///< evaluations
};

/// A start for the root at time @p t > 0.
template <class T>
[[nodiscard]] T guess(const Universal<T>& u, const T& t) {
  using std::log;
  using std::pow;
  using std::sqrt;
  if (u.alpha > 0) return t * u.alpha;  // M in place of E: off by e at most
  // s + s^3/6 = t, the parabola from its vertex; less where the hyperbola has bent away: t ~ (e/2) exp(..).
  const T w = 3 * t + (t < T(1e10) ? T(sqrt(8 + 9 * t * t)) : 3 * t), root = pow(w, T(1) / 3);
  T s = root - 2 / root;
  if (u.alpha < 0) {
    const T k = sqrt(T(-u.alpha)), far = 2 * t * k * -u.alpha / (u.sigma * k + 1 - u.alpha);
    if (far > 1) s = std::min(s, T(log(far) / k));
  }
  return s;
}

/// The root at time @p t, of either sign, by Laguerre's iteration with n = 5 (B. A. Conway, An improved
/// algorithm due to Laguerre for the solution of Kepler's equation, Celest. Mech. 39 (1986) 199-211) between
/// bounds that close in on it: an iterate that leaves them, or every eighth one, is replaced by the middle,
/// so that the search ends for every orbit. Ellipses cost 3 to 7 evaluations.
template <class T>
[[nodiscard]] Solved<T> solve(const Universal<T>& forwards, const T& time) {
  using std::abs;
  using std::pow;
  using std::sqrt;
  const T eps = std::numeric_limits<T>::epsilon();
  const bool back = time < 0;
  const Universal<T> u{forwards.alpha, back ? T(-forwards.sigma) : forwards.sigma};
  const T t = abs(time);
  // Laguerre's next error is the cube of this one, in units of s and of the length r/r' on which r changes.
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
        settled = true;  // converged: no need of the middle
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

/// @p time less whole revolutions of an ellipse, by which it becomes half a period at most. @p turns: how
/// many.
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

}  // namespace nlmech::orbit::detail

/// @file
/// Kepler's problem solved in closed form, by Lagrange's F and G in universal variables, for every conic.
#pragma once

#include <cmath>

#include "nlmech/orbit/universal.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::orbit {

/// Lagrange's coefficients: r = F r_0 + G v_0, v = F' r_0 + G' v_0, and F G' - G F' = 1.
template <class T>
struct LagrangeCoefficients {
  T f;             ///< F
  T g;             ///< G, a time
  T f_rate;        ///< dF/dt, 1/time
  T g_rate;        ///< dG/dt
  int iterations;  ///< evaluations of Kepler's equation; at least 1
};

/// The coefficients for the state @p s after @p time of either sign, in any type of number with the usual
/// functions. Ellipses, parabolas, hyperbolas and straight lines; whole revolutions are left out first, so
/// that their number costs nothing. A straight line passes through the centre as the limit of thin ellipses
/// does: it returns.
/// @param s finite, position not 0; not checked  @param mu positive; not checked
template <class T>
[[nodiscard]] LagrangeCoefficients<T> lagrange_coefficients(const BasicState<T>& s, const T& time,
                                                            const T& mu) {
  using std::sqrt;
  const T r0 = sqrt(s.position.dot(s.position)), speed = sqrt(mu / r0), rate = speed / r0;
  const Vector3<T> direction = s.position / r0, v = s.velocity / speed;  // no overflow in what follows
  const detail::Universal<T> u{2 - v.dot(v), direction.dot(v)};
  T turns;
  const T t = detail::within_one_turn(u.alpha, T(time * rate), turns);
  const auto [at, iterations] = detail::solve(u, t);
  return {1 - at.u2, (at.u1 + u.sigma * at.u2) / rate, -at.u1 / at.r * rate, 1 - at.u2 / at.r,
          iterations + 1};
}

/// The state that the coefficients lead to.
template <class T>
[[nodiscard]] BasicState<T> moved(const BasicState<T>& s, const LagrangeCoefficients<T>& c) {
  return {c.f * s.position + c.g * s.velocity, c.f_rate * s.position + c.g_rate * s.velocity};
}

namespace detail {

/// A hyperbola that is entered from far, where the terms of F and G cancel: times are counted from the
/// periapsis, t_p = r_p s + e s^3 c_3, in which nothing does. On a fast one s k, k = (-alpha)^(1/2), is the
/// logarithm of a large number, so that s in double precision is not exact enough; what it is off by is
/// carried as a small number beside. Units as in Universal. Nothing is divided by the angular momentum, so
/// that straight lines have derivatives too.
template <class T>
struct Flyby {
  Vector3<T> direction, across;  ///< along r_0, and the part of the velocity across it
  T alpha, sigma;                ///< 1/a and r_0.v_0
  T p, e, rp;                    ///< semi-latus rectum, eccentricity, distance of the periapsis

  /// @param towards along r_0, a unit vector  @param v the velocity
  Flyby(const Vector3<T>& towards, const Vector3<T>& v)
      : direction(towards), alpha(2 - v.dot(v)), sigma(towards.dot(v)) {
    using std::sqrt;
    across = v - sigma * direction;
    p = across.dot(across);
    const T x = p - 1;
    const auto size = 1 + value_of(v.dot(v));  // e is less; its square may not be a double
    e = size < 1e60 ? sqrt(x * x + sigma * sigma * p)
                    : size * sqrt((x / size) * (x / size) + (sigma / size * sigma) * (p / size));
    rp = p / (1 + e);
  }

  /// Everything at one s.
  struct At {
    T time, r;       ///< since the periapsis; distance
    T radial, rise;  ///< r.v = dr/ds, and its derivative
  };
  [[nodiscard]] At at(const T& s) const {
    const Stumpff<T> c = stumpff(T(alpha * s * s));
    return {rp * s + e * s * s * s * c.c3, rp + e * s * s * c.c2, e * s * c.c1, e * c.c0};
  }
  /// s at r_0, rounded.
  [[nodiscard]] T begin() const { return variable_since_periapsis(alpha, sigma, e); }
  /// Time of r_0 since the periapsis, @p s being begin(): what that is off by is seen in r.v.
  [[nodiscard]] T begin_time(const T& s) const {
    const At a = at(s);
    return a.time + a.r * (sigma - a.radial) / a.rise;
  }
  /// s at a time since the periapsis, rounded. Kepler's equation from the periapsis is the universal one with
  /// r_0 = r_p and sigma = 0: in the unit r_p it would be singular for straight lines, so it is solved here,
  /// by Newton's iteration on a function without inflection for s > 0, from beyond the root.
  [[nodiscard]] T at_time(const T& wanted) const {
    using std::abs;
    using std::asinh;
    using std::sqrt;
    const T k = sqrt(-alpha), goal = abs(wanted);
    // From e (sinh H - H) <= N: H is at most asinh(N/e) plus asinh of what that leaves out.
    const T n = goal * k * -alpha;
    T s = (asinh(T(n / e)) + asinh(T(asinh(T(n / e)) / e)) + 1) / k;
    for (int i = 0; i < 200; ++i) {
      const At a = at(s);
      const T next = s - (a.time - goal) / a.r;
      if (!(next < s)) break;  // monotone until rounding
      s = next;
    }
    return wanted < 0 ? T(-s) : s;
  }
  /// The state at the time @p wanted since the periapsis, @p s being at_time(wanted) or its value alone.
  /// Directions by cos nu = p/(e r) - 1/e and sin nu/p^(1/2) = (dr/dt)/e.
  [[nodiscard]] BasicState<T> state(const T& s, const T& wanted) const {
    const At a = at(s);
    const T off = (wanted - a.time) / a.r, r = a.r + a.radial * off, speed = (a.radial + a.rise * off) / r;
    const T share = p / e, cosine0 = share - 1 / e, sine0 = sigma / e, cosine = share / r - 1 / e,
            sine = speed / e;
    const T turn = cosine * cosine0 + p * sine * sine0, lift = sine * cosine0 - cosine * sine0;
    const Vector3<T> outwards = turn * direction + lift * across,
                     forwards = turn * across - (p * lift) * direction;
    return {r * outwards, speed * outwards + forwards / r};
  }
};

}  // namespace detail

/// The state that Kepler's motion leads to, in any type of number: by Lagrange's coefficients, or, where
/// their terms would cancel (a hyperbola integrated towards its periapsis) or hold exponentials of large
/// numbers (one integrated a million distances away), by anomalies. Arguments as of lagrange_coefficients().
template <class T>
[[nodiscard]] BasicState<T> kepler_state(const BasicState<T>& s, const T& time, const T& mu,
                                         int* evaluations = nullptr) {
  using std::sqrt;
  const T r0 = sqrt(s.position.dot(s.position)), speed = sqrt(mu / r0);
  const Vector3<T> direction = s.position / r0, v = s.velocity / speed;
  const T away = time * speed / r0;
  if (v.dot(v) > 3 && (direction.dot(v) * time < 0 || v.dot(v) * away * away > T(1e12))) {
    const detail::Flyby<T> flyby(direction, v);
    const T wanted = flyby.begin_time(flyby.begin()) + away;
    const BasicState<T> end = flyby.state(flyby.at_time(wanted), wanted);
    return {r0 * end.position, speed * end.velocity};
  }
  const auto c = lagrange_coefficients(s, time, mu);
  if (evaluations != nullptr) *evaluations = c.iterations;
  return moved(s, c);
}

/// A state on a conic.
struct KeplerSolution {
  State state;  ///< at the asked time; the given one after a failure
  /// success; `collision` if the body is in the centre at that very time; `outside_validity` if the rounding
  /// of the data leaves the place undetermined (64 kappa eps >= 1, not one digit: too many revolutions, or a
  /// passage so near the centre that its side is not known), or if the state at that time is beyond the range
  /// of doubles
  Status status;
  int iterations = 0;  ///< evaluations of Kepler's equation; 0 on hyperbolas integrated inwards
};

/// Moves @p start by @p time, of either sign, on its conic. The error is at most 8 kappa eps of |r| and |v|,
/// kappa from kepler_condition(): the data themselves, rounded to double precision, say no more (tests hold
/// it to Kepler's equation solved in 50 digits, over ellipses, parabolas, hyperbolas and straight lines, and
/// a million revolutions). No success where 64 kappa eps >= 1 for the position or
/// for the mean anomaly of an ellipse. Any units: what is far from 1
/// is scaled by powers of two.
/// @throws std::invalid_argument for a position 0, mu not positive, or anything not finite
[[nodiscard]] KeplerSolution propagate_kepler(const State& start, double time, double mu);

/// How relative errors of the data grow on the way.
struct KeplerCondition {
  double position = 0;  ///< of |r|, relative
  double velocity = 0;  ///< of |v|, relative
};

/// kappa = sum over the data d of |d(result)/d(d)| |d|/|result|, d the components of position and velocity
/// (each with the length of its vector), mu and the time. It grows linearly with the number of revolutions,
/// because an error of the velocity changes the period. Derivatives by dual numbers: to 0.1 %, or that of
/// data changed by 8 eps (random tests hold it to differences in 100 digits, up to 1e12); finite on every
/// conic, straight lines and the fastest flybys included; infinite where it is no double (a body more than
/// 1e150 times as fast as a circular orbit, or in the centre).
/// @throws std::invalid_argument as propagate_kepler
[[nodiscard]] KeplerCondition kepler_condition(const State& start, double time, double mu);

/// kappa from which on not one digit of a position is left: its error may be 8 kappa eps, an eighth then.
inline constexpr double no_digit = 1 / (64 * std::numeric_limits<double>::epsilon());

/// kappa of the position @p end, or of the mean anomaly of an ellipse if that is larger, if it is @p least or
/// more; else 0. Costs little where kappa is far below. propagate_kepler() refuses what this gives for
/// no_digit, whatever the conic.
/// @param end where the motion is known to be after @p time
/// @throws std::invalid_argument as propagate_kepler
[[nodiscard]] double large_condition(const State& start, const State& end, double time, double mu,
                                     double least = no_digit);

}  // namespace nlmech::orbit

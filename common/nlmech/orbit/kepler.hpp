/// @file
/// Solution of Kepler's problem by Lagrange's F and G in universal variables, for every conic.
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

/// Coefficients for the state @p s after @p time of either sign, in any number type with the usual functions,
/// for ellipses, parabolas, hyperbolas and straight lines. Whole revolutions are subtracted first, so their
/// number does not affect the cost. A body on a straight line returns from the centre, as in the limit of
/// thin ellipses.
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

/// The state given by Lagrange's coefficients.
template <class T>
[[nodiscard]] BasicState<T> moved(const BasicState<T>& s, const LagrangeCoefficients<T>& c) {
  return {c.f * s.position + c.g * s.velocity, c.f_rate * s.position + c.g_rate * s.velocity};
}

namespace detail {

/// Hyperbola entered from far away, where the terms of F and G cancel. Times are measured from the periapsis,
/// t_p = r_p s + e s^3 c_3, without cancellation. On a fast hyperbola s k, k = (-alpha)^(1/2), is the
/// logarithm of a large number, and s in double precision is not accurate enough; its error is stored as a
/// small correction. Units as in Universal. There is no division by the angular momentum, so straight lines
/// have derivatives too.
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
    const auto size = 1 + value_of(v.dot(v));  // bound of e, whose square may overflow
    e = size < 1e60 ? sqrt(x * x + sigma * sigma * p)
                    : size * sqrt((x / size) * (x / size) + (sigma / size * sigma) * (p / size));
    rp = p / (1 + e);
  }

  /// All quantities at one s.
  struct At {
    T time, r;       ///< time since the periapsis; distance
    T radial, rise;  ///< r.v = dr/ds, and its derivative
  };
  [[nodiscard]] At at(const T& s) const {
    const Stumpff<T> c = stumpff(T(alpha * s * s));
    return {rp * s + e * s * s * s * c.c3, rp + e * s * s * c.c2, e * s * c.c1, e * c.c0};
  }
  /// s at r_0, with rounding error.
  [[nodiscard]] T begin() const { return variable_since_periapsis(alpha, sigma, e); }
  /// Time of r_0 since the periapsis, for @p s = begin(); its rounding error is corrected by r.v.
  [[nodiscard]] T begin_time(const T& s) const {
    const At a = at(s);
    return a.time + a.r * (sigma - a.radial) / a.rise;
  }
  /// s at a time since the periapsis, with rounding error. Kepler's equation from the periapsis is the
  /// universal one with r_0 = r_p and sigma = 0; in the unit r_p it is singular for straight lines. It is
  /// solved here by Newton's iteration on a function without inflection for s > 0, from above the root.
  [[nodiscard]] T at_time(const T& wanted) const {
    using std::abs;
    using std::asinh;
    using std::sqrt;
    const T k = sqrt(-alpha), target = abs(wanted);
    // From e (sinh H - H) <= N: upper bound of H by asinh(N/e) and one correction.
    const T n = target * k * -alpha;
    T s = (asinh(T(n / e)) + asinh(T(asinh(T(n / e)) / e)) + 1) / k;
    for (int i = 0; i < 200; ++i) {
      const At a = at(s);
      const T next = s - (a.time - target) / a.r;
      if (!(next < s)) break;  // monotone up to rounding
      s = next;
    }
    return wanted < 0 ? T(-s) : s;
  }
  /// State at the time @p wanted since the periapsis, for @p s = at_time(wanted) or its plain value.
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

/// Does kepler_state() use Flyby for the speed v.v = @p vv, the radial velocity @p sigma and the time @p
/// away? Units as in Universal.
template <class T>
[[nodiscard]] bool is_flyby(const T& vv, const T& sigma, const T& away) {
  return vv > 3 && (sigma * away < 0 || vv * away * away > T(1e12));
}

}  // namespace detail

/// State after Kepler motion, in any number type: by Lagrange's coefficients, or by Flyby where their terms
/// cancel (a hyperbola towards its periapsis) or contain exponentials of large numbers (a hyperbola to a
/// million distances). Arguments as of lagrange_coefficients().
template <class T>
[[nodiscard]] BasicState<T> kepler_state(const BasicState<T>& s, const T& time, const T& mu,
                                         int* evaluations = nullptr) {
  using std::sqrt;
  const T r0 = sqrt(s.position.dot(s.position)), speed = sqrt(mu / r0);
  const Vector3<T> direction = s.position / r0, v = s.velocity / speed;
  const T away = time * speed / r0;
  if (detail::is_flyby(T(v.dot(v)), T(direction.dot(v)), away)) {
    const detail::Flyby<T> flyby(direction, v);
    const T wanted = flyby.begin_time(flyby.begin()) + away;
    const BasicState<T> end = flyby.state(flyby.at_time(wanted), wanted);
    return {r0 * end.position, speed * end.velocity};
  }
  const auto c = lagrange_coefficients(s, time, mu);
  if (evaluations != nullptr) *evaluations = c.iterations;
  return moved(s, c);
}

/// Result of propagate_kepler().
struct KeplerSolution {
  State state;  ///< state at the requested time; the initial one after a failure
  /// success; `collision` if the body is in the centre at that time; `outside_validity` if rounding of the
  /// data leaves the position undetermined (64 kappa eps >= 1, no correct digit: too many revolutions, or a
  /// passage so near the centre that its side is unknown), or if the state at that time is beyond the range
  /// of doubles
  Status status;
  int iterations = 0;  ///< evaluations of Kepler's equation; 0 on hyperbolas integrated inwards
};

/// Propagates @p start by @p time, of either sign, on its conic. The error is at most 8 kappa eps of |r| and
/// |v| with the condition number kappa of kepler_condition(), the size of the effect of rounding the data
/// (tests compare with Kepler's equation in 50 digits, for ellipses, parabolas, hyperbolas and straight
/// lines, and a million revolutions). No success where 64 kappa eps >= 1 for the position or for the mean
/// anomaly of an ellipse. Any units: extreme values are scaled by powers of two.
/// @throws std::invalid_argument for a position 0, mu not positive, or anything not finite
[[nodiscard]] KeplerSolution propagate_kepler(const State& start, double time, double mu);

/// Partial derivatives of a state by the initial one; rows and columns x, y, z, vx, vy, vz.
using TransitionMatrix = Matrix<double, 6>;

/// Result of kepler_transition().
struct KeplerTransition {
  State state;  ///< state at the requested time, that of propagate_kepler(); the initial one after a failure
  TransitionMatrix transition =
      TransitionMatrix::Identity();                     ///< state-transition matrix d(state)/d(initial state)
  Vector<double, 6> by_mu = Vector<double, 6>::Zero();  ///< d(state)/d(mu)
  Vector<double, 6> by_time = Vector<double, 6>::Zero();  ///< d(state)/d(time): velocity and acceleration
  Status status = {};  ///< as of propagate_kepler(); `outside_validity` too if a derivative overflows
};

/// propagate_kepler() with the derivatives of the state in closed form, for every conic, straight lines
/// included, at any number of revolutions: by the derivatives of universal functions, d(U_n)/d(alpha) =
/// (n U_{n+2} - s U_{n+1})/2 (R. H. Battin, An introduction to the mathematics and methods of astrodynamics,
/// AIAA 1999, section 4.6); by dual numbers deep towards the periapsis of a hyperbola.
///
/// Random tests compare with derivatives in 100 digits: errors of the four blocks and of both vectors are at
/// most 16 (1 + kappa) eps of their norms, 8 in all but a few of 10 000 random conics, with the condition
/// numbers kappa of these by all data. For a body that approaches the centre faster than 40 times the
/// circular speed v_c they are at most 0.01 (v/v_c)^2 (1 + kappa) eps: where gravity hardly bends the path,
/// its effect is a difference of large terms.
/// @throws std::invalid_argument as propagate_kepler
[[nodiscard]] KeplerTransition kepler_transition(const State& start, double time, double mu);

/// Condition numbers of Kepler's problem: growth of relative errors of the data.
struct KeplerCondition {
  double position = 0;  ///< condition number of the position, relative to |r|
  double velocity = 0;  ///< condition number of the velocity, relative to |v|
};

/// Condition number kappa = sum over the data d of |d(result)/d(d)| |d|/|result|; d are the components of
/// position and velocity (each with the norm of its vector), mu and the time. It grows linearly with the
/// number of revolutions, because an error of the velocity changes the period. Derivatives to 0.1 %, or equal
/// to that of data changed by 8 eps (random tests compare with differences in 100 digits, up to 1e12). Finite
/// on every conic, including straight lines and the fastest flybys; infinite where it overflows (a body more
/// than 1e150 times as fast as a circular orbit, or in the centre).
/// @throws std::invalid_argument as propagate_kepler
[[nodiscard]] KeplerCondition kepler_condition(const State& start, double time, double mu);

/// kappa above which a position has no correct digit: its error bound 8 kappa eps is then 1/8.
inline constexpr double no_digit = 1 / (64 * std::numeric_limits<double>::epsilon());

/// kappa of the position @p end, or of the mean anomaly of an ellipse if larger, if it is at least @p least;
/// else 0. Cheap where kappa is far below. propagate_kepler() fails where it is not 0 for no_digit, for every
/// conic.
/// @param end known state after @p time
/// @throws std::invalid_argument as propagate_kepler
[[nodiscard]] double large_condition(const State& start, const State& end, double time, double mu,
                                     double least = no_digit);

}  // namespace nlmech::orbit

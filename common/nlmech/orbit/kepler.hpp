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

/// A state on a conic.
struct KeplerSolution {
  State state;         ///< at the asked time; the given one after a failure
  Status status;       ///< success, or `collision` if the body is in the centre at that very time
  int iterations = 0;  ///< evaluations of Kepler's equation
};

/// Moves @p start by @p time, of either sign, on its conic. The error is at most 8 kappa eps of |r| and |v|,
/// kappa from kepler_condition(): the data themselves, rounded to double precision, say no more (tests hold
/// it to Kepler's equation solved in 50 digits, over ellipses, parabolas, hyperbolas and straight lines, and
/// a million revolutions).
/// @throws std::invalid_argument for a position 0, mu not positive, or anything not finite
[[nodiscard]] KeplerSolution propagate_kepler(const State& start, double time, double mu);

/// How relative errors of the data grow on the way.
struct KeplerCondition {
  double position = 0;  ///< of |r|, relative
  double velocity = 0;  ///< of |v|, relative
};

/// kappa = sum over the data d of |d(result)/d(d)| |d|/|result|, d the components of position and velocity
/// (each with the length of its vector), mu and the time. It grows linearly with the number of revolutions,
/// because an error of the velocity changes the period. Derivatives by dual numbers, exact to rounding.
/// @throws std::invalid_argument as propagate_kepler
[[nodiscard]] KeplerCondition kepler_condition(const State& start, double time, double mu);

}  // namespace nlmech::orbit

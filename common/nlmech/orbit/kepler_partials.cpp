#include "nlmech/orbit/kepler_partials.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "nlmech/program/dual.hpp"

namespace nlmech::orbit::detail {
namespace {

/// With the derivatives by position, velocity and mu.
using D = Dual<double, 7>;

/// State at the end of a flyby with its derivatives, in units of r_0. The roots are computed in double; the
/// correction of their error has the derivatives.
BasicState<D> flyby_with_derivatives(const Vector3<D>& direction, const Vector3<D>& v, const D& time) {
  const Flyby<D> flyby(direction, v);
  Vector3<double> plain_direction, plain_v;
  for (int i = 0; i < 3; ++i) {
    plain_direction[i] = direction[i].value;
    plain_v[i] = v[i].value;
  }
  const Flyby<double> plain(plain_direction, plain_v);
  const D wanted = flyby.begin_time(D(plain.begin())) + time;
  return flyby.state(D(plain.at_time(wanted.value)), wanted);
}

/// A fast body approaching the centre, by universal variables. The small k + sigma = (p - 2)/(k - sigma) is
/// separated from the sums, so that nothing cancels. Units and times as in Universal.
template <class T>
struct Approach {
  T k;       ///< (-alpha)^(1/2)
  T excess;  ///< k + sigma

  /// All quantities at one s, as in Universal.
  struct At {
    T time;        ///< time since r_0
    T r;           ///< distance
    T u1, u2, u3;  ///< U_n
  };
  [[nodiscard]] At at(const T& s) const {
    using std::exp;
    const T x = k * s, decay = exp(T(-x));
    const Stumpff<T> c = stumpff(T(-x * x));
    const T u1 = s * c.c1, u2 = s * s * c.c2, u3 = s * s * s * c.c3;
    return {(1 - decay) / k + excess * u2 + u3, decay + excess * u1 + u2, u1, u2, u3};
  }
  /// s at a time, to the square root of rounding, by Newton's iteration from a lower bound: x grows by at
  /// most 1 per step, up to 36 for the double nearest to the centre.
  [[nodiscard]] T at_time(const T& wanted) const {
    T s = wanted, change = s;
    for (int i = 0; i < 100 && std::abs(change) * k > 1e-8; ++i) {
      const At a = at(s);
      change = (wanted - a.time) / a.r;
      s += change;
    }
    return s;
  }
};

/// Lagrange's coefficients of an approach with their derivatives, in units of r_0.
LagrangeCoefficients<D> approach_with_derivatives(const Vector3<D>& direction, const Vector3<D>& v,
                                                  const D& time) {
  const double sign = time.value < 0 ? -1 : 1;
  const D sigma = sign * direction.dot(v), t = sign * time, k = sqrt(v.dot(v) - 2);
  const Vector3<D> across = v - sign * sigma * direction;
  const Approach<D> approach{k, (across.dot(across) - 2) / (k - sigma)};
  const D s = Approach<double>{k.value, approach.excess.value}.at_time(t.value);
  auto at = approach.at(s);
  at = approach.at(s + (t - at.time) / at.r);
  return {1 - at.u2, sign * (t - at.u3), -sign * at.u1 / at.r, 1 - at.u2 / at.r, 0};
}

/// Is an incoming hyperbola nearly straight up to the end? There derivatives from the periapsis cancel by the
/// factor v^2 by which its eccentricity depends on the data. On a straight line the part 1 - |v t| of the
/// distance remains; gravity deflects it by 1/(v^2 (1 - |v t|)), less than v^(-1/2)/8 here.
bool is_approach(double speed, double time) {
  return (1 - speed * std::abs(time)) * speed * std::sqrt(speed) > 8;
}

/// Derivatives by dual numbers on a hyperbola for which kepler_state() uses Flyby; before the
/// passage of a fast body without the periapsis.
void by_dual_numbers(const State& start, double time, double mu, KeplerTransition& k) {
  BasicState<D> s;
  for (int i = 0; i < 3; ++i) {
    s.position[i] = D::variable(start.position[i], i);
    s.velocity[i] = D::variable(start.velocity[i], 3 + i);
  }
  const D r0 = sqrt(s.position.dot(s.position)), speed = sqrt(D::variable(mu, 6) / r0), rate = speed / r0;
  const Vector3<D> direction = s.position / r0, v = s.velocity / speed;
  const D t = time * rate;
  BasicState<D> end;
  if (direction.dot(v).value * time < 0 && is_approach(std::sqrt(v.dot(v).value), t.value)) {
    LagrangeCoefficients<D> c = approach_with_derivatives(direction, v, t);
    c.g /= rate, c.f_rate *= rate;
    end = moved(s, c);
  } else {
    end = flyby_with_derivatives(direction, v, t);
    end = {r0 * end.position, speed * end.velocity};
  }
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto& partial = (i < 3 ? end.position[i] : end.velocity[i - 3]).partial;
    for (std::size_t j = 0; j < 6; ++j) k.transition(i, static_cast<Eigen::Index>(j)) = partial[j];
    k.by_mu[i] = partial[6];
  }
}

/// Universal functions at the end of a motion and their derivatives by alpha, in the units |r_0| = 1 and mu =
/// 1 of Universal; the time of whole revolutions is subtracted.
struct Ended {
  Vector3<double> d, w;          ///< initial position and velocity
  double alpha, sigma;           ///< 2 - w.w and d.w
  double t = 0, turns_time = 0;  ///< time without whole revolutions; time of these
  Universal<double>::At at;      ///< U_n and r
  double a0, a1, a2, a3;         ///< dU_n/dalpha = (n U_{n+2} - s U_{n+1})/2, or as refine() says

  /// With `at` as kepler_state() has it.
  Ended(const Vector3<double>& position, const Vector3<double>& velocity, double time)
      : d(position), w(velocity), alpha(2 - w.dot(w)), sigma(d.dot(w)) {
    const Universal<double> u{alpha, sigma};
    double turns = 0;
    t = within_one_turn(alpha, time, turns);
    if (turns != 0) turns_time = turns * (2 * std::numbers::pi) / (alpha * std::sqrt(alpha));
    at = solve(u, t).at;
  }
  /// Corrects s to first order, whose rounding far out on a hyperbola is multiplied by (-alpha)^(1/2) s, up
  /// to 80, in U_n; and computes a0 to a3. There they are derivatives at constant alpha s^2: at constant s
  /// they would cancel in the derivatives at constant time, by the same factor.
  void refine() {
    double ds = (t - at.time) / at.r;
    if (!(std::abs(ds) <= 1e-6 * std::abs(at.s))) ds = 0;  // beyond 1e18 turns t has no digit
    const double u0 = at.u0, u1 = at.u1;
    at.s += ds;
    at.u3 += at.u2 * ds;
    at.u2 += u1 * ds;
    at.u1 += u0 * ds;
    at.u0 -= alpha * u1 * ds;
    at.r += at.slope * ds;
    at.slope = sigma * at.u0 + (1 - alpha) * at.u1;
    const double s = at.s, square = s * s;
    if (alpha * square < -4) {
      a0 = 0, a1 = -at.u1 / (2 * alpha), a2 = -at.u2 / alpha, a3 = -1.5 * at.u3 / alpha;
      return;
    }
    const double psi = alpha * square;
    const auto [c4, c5] =
        psi > 4 ? std::array{(0.5 - at.u2 / square) / psi, (1.0 / 6 - at.u3 / (s * square)) / psi}
                : stumpff_pair<4>(psi);
    a0 = -s * at.u1 / 2;
    a1 = (at.u3 - s * at.u2) / 2;
    a2 = (2 * (square * square * c4) - s * at.u3) / 2;
    a3 = (3 * c5 - c4) * (square * square * s) / 2;
  }

  /// Derivatives of Lagrange's coefficients where r_0, sigma, alpha and mu^(1/2) t have the derivatives
  /// @p r0, @p s0, @p by_alpha and @p of_t; that of G without `of_t`.
  [[nodiscard]] LagrangeCoefficients<double> derivatives(double r0, double s0, double by_alpha,
                                                         double of_t = 0) const {
    const auto& [s, u0, u1, u2, u3, time, r, slope] = at;
    // Kepler's equation r_0 U_1 + sigma U_2 + U_3 = t; whole periods change with alpha.
    const double periods = turns_time == 0 ? 0 : 1.5 * turns_time / alpha * by_alpha;
    const double s_by = (of_t + periods - u1 * r0 - u2 * s0 - by_alpha * (a1 + sigma * a2 + a3)) / r;
    const double r_by = slope * s_by + u0 * r0 + u1 * s0 + by_alpha * (a0 + sigma * a1 + a2);
    const double u1_by = u0 * s_by + a1 * by_alpha, u2_by = u1 * s_by + a2 * by_alpha;
    return {u2 * r0 - u2_by, periods - u2 * s_by - a3 * by_alpha, (u1 * (r0 + r_by / r) - u1_by) / r,
            (u2 * r_by / r - u2_by) / r, 0};
  }
};

/// State-transition matrix and derivatives by mu, in the same units: of Lagrange's coefficients by r_0, sigma
/// and alpha, with the gradients of these. Differences of large terms do not occur, unlike in the formulas of
/// Battin, section 9.7, far out on hyperbolas.
void add_derivatives(const Ended& e, KeplerTransition& k) {
  const auto& [s, u0, u1, u2, u3, time, r, slope] = e.at;
  using C = LagrangeCoefficients<double>;
  const C by_r0 = e.derivatives(1, 0, 0), by_sigma = e.derivatives(0, 1, 0),
          by_alpha = e.derivatives(0, 0, 1);
  const auto block = [&](double one, double C::*along, double C::*across, bool by_velocity) {
    const auto gradient = [&](double C::*c) -> Vector3<double> {
      // d(r_0) = d.dr, d(sigma) = w.dr + d.dv, d(alpha) = -2 d.dr - 2 w.dv
      if (by_velocity) return by_sigma.*c * e.d - 2 * (by_alpha.*c) * e.w;
      return (by_r0.*c - 2 * (by_alpha.*c)) * e.d + by_sigma.*c * e.w;
    };
    Matrix<double, 3> m = e.d * gradient(along).transpose() + e.w * gradient(across).transpose();
    m.diagonal().array() += one;
    return m;
  };
  // G = U_1 + sigma U_2 = t - U_3, by the sum of the smaller terms.
  const double g =
      std::abs(u1) + std::abs(e.sigma * u2) < std::abs(e.t) + std::abs(u3) ? u1 + e.sigma * u2 : e.t - u3;
  k.transition << block(1 - u2, &C::f, &C::g, false), block(g, &C::f, &C::g, true),
      block(-u1 / r, &C::f_rate, &C::g_rate, false), block(1 - u2 / r, &C::f_rate, &C::g_rate, true);
  // By mu at r_0, sigma and t, from r_0 U_1 + sigma U_2 + mu U_3 = t with alpha = 2 mu/r_0 - v.v, F = 1 - mu
  // U_2/r_0, G = t - mu U_3; whole revolutions take a time that is proportional to mu.
  C c = e.derivatives(0, 0, 2, -u3 - e.turns_time);
  c.f -= u2;
  c.g -= u3 + e.turns_time;
  c.f_rate += u1 * (u2 / r - 1) / r;
  c.g_rate += u2 * (u2 / r - 1) / r;
  k.by_mu << c.f * e.d + c.g * e.w, c.f_rate * e.d + c.g_rate * e.w;
}

}  // namespace

KeplerTransition kepler_partials(const State& start, double time, double mu) {
  const double r0 = std::sqrt(start.position.dot(start.position)), speed = std::sqrt(mu / r0),
               rate = speed / r0;
  const Vector3<double> d = start.position / r0, w = start.velocity / speed;
  const double t = time * rate, ww = w.dot(w), sigma = d.dot(w);
  Ended e(d, w, t);
  const auto at = e.at;
  KeplerTransition k;
  const bool flyby = is_flyby(ww, sigma, t);
  k.state = flyby ? kepler_state(start, time, mu)
                  : moved(start, LagrangeCoefficients<double>{1 - at.u2, (at.u1 + sigma * at.u2) / rate,
                                                              -at.u1 / at.r * rate, 1 - at.u2 / at.r, 0});
  const double r = std::sqrt(k.state.position.dot(k.state.position));
  // Towards a periapsis the terms of r cancel, up to all digits; Flyby loses digits with the speed.
  const double terms = at.u0 + std::abs(sigma * at.u1) + at.u2;
  if (flyby && sigma * t < 0 &&
      !(terms * terms <= 100 * ww * at.r * at.r && std::abs(at.r * r0 - r) <= 1e-3 * r)) {
    by_dual_numbers(start, time, mu, k);
  } else {
    e.refine();
    add_derivatives(e, k);
    k.transition.topRightCorner<3, 3>() /= rate;
    k.transition.bottomLeftCorner<3, 3>() *= rate;
    k.by_mu.head<3>() *= r0 / mu;
    k.by_mu.tail<3>() *= speed / mu;
  }
  k.by_time << k.state.velocity, -(mu / r / r / r) * k.state.position;
  return k;
}

}  // namespace nlmech::orbit::detail

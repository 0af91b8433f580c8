#include "nlmech/orbit/kepler.hpp"

#include <numbers>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {
namespace {

void check_arguments(const State& start, double time, double mu, const char* who) {
  check(start, who);
  check(Gravity{.mu = mu});
  if (!std::isfinite(time)) throw invalid_argument("{}: the time must be finite, not {}", who, time);
}

/// Number of data: position, velocity, mu and time.
constexpr int data = 8;
using D = Dual<double, data>;

/// State at the end of a flyby with its derivatives, in units of r_0. The roots are computed in double; the
/// correction of their error has the derivatives.
BasicState<D> flyby_with_derivatives(const Vector3<D>& direction, const Vector3<D>& v, const D& time) {
  const detail::Flyby<D> flyby(direction, v);
  Vector3<double> plain_direction, plain_v;
  for (int i = 0; i < 3; ++i) {
    plain_direction[i] = direction[i].value;
    plain_v[i] = v[i].value;
  }
  const detail::Flyby<double> plain(plain_direction, plain_v);
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

/// Propagated state with its derivatives, as kepler_state(); on an approach without the periapsis.
BasicState<D> with_derivatives(const State& start, double time, double mu) {
  BasicState<D> s;
  for (int i = 0; i < 3; ++i) {
    s.position[i] = D::variable(start.position[i], i);
    s.velocity[i] = D::variable(start.velocity[i], 3 + i);
  }
  const D m = D::variable(mu, 6);
  const D r0 = sqrt(s.position.dot(s.position)), speed = sqrt(m / r0), rate = speed / r0;
  const Vector3<D> direction = s.position / r0, v = s.velocity / speed;
  D t = D::variable(time, 7) * rate;
  const detail::Universal<D> u{2 - v.dot(v), direction.dot(v)};
  if (value_of(u.alpha) < -1 && value_of(u.sigma) * time < 0) {
    if (is_approach(std::sqrt(v.dot(v).value), t.value)) {
      LagrangeCoefficients<D> c = approach_with_derivatives(direction, v, t);
      c.g /= rate, c.f_rate *= rate;
      return moved(s, c);
    }
    const BasicState<D> end = flyby_with_derivatives(direction, v, t);
    return {r0 * end.position, speed * end.velocity};
  }
  const detail::Universal<double> plain{u.alpha.value, u.sigma.value};
  double turns = 0;
  const double reduced = detail::within_one_turn(plain.alpha, t.value, turns);
  if (turns != 0) t -= turns * (2 * std::numbers::pi) / (u.alpha * sqrt(u.alpha));
  auto at = u.at(D(detail::solve(plain, reduced).at.s));
  at = u.at(at.s - (at.time - t) / at.r);
  return moved(s, LagrangeCoefficients<D>{1 - at.u2, (at.u1 + u.sigma * at.u2) / rate, -at.u1 / at.r * rate,
                                          1 - at.u2 / at.r, 0});
}

double sum_of_sensitivities(const Vector3<D>& result, const double (&size)[data]) {
  double sum = 0;
  const double length = std::hypot(result[0].value, result[1].value, result[2].value);
  for (std::size_t j = 0; j < data; ++j) {
    // Divide first: squares of time derivatives of a fast orbit overflow.
    const double unit = size[j] / length;
    sum += std::hypot(result[0].partial[j] * unit, result[1].partial[j] * unit, result[2].partial[j] * unit);
  }
  return sum < std::numeric_limits<double>::infinity() ? sum : std::numeric_limits<double>::infinity();
}

/// Kepler's problem in units with |r| and mu near 1.
struct Scaled {
  State start;
  double time = 0, mu = 1;
  detail::PowerUnits units;
  bool possible = true;  ///< are speed and time within the range of doubles?

  Scaled(const State& s, double t, double m) : start(s), time(t), mu(m) {
    const double size = detail::extent(s.position), speed = detail::extent(s.velocity);
    if (detail::is_extreme(size) || detail::is_extreme(m) || speed > 1e60 || std::abs(t) > 1e60) {
      units = detail::PowerUnits(size, m);
      start = units.own(s);
      mu = units.own_mu(m);
      time = std::ldexp(t, -units.time);
    }
    possible = detail::extent(start.velocity) < detail::fastest && std::isfinite(time);
  }
};

KeplerCondition condition_of(const Scaled& s) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!s.possible) return {infinity, infinity};
  const double r = s.start.position.norm(), v = s.start.velocity.norm();
  const double size[data] = {r, r, r, v, v, v, s.mu, std::abs(s.time)};
  const auto end = with_derivatives(s.start, s.time, s.mu);
  return {sum_of_sensitivities(end.position, size), sum_of_sensitivities(end.velocity, size)};
}

/// Condition number of the mean anomaly of an ellipse. At an apoapsis the position does not depend on it to
/// first order.
double phase_condition(const Scaled& s) {
  const double r0 = s.start.position.norm(), v0 = s.start.velocity.norm(), circular = s.mu / r0;
  const double share = v0 * v0 / circular, alpha = 2 - share;
  if (!(alpha > 0)) return 0;
  return std::abs(s.time) * std::sqrt(circular * alpha) * alpha / r0 * (2 + 1.5 * (2 + share) / alpha);
}

/// Can kappa be large? Estimate from the distance travelled relative to the final distance, with the error of
/// the energy; from the final distance from the centre; and from the closest passage of a fast body.
bool may_be_large(const Scaled& s, const State& end, double limit) {
  const double r0 = s.start.position.norm(), v0 = s.start.velocity.norm(), r = end.position.norm(),
               v = end.velocity.norm(), time = std::abs(s.time), circular = s.mu / r0;
  const double share = v0 * v0 / circular, alpha = 2 - share;
  // Rounding changes 2 - share = r_0/a by (2 + share) eps. The end changes in proportion to the relative
  // error; near the parabola, before one period, in proportion to the final distance.
  const bool swings = alpha > 0 && time * std::sqrt(circular * alpha) * alpha > r0;
  const double of_energy = 1 / std::abs(alpha),
               growth = 1 + (2 + share) * (swings ? of_energy : std::min(of_energy, 1 + r / r0));
  if (!((r0 + v0 * time + v * time * growth) / r < limit) || phase_condition(s) > limit) return true;
  return share > 3 && !(cross(s.start.position, s.start.velocity).norm() > r0 * v0 / limit);
}

/// kappa of the position, or of the mean anomaly if larger, if it is at least @p least; else 0.
double condition_if_large(const Scaled& s, const State& end, double least) {
  // The estimate is rough: safety factor 1e4.
  if (!may_be_large(s, end, least / 1e4)) return 0;
  const double kappa = std::max(condition_of(s).position, phase_condition(s));
  return kappa < least ? 0 : kappa;
}

Status undetermined(double time, double kappa) {
  return failed_with(Outcome::outside_validity,
                     "Kepler's problem: rounding of the data leaves the place after {:.6g} undetermined (its "
                     "condition, {:.2g}, times "
                     "the rounding of doubles leaves not one digit); ask for a time nearer 0{}",
                     time, kappa, std::isfinite(kappa) ? "" : ", or give the data in other units");
}

}  // namespace

KeplerSolution propagate_kepler(const State& start, double time, double mu) {
  check_arguments(start, time, mu, "propagate_kepler");
  const Scaled s(start, time, mu);
  KeplerSolution solution{start, {}, 0};
  if (!s.possible) {
    solution.status = failed_with(Outcome::outside_validity,
                                  "kepler: the speed {:.6g} or the time {:.6g} is beyond 1e150 times those "
                                  "of a circular orbit with mu = {:.6g}; choose smaller ones, or a larger mu",
                                  start.velocity.stableNorm(), time, mu);
    return solution;
  }
  const State end = kepler_state(s.start, s.time, s.mu, &solution.iterations);
  if (end.position == Vector3<double>::Zero() || (end.position.allFinite() && !end.velocity.allFinite())) {
    solution.status = failed_with(Outcome::collision,
                                  "kepler: after {:.17g} the body is in the centre of attraction, where its "
                                  "velocity has no bound; ask for another time",
                                  time);
    return solution;
  }
  if (const double kappa = condition_if_large(s, end, no_digit); kappa != 0) {
    solution.status = undetermined(time, kappa);
    return solution;
  }
  const State users = s.units.users(end);
  if (!users.position.allFinite() || !users.velocity.allFinite() ||
      users.position == Vector3<double>::Zero()) {
    solution.status = failed_with(Outcome::outside_validity,
                                  "kepler: the state after {:.6g} is beyond the range of doubles; ask for a "
                                  "time nearer 0, or give the data in other units",
                                  time);
    return solution;
  }
  solution.state = users;
  return solution;
}

KeplerCondition kepler_condition(const State& start, double time, double mu) {
  check_arguments(start, time, mu, "kepler_condition");
  return condition_of(Scaled(start, time, mu));
}

double large_condition(const State& start, const State& end, double time, double mu, double least) {
  check_arguments(start, time, mu, "large_condition");
  const Scaled s(start, time, mu);
  if (!s.possible) return std::numeric_limits<double>::infinity();
  return condition_if_large(s, s.units.own(end), least);
}

}  // namespace nlmech::orbit

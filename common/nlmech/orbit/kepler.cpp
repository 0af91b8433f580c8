#include "nlmech/orbit/kepler.hpp"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/series/dual.hpp"

namespace nlmech::orbit {
namespace {

void check_arguments(const State& start, double time, double mu, const char* who) {
  check(start, who);
  check(Gravity{.mu = mu});
  if (!std::isfinite(time))
    throw std::invalid_argument(fmt::format("{}: the time must be finite, not {}", who, time));
}

/// Position, velocity, mu and time.
constexpr int data = 8;
using D = Dual<double, data>;

/// The end of a flyby with its derivatives, in units of r_0. The roots are found in double; what they are off
/// by carries the derivatives.
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

/// The moved state with its derivatives, found as by kepler_state().
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
    // The quotient first: derivatives by the time of a fast flight have squares beyond all doubles.
    const double unit = size[j] / length;
    sum += std::hypot(result[0].partial[j] * unit, result[1].partial[j] * unit, result[2].partial[j] * unit);
  }
  return sum;
}

}  // namespace

KeplerSolution propagate_kepler(const State& start, double time, double mu) {
  check_arguments(start, time, mu, "propagate_kepler");
  KeplerSolution solution;
  solution.state = kepler_state(start, time, mu, &solution.iterations);
  if (!solution.state.position.allFinite() || !solution.state.velocity.allFinite() ||
      solution.state.position == Vector3<double>::Zero()) {
    solution.state = start;
    solution.status = Status::failure(
        Outcome::collision,
        fmt::format("kepler: after {:.17g} the body is in the centre of attraction, where its "
                    "velocity has no bound; ask for another time",
                    time));
  }
  return solution;
}

KeplerCondition kepler_condition(const State& start, double time, double mu) {
  check_arguments(start, time, mu, "kepler_condition");
  const double r = start.position.norm(), v = start.velocity.norm();
  const double size[data] = {r, r, r, v, v, v, mu, std::abs(time)};
  const auto end = with_derivatives(start, time, mu);
  return {sum_of_sensitivities(end.position, size), sum_of_sensitivities(end.velocity, size)};
}

}  // namespace nlmech::orbit

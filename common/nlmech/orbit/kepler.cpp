#include "nlmech/orbit/kepler.hpp"

#include <fmt/format.h>

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

/// The moved state with its derivatives. The root is found in double; one step of Newton's in dual numbers
/// then carries the derivatives.
BasicState<D> with_derivatives(const State& start, double time, double mu) {
  BasicState<D> s;
  for (int i = 0; i < 3; ++i) {
    s.position[i] = D::variable(start.position[i], i);
    s.velocity[i] = D::variable(start.velocity[i], 3 + i);
  }
  const D m = D::variable(mu, 6);
  const D r0 = sqrt(s.position.dot(s.position)), speed = sqrt(m / r0), rate = speed / r0;
  const Vector3<D> direction = s.position / r0, v = s.velocity / speed;
  const detail::Universal<D> u{2 - v.dot(v), direction.dot(v)};
  const detail::Universal<double> plain{u.alpha.value, u.sigma.value};
  D t = D::variable(time, 7) * rate;
  double turns = 0;
  const double reduced = detail::within_one_turn(plain.alpha, t.value, turns);
  if (turns != 0) t -= turns * (4 * std::acos(0.0)) / (u.alpha * sqrt(u.alpha));
  auto at = u.at(D(detail::solve(plain, reduced).at.s));
  at = u.at(at.s - (at.time - t) / at.r);
  return moved(s, LagrangeCoefficients<D>{1 - at.u2, (at.u1 + u.sigma * at.u2) / rate, -at.u1 / at.r * rate,
                                          1 - at.u2 / at.r, 0});
}

double sum_of_sensitivities(const Vector3<D>& result, const double (&size)[data]) {
  double sum = 0, length = 0;
  for (std::size_t j = 0; j < data; ++j) {
    double square = 0;
    for (int i = 0; i < 3; ++i) square += result[i].partial[j] * result[i].partial[j];
    sum += std::sqrt(square) * size[j];
  }
  for (int i = 0; i < 3; ++i) length += result[i].value * result[i].value;
  return sum / std::sqrt(length);
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

#include "nlmech/orbit/kepler.hpp"

#include <limits>
#include <utility>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/kepler_partials.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {
namespace {

void check_arguments(const State& start, double time, double mu, const char* who) {
  check(start, who);
  check(Gravity{.mu = mu});
  if (!std::isfinite(time)) throw invalid_argument("{}: the time must be finite, not {}", who, time);
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
  const Vector<double, 8> size{r, r, r, v, v, v, s.mu, std::abs(s.time)};
  const KeplerTransition k = detail::kepler_partials(s.start, s.time, s.mu);
  Matrix<double, 6, 8> partials;
  partials << k.transition, k.by_mu, k.by_time;
  const auto sum_of_effects = [&](const Vector3<double>& result, Eigen::Index row) {
    // Divide first: squares of time derivatives of a fast orbit overflow.
    const double length = std::hypot(result[0], result[1], result[2]);
    double sum = 0;
    for (Eigen::Index j = 0; j < 8; ++j) {
      const double unit = size[j] / length;
      sum += std::hypot(partials(row, j) * unit, partials(row + 1, j) * unit, partials(row + 2, j) * unit);
    }
    if (!(sum < infinity)) sum = infinity;
    return sum;
  };
  return {sum_of_effects(k.state.position, 0), sum_of_effects(k.state.velocity, 3)};
}

/// Sizes at the start, in the units of Scaled.
struct Sizes {
  double r, v, time;       ///< distance, speed, |time|
  double circular, share;  ///< mu/r and v^2 r/mu

  explicit Sizes(const Scaled& s)
      : r(s.start.position.norm()),
        v(s.start.velocity.norm()),
        time(std::abs(s.time)),
        circular(s.mu / r),
        share(v * v / circular) {}
  /// Condition number of the mean anomaly of an ellipse, also of one within rounding. At an apoapsis the
  /// position does not depend on it to first order.
  [[nodiscard]] double phase_condition() const {
    const double alpha = 2 - share + 8 * std::numeric_limits<double>::epsilon();
    if (!(alpha > 0)) return 0;
    return time * std::sqrt(circular * alpha) / r * (2 * alpha + 1.5 * (2 + share));
  }
};

/// Can kappa be large? Estimate from the distance travelled relative to the final distance, with the error of
/// the energy; from the final distance from the centre; and from the closest passage of a fast body.
bool may_be_large(const Scaled& s, const Sizes& at, const State& end, double limit) {
  const double r = end.position.norm(), v = end.velocity.norm(), share = at.share, alpha = 2 - share;
  // Rounding changes 2 - share = r_0/a by (2 + share) eps. The end changes in proportion to the relative
  // error; near the parabola, before one period, in proportion to the final distance.
  const bool swings = alpha > 0 && at.time * std::sqrt(at.circular * alpha) * alpha > at.r;
  const double of_energy = 1 / std::abs(alpha),
               growth = 1 + (2 + share) * (swings ? of_energy : std::min(of_energy, 1 + r / at.r));
  if (!((at.r + at.v * at.time + v * at.time * growth) / r < limit) || at.phase_condition() > limit)
    return true;
  return share > 3 && !(cross(s.start.position, s.start.velocity).norm() > at.r * at.v / limit);
}

/// kappa of the position, or of the mean anomaly if larger, if it is at least @p least; else 0.
double condition_if_large(const Scaled& s, const State& end, double least) {
  // The estimate is rough: safety factor 1e4.
  const Sizes at(s);
  if (!may_be_large(s, at, end, least / 1e4)) return 0;
  const double kappa = std::max(condition_of(s).position, at.phase_condition());
  return kappa < least ? 0 : kappa;
}

Status undetermined(double time, double kappa) {
  return failed_with(Outcome::outside_validity,
                     "Kepler's problem: rounding of the data leaves the place after {:.6g} undetermined (its "
                     "condition, {:.2g}, times "
                     "the rounding of doubles leaves not one digit); ask for a time nearer 0{}",
                     time, kappa, std::isfinite(kappa) ? "" : ", or give the data in other units");
}

Status too_fast(const State& start, double time, double mu) {
  return failed_with(Outcome::outside_validity,
                     "kepler: the speed {:.6g} or the time {:.6g} is beyond 1e150 times those "
                     "of a circular orbit with mu = {:.6g}; choose smaller ones, or a larger mu",
                     start.velocity.stableNorm(), time, mu);
}

/// Checks the end of a motion, the state after the time @p time of the user, and converts it to the units of
/// the user.
Status finish(const Scaled& s, double time, State& end) {
  if (end.position == Vector3<double>::Zero() || (end.position.allFinite() && !end.velocity.allFinite()))
    return failed_with(Outcome::collision,
                       "kepler: after {:.17g} the body is in the centre of attraction, where its "
                       "velocity has no bound; ask for another time",
                       time);
  if (const double kappa = condition_if_large(s, end, no_digit); kappa != 0) return undetermined(time, kappa);
  end = s.units.users(end);
  if (!end.position.allFinite() || !end.velocity.allFinite() || end.position == Vector3<double>::Zero())
    return failed_with(Outcome::outside_validity,
                       "kepler: the state after {:.6g} is beyond the range of doubles; ask for a "
                       "time nearer 0, or give the data in other units",
                       time);
  return {};
}

/// Converts partial derivatives to the units of the user.
void convert(const detail::PowerUnits& units, KeplerTransition& k) {
  const int length = units.length, time = units.time, mu = 3 * length - 2 * time;
  const auto scale = [](auto&& part, int exponent) {
    for (double& x : part.reshaped()) x = std::ldexp(x, exponent);
  };
  scale(k.transition.topRightCorner<3, 3>(), time);
  scale(k.transition.bottomLeftCorner<3, 3>(), -time);
  scale(k.by_mu.head<3>(), length - mu);
  scale(k.by_mu.tail<3>(), length - time - mu);
  scale(k.by_time.head<3>(), length - time);
  scale(k.by_time.tail<3>(), length - 2 * time);
}

}  // namespace

KeplerSolution propagate_kepler(const State& start, double time, double mu) {
  check_arguments(start, time, mu, "propagate_kepler");
  const Scaled s(start, time, mu);
  if (!s.possible) return {start, too_fast(start, time, mu), 0};
  KeplerSolution solution;
  solution.state = kepler_state(s.start, s.time, s.mu, &solution.iterations);
  solution.status = finish(s, time, solution.state);
  if (!solution.status.ok()) solution.state = start;
  return solution;
}

KeplerTransition kepler_transition(const State& start, double time, double mu) {
  check_arguments(start, time, mu, "kepler_transition");
  const Scaled s(start, time, mu);
  const auto failed = [&start](Status status) {
    return KeplerTransition{.state = start, .status = std::move(status)};
  };
  if (!s.possible) return failed(too_fast(start, time, mu));
  KeplerTransition k = detail::kepler_partials(s.start, s.time, s.mu);
  if (Status status = finish(s, time, k.state); !status.ok()) return failed(std::move(status));
  if (s.units.length != 0 || s.units.time != 0) convert(s.units, k);
  if (0 * (k.transition.sum() + k.by_mu.sum() + k.by_time.sum()) != 0 &&  // seldom, also by its own overflow
      !(k.transition.allFinite() && k.by_mu.allFinite() && k.by_time.allFinite()))
    return failed(failed_with(Outcome::outside_validity,
                              "kepler: the derivatives of the state after {:.6g} are beyond the range of "
                              "doubles; ask for another time, or give the data in other units",
                              time));
  return k;
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

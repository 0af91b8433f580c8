#include "nlmech/orbit/convergence.hpp"

#include <cmath>
#include <limits>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/orbit/universal.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {
namespace {

/// (atanh b - b)/b^3 for b^2 = x; for x < 0 (b' - atan b')/b'^3 with b'^2 = -x. 1/3 at 0.
double rest_of_arctangent(double x) {
  if (std::abs(x) < 0.25) {
    double sum = 0;
    for (int k = 28; k >= 0; --k) sum = sum * x + 1.0 / (2 * k + 3);  // 0.25^28 < eps
    return sum;
  }
  const double b = std::sqrt(std::abs(x));
  return x > 0 ? (std::atanh(b) - b) / (b * x) : (b - std::atan(b)) / (b * -x);
}

/// convergence_radius() in units in which squares do not overflow.
double radius_in_range(const State& state, double mu) {
  // In the units |r| = 1, mu = 1.
  const double r = state.position.norm(), speed = std::sqrt(mu / r);
  const Vector3<double> direction = state.position / r, v = state.velocity / speed;
  const double alpha = 2 - v.dot(v), sigma = direction.dot(v);
  const double p = cross<double>(direction, v).squaredNorm();                  // 1 - e^2 = alpha p
  const double e = std::hypot(p - 1, sigma * std::sqrt(p)), rp = p / (1 + e);  // e cos nu, e sin nu
  if (e == 0) return std::numeric_limits<double>::infinity();
  // Time from the periapsis, rp s + e s^3 c_3, by the universal variable s counted from there.
  const double k = std::sqrt(std::abs(alpha));
  const double s = detail::variable_since_periapsis(alpha, sigma, e);
  const double real = rp * s + e * s * s * s * stumpff(alpha * s * s).c3;
  // r = 0 at imaginary distance p^(3/2) (atanh b - b)/b^3 with b^2 = 1 - e^2.
  const double x = alpha * p;
  const double imaginary = e < 0.5 ? convergence_radius_at_periapsis(e) / (k * std::abs(alpha))
                                   : p * std::sqrt(p) * rest_of_arctangent(x);
  return std::hypot(real, imaginary) * r / speed;
}

}  // namespace

double convergence_radius_at_periapsis(double eccentricity) {
  if (!(eccentricity >= 0 && eccentricity <= 1)) {
    throw invalid_argument("convergence_radius_at_periapsis: e must be from 0 to 1, not {}", eccentricity);
  }
  if (eccentricity == 0) return std::numeric_limits<double>::infinity();
  // acosh(1/e) = atanh sqrt(1 - e^2) loses e for small e; the logarithm does not.
  const double x = (1 - eccentricity) * (1 + eccentricity), b = std::sqrt(x);
  if (eccentricity < 0.5) return std::log((1 + b) / eccentricity) - b;
  return b * x * rest_of_arctangent(x);
}

double convergence_radius(const State& state, double mu) {
  check(state, "convergence_radius");
  check(Gravity{.mu = mu});
  const double size = detail::extent(state.position), speed = detail::extent(state.velocity);
  if (!detail::is_extreme(size) && !detail::is_extreme(mu) &&
      !(speed > 1e60 || speed > 1e70 * std::sqrt(mu / size)))
    return radius_in_range(state, mu);
  const detail::PowerUnits units(size, mu);
  const State own = units.own(state);
  // At this speed gravity is negligible: the nearest singularity is where the straight line meets r = 0 in
  // complex time.
  if (!(detail::extent(own.velocity) < 1e70))
    return (state.position / size).norm() / (state.velocity / speed).norm() * (size / speed);
  return std::ldexp(radius_in_range(own, units.own_mu(mu)), units.time);
}

}  // namespace nlmech::orbit

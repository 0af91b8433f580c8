/// @file
/// Random states and motions for the randomised tests of orbits and transfers.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "nlmech/support/extended_real.hpp"
#include "tests/orbit/conic.hpp"
#include "tests/randomised/randomised.hpp"

namespace nlmech::orbit::randomised {

using nlmech::randomised::Draw;
/// 100 digits: revolutions up to 1e20, cancellation near the parabola and near the centre.
using Real = ExtendedReal<100>;
using Wide = long double;

inline constexpr double eps = std::numeric_limits<double>::epsilon();

using oracle::as, oracle::conic, oracle::length;

/// |a - b|.
template <class T>
[[nodiscard]] double distance(const Vector3<double>& a, const Vector3<T>& b) {
  Vector3<T> d;
  for (int i = 0; i < 3; ++i) d[i] = T(a[i]) - b[i];
  return static_cast<double>(T(length(d)));
}

/// A random direction, in one case of four along an axis.
[[nodiscard]] inline Vector3<double> direction(Draw& draw) {
  if (draw.chance(0.25)) {
    Vector3<double> axis(0, 0, 0);
    axis[draw.whole(0, 2)] = draw.chance(0.5) ? 1 : -1;
    return axis;
  }
  return Vector3<double>(draw.normal(), draw.normal(), draw.normal()).normalized();
}

/// A state at the distance @p r, with @p speed in units of the circular speed, at @p angle from the outward
/// direction.
[[nodiscard]] inline State state_of(Draw& draw, double r, double mu, double speed, double angle) {
  const Vector3<double> out = direction(draw);
  Vector3<double> side = cross(out, direction(draw));
  while (side.norm() < 1e-3) side = cross(out, direction(draw));
  side.normalize();
  const double v = speed * std::sqrt(mu / r);
  return {r * out, v * std::cos(angle) * out + v * std::sin(angle) * side};
}

[[nodiscard]] inline std::string words(const State& s, double time, double mu) {
  return fmt::format(
      "--position {:.17g},{:.17g},{:.17g} --velocity {:.17g},{:.17g},{:.17g} --until {:.17g} --mu {:.17g}",
      s.position[0], s.position[1], s.position[2], s.velocity[0], s.velocity[1], s.velocity[2], time, mu);
}

/// Random conics including special cases: circles, parabolas, straight lines, bodies at rest, passages near
/// the centre.
struct Motion {
  State start;
  double time, mu;
};
[[nodiscard]] inline Motion any_motion(Draw& draw) {
  const double mu = draw.log_uniform(1e-6, 1e20), r = draw.log_uniform(1e-6, 1e12);
  const double speed = draw.chance(0.3)   ? std::numbers::sqrt2 * (1 + draw.signed_log(1e-17, 0.1))
                       : draw.chance(0.1) ? 0.0
                                          : draw.log_uniform(1e-6, draw.chance(0.2) ? 1e8 : 10);
  double angle = draw.uniform(0, std::numbers::pi);
  if (draw.chance(0.2)) angle = draw.log_uniform(1e-18, 0.1);
  if (draw.chance(0.2)) angle = std::numbers::pi - draw.log_uniform(1e-18, 0.1);
  if (draw.chance(0.1)) angle = std::numbers::pi / 2;
  const State s = state_of(draw, r, mu, speed, angle);
  const double scale = r * std::sqrt(r / mu) / (1 + (draw.chance(0.5) ? speed : 0));
  return {s, scale * draw.signed_log(1e-8, draw.chance(0.2) ? 1e18 : 1e4), mu};
}

}  // namespace nlmech::orbit::randomised

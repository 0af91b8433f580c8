#include "chapters/two_body_series/orbits/ellipses.hpp"

#include <cmath>
#include <limits>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

using Digits50 = ExtendedReal<50>;

orbit::BasicState<Digits50> propagated(const orbit::State& start, double time, double mu) {
  const orbit::BasicState<Digits50> s{start.position.cast<Digits50>(), start.velocity.cast<Digits50>()};
  return orbit::kepler_state<Digits50>(s, Digits50(time), Digits50(mu));
}

}  // namespace

orbit::State on_ellipse(double eccentricity, double anomaly) {
  const long double e = eccentricity;
  const orbit::BasicState<long double> s{{1 - e, 0, 0}, {0, std::sqrt((1 + e) / (1 - e)), 0}};
  const auto moved = orbit::kepler_state<long double>(s, anomaly, 1);
  return {moved.position.cast<double>(), moved.velocity.cast<double>()};
}

orbit::BasicState<long double> state_in_50_digits(const orbit::State& start, double time, double mu) {
  const auto end = propagated(start, time, mu);
  return {end.position.cast<long double>(), end.velocity.cast<long double>()};
}

double position_error(const orbit::State& start, double time, double mu,
                      const orbit::Vector3<double>& position) {
  const orbit::Vector3<Digits50> d = position.cast<Digits50>() - propagated(start, time, mu).position;
  return static_cast<double>(d.cast<long double>().norm());
}

double rounding_of_data(const orbit::State& start, double time, double mu) {
  const double end = orbit::propagate_kepler(start, time, mu).state.position.norm();
  return orbit::kepler_condition(start, time, mu).position * std::numeric_limits<double>::epsilon() / 2 * end;
}

}  // namespace nlmech::chapters::two_body_series

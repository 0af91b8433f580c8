#include "nlmech/orbit/elements.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {
namespace {

constexpr double small = 4 * std::numeric_limits<double>::epsilon();
constexpr double two_pi = 2 * std::numbers::pi;

using Vec = Vector3<double>;

/// From 0 to 2 pi, the end left out.
double turned_positive(double angle) {
  if (angle >= 0) return angle;
  const double up = angle + two_pi;
  return up < two_pi ? up : 0;
}

/// A direction in the orbital plane, and the one a quarter turn ahead.
struct Axes {
  Vec first, second;
};

/// sqrt(a/b), also where the quotient is no normal number.
double root_of_ratio(double a, double b) {
  const double ratio = a / b;
  if (ratio >= std::numeric_limits<double>::min() && ratio <= std::numeric_limits<double>::max())
    return std::sqrt(ratio);
  return std::sqrt(a) / std::sqrt(b);
}

/// Beyond it the rounding of an angle is a whole turn.
constexpr double largest_angle = 1 / std::numeric_limits<double>::epsilon();

/// The angle at which @p x lies in the plane, from -pi to pi.
double angle(const Axes& axes, const Vec& x) { return std::atan2(axes.second.dot(x), axes.first.dot(x)); }

/// The elements in units in which squares are doubles.
Elements elements_in_range(const State& state, double mu) {
  const Vec h = angular_momentum(state);
  const double hh = h.norm(), r = state.position.norm(), v = state.velocity.norm();
  if (!(hh > small * r * v)) {
    throw std::invalid_argument(
        "elements_of: the body moves on a straight line through the centre, which has no classical elements");
  }
  const Vec normal = h / hh;
  Elements e;
  e.semi_latus_rectum = hh * (hh / mu);
  const double along = state.position.dot(state.velocity);
  // e cos nu = p/r - 1 and e sin nu = (r.v/r) sqrt(p/mu): no difference of vectors.
  const double c = e.semi_latus_rectum / r - 1, s = along / r * (hh / mu);
  e.eccentricity = std::hypot(c, s);
  const double alpha = reciprocal_axis(state, mu);
  e.semi_major_axis = alpha != 0 ? 1 / alpha : std::numeric_limits<double>::infinity();
  const double sine = std::hypot(normal[0], normal[1]);
  e.inclination = std::atan2(sine, normal[2]);
  Vec node(1, 0, 0);
  if (sine > small) {
    node = Vec(-normal[1], normal[0], 0) / sine;
    e.ascending_node = turned_positive(std::atan2(node[1], node[0]));
  } else {
    e.inclination = normal[2] > 0 ? 0 : two_pi / 2;
  }
  // Counted from the node; for no inclination the axes of state_of() are used, so that nothing is lost there.
  const Axes axes{node, sine > small ? cross<double>(normal, node) : Vec(0, normal[2] > 0 ? 1 : -1, 0)};
  const double latitude = angle(axes, state.position);
  if (e.eccentricity > small) {
    e.true_anomaly = std::atan2(s, c);
    e.periapsis_argument = turned_positive(std::remainder(latitude - e.true_anomaly, two_pi));
  } else {
    e.eccentricity = 0;
    e.true_anomaly = latitude;
  }
  return e;
}

}  // namespace

double Elements::period(double mu) const {
  if (!(semi_major_axis > 0)) return std::numeric_limits<double>::infinity();
  const double root = root_of_ratio(semi_major_axis, mu), period = two_pi * semi_major_axis * root;
  return std::isfinite(period) ? period : two_pi * (semi_major_axis * root);
}

Elements from_axis(double semi_major_axis, double eccentricity, double inclination, double ascending_node,
                   double periapsis_argument, double true_anomaly) {
  const double p = semi_major_axis * (1 - eccentricity) * (1 + eccentricity);
  if (!(p > 0) || !std::isfinite(p) || !(eccentricity >= 0)) {
    throw invalid_argument(
        "from_axis: a = {} and e = {} make no conic (p = a (1 - e^2) must be positive and finite); a is "
        "positive for e < 1 and negative for e > 1",
        semi_major_axis, eccentricity);
  }
  return {p, eccentricity, inclination, ascending_node, periapsis_argument, true_anomaly, semi_major_axis};
}

Elements elements_of(const State& state, double mu) {
  check(state, "elements_of");
  check(Gravity{.mu = mu});
  const double size = detail::extent(state.position);
  Elements e;
  detail::PowerUnits units;
  if (detail::is_extreme(size) || detail::is_extreme(mu) ||
      detail::is_extreme(detail::extent(state.velocity))) {
    units = detail::PowerUnits(size, mu);
    const State own = units.own(state);
    if (!(detail::extent(own.velocity) < detail::fastest)) {
      throw invalid_argument(
          "elements_of: at the distance {:.6g} and the speed {:.6g} with mu = {:.6g} the eccentricity is "
          "beyond 1e300",
          state.position.stableNorm(), state.velocity.stableNorm(), mu);
    }
    e = elements_in_range(own, units.own_mu(mu));
    e.semi_latus_rectum = std::ldexp(e.semi_latus_rectum, units.length);
    e.semi_major_axis = std::ldexp(e.semi_major_axis, units.length);
  } else {
    e = elements_in_range(state, mu);
  }
  if (!(e.semi_latus_rectum > 0) || !std::isfinite(e.semi_latus_rectum) || !std::isfinite(e.eccentricity) ||
      e.semi_major_axis == 0) {
    throw invalid_argument(
        "elements_of: p = {} and a = {} are beyond the range of doubles; take another unit of length",
        e.semi_latus_rectum, e.semi_major_axis);
  }
  return e;
}

State state_of(const Elements& e, double mu) {
  check(Gravity{.mu = mu});
  for (const double x : {e.inclination, e.ascending_node, e.periapsis_argument, e.true_anomaly}) {
    if (!(std::abs(x) < largest_angle))
      throw invalid_argument("state_of: an angle is {}; beyond {:.2g} rounding is as large as a turn", x,
                             largest_angle);
  }
  const double p = e.semi_latus_rectum;
  if (!(p > 0) || !std::isfinite(p) || !(e.eccentricity >= 0) || !std::isfinite(e.eccentricity)) {
    throw invalid_argument("state_of: p = {} and e = {} make no conic; p must be positive, e 0 or more", p,
                           e.eccentricity);
  }
  const double denominator = 1 + e.eccentricity * std::cos(e.true_anomaly);
  if (!(denominator > 0)) {
    throw invalid_argument("state_of: the true anomaly {} lies beyond the asymptote of a conic with e = {}",
                           e.true_anomaly, e.eccentricity);
  }
  const double r = p / denominator, speed = root_of_ratio(mu, p);
  const double u = e.periapsis_argument + e.true_anomaly;
  const double cu = std::cos(u), su = std::sin(u), co = std::cos(e.ascending_node),
               so = std::sin(e.ascending_node), ci = std::cos(e.inclination), si = std::sin(e.inclination);
  const Vec outwards(co * cu - so * ci * su, so * cu + co * ci * su, si * su);
  const Vec ahead(-co * su - so * ci * cu, -so * su + co * ci * cu, si * cu);
  const State state{r * outwards,
                    speed * (e.eccentricity * std::sin(e.true_anomaly) * outwards + denominator * ahead)};
  if (!(r > 0) || !state.position.allFinite() || !state.velocity.allFinite()) {
    throw invalid_argument(
        "state_of: p = {}, e = {} and mu = {} lead to the distance {} or a speed that is beyond the range of "
        "doubles; take other units or a smaller e",
        p, e.eccentricity, mu, r);
  }
  return state;
}

}  // namespace nlmech::orbit

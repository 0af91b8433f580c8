#include "nlmech/orbit/elements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/orbit/universal.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {
namespace {

constexpr double small = 4 * std::numeric_limits<double>::epsilon();
constexpr double two_pi = 2 * std::numbers::pi;

using Vec = Vector3<double>;

/// Angle in [0, 2 pi).
double turned_positive(double angle) {
  if (angle >= 0) return angle;
  const double up = angle + two_pi;
  return up < two_pi ? up : 0;
}

/// A direction in the orbital plane, and the one 90 degrees ahead.
struct Axes {
  Vec first, second;
};

/// sqrt(a/b), also where a/b overflows or is subnormal.
double root_of_ratio(double a, double b) {
  const double ratio = a / b;
  if (ratio >= std::numeric_limits<double>::min() && ratio <= std::numeric_limits<double>::max())
    return std::sqrt(ratio);
  return std::sqrt(a) / std::sqrt(b);
}

/// Above this the rounding of an angle is a full turn.
constexpr double largest_angle = 1 / std::numeric_limits<double>::epsilon();

/// Angle of @p x in the plane, from -pi to pi.
double angle(const Axes& axes, const Vec& x) { return std::atan2(axes.second.dot(x), axes.first.dot(x)); }

/// Position on a conic relative to the periapsis, in the units |r| = 1 and mu = 1.
struct SincePeriapsis {
  double e, q;             ///< eccentricity, distance of the periapsis
  double eccentric, time;  ///< E or H, 0 for a parabola; time
  double nu;               ///< true anomaly
};

/// @param p semi-latus rectum, positive
SincePeriapsis since_periapsis(double alpha, double sigma, double p) {
  SincePeriapsis on{};
  // 1 - e^2 = alpha p where that is more accurate, else e cos nu = p - 1 and e sin nu = sigma p^(1/2).
  on.e = std::abs(alpha * p) < 0.5 ? std::sqrt(1 - alpha * p) : std::hypot(p - 1, sigma * std::sqrt(p));
  on.q = p / (1 + on.e);
  const double s = detail::variable_since_periapsis(alpha, sigma, on.e), k = std::sqrt(std::abs(alpha));
  const Stumpff<double> c = stumpff(alpha * s * s);
  // s of a fast hyperbola is the logarithm of a large number: correct its rounding, computed from r.v.
  const double off = alpha < 0 ? (sigma - on.e * s * c.c1) / (on.e * c.c0) : 0;
  const double u1 = s * c.c1 + c.c0 * off, u2 = s * s * c.c2 + s * c.c1 * off;
  on.time = on.q * s + on.e * s * s * s * c.c3 + (on.q + on.e * s * s * c.c2) * off;
  on.nu = std::atan2(std::sqrt(p) * u1, on.q - u2);
  on.eccentric = k * (s + off);
  return on;
}

/// elements_of() in units in which squares do not overflow.
Elements elements_in_range(const State& state, double mu) {
  const Vec h = accurate_cross(state.position, state.velocity);
  const double hh = h.norm(), r = state.position.norm(), v = state.velocity.norm();
  if (!(hh > small * r * v)) {
    throw std::invalid_argument(
        "elements_of: the body moves on a straight line through the centre, which has no classical elements");
  }
  const Vec normal = h / hh;
  Elements e;
  e.semi_latus_rectum = hh * (hh / mu);
  const double speed = std::sqrt(mu / r), alpha = reciprocal_axis(state, mu);
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
  // Angles measured from the node; for zero inclination the axes of state_of(), so that they stay exact.
  const Axes axes{node, sine > small ? cross<double>(normal, node) : Vec(0, normal[2] > 0 ? 1 : -1, 0)};
  const double latitude = angle(axes, state.position);
  const SincePeriapsis on =
      since_periapsis(alpha * r, state.position.dot(state.velocity) / r / speed, e.semi_latus_rectum / r);
  if (on.e > small) {
    e.eccentricity = on.e;
    e.true_anomaly = on.nu;
    e.periapsis_argument = turned_positive(std::remainder(latitude - on.nu, two_pi));
    e.eccentric_anomaly = on.eccentric;
    e.periapsis_distance = on.q * r;
    e.time_since_periapsis = on.time * (r / speed);
    e.mean_anomaly = on.time * std::sqrt(std::abs(alpha * r)) * std::abs(alpha * r);
    // Rounding of a and q must not make q > a.
    if (alpha > 0) e.periapsis_distance = std::min(e.periapsis_distance, e.semi_major_axis);
  } else {
    e.eccentricity = 0;
    e.true_anomaly = e.eccentric_anomaly = e.mean_anomaly = latitude;
    e.periapsis_distance = e.semi_major_axis;
    e.time_since_periapsis = latitude * (r / speed);
  }
  return e;
}

/// State in the plane of a conic, first axis towards the periapsis; in units of the periapsis distance and
/// the circular speed there.
struct InPlane {
  double x, y, vx, vy;
};

/// State from U_0, U_1, U_2 of the universal variable measured from the periapsis.
InPlane by_universal(const Conic& conic, double u0, double u1, double u2) {
  const double e = conic.eccentricity(), root = std::sqrt(1 + e), r = 1 + e * u2;
  return {1 - u2, root * u1, 0 - u1 / r, root * u0 / r};  // no -0
}

InPlane by_time(const Conic& conic, double time) {
  const detail::Universal<double> u{conic.one_minus_e, 0};
  double turns = 0;
  const double t = detail::within_one_turn(u.alpha, time, turns);
  const auto at = detail::solve(u, t).at;
  // Correct the rounding of s; for a fast hyperbola s is the logarithm of a large number.
  const double off = (t - at.time) / at.r;
  return by_universal(conic, at.u0 - u.alpha * at.u1 * off, at.u1 + at.u0 * off, at.u2 + at.u1 * off);
}

void check_conic(const Conic& c, double mu) {
  check(Gravity{.mu = mu});
  if (!(c.periapsis_distance > 0) || !std::isfinite(c.periapsis_distance) || !(c.one_minus_e <= 1) ||
      !std::isfinite(c.one_minus_e)) {
    throw invalid_argument(
        "a periapsis distance of {} and e = {} make no conic; the distance must be positive, e 0 or more",
        c.periapsis_distance, c.eccentricity());
  }
}

/// State in the frame and units of the user.
State in_space(const Conic& conic, const Orientation& o, const InPlane& p, double mu) {
  const auto [si, ci] = o.inclination;
  const auto [so, co] = o.ascending_node;
  const auto [sw, cw] = o.periapsis_argument;
  const Vec towards(co * cw - so * ci * sw, so * cw + co * ci * sw, si * sw);
  const Vec ahead(-co * sw - so * ci * cw, -so * sw + co * ci * cw, si * cw);
  const double q = conic.periapsis_distance, speed = root_of_ratio(mu, q);
  State state{q * p.x * towards + q * p.y * ahead, speed * (p.vx * towards + p.vy * ahead)};
  if (state.position.isZero(0) || !state.position.allFinite() || !state.velocity.allFinite()) {
    throw invalid_argument(
        "periapsis distance {}, e = {} and mu = {} lead to a distance or a speed that is beyond the range of "
        "doubles; take other units or a smaller e",
        q, conic.eccentricity(), mu);
  }
  return state;
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
  return {.semi_latus_rectum = p,
          .eccentricity = eccentricity,
          .inclination = inclination,
          .ascending_node = ascending_node,
          .periapsis_argument = periapsis_argument,
          .true_anomaly = true_anomaly,
          .semi_major_axis = semi_major_axis,
          .periapsis_distance = semi_major_axis * (1 - eccentricity)};
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
    e.periapsis_distance = std::ldexp(e.periapsis_distance, units.length);
    e.time_since_periapsis = std::ldexp(e.time_since_periapsis, units.time);
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
  const auto of = [](double angle) { return SineCosine{std::sin(angle), std::cos(angle)}; };
  return state_at_true_anomaly({p / (1 + e.eccentricity), 1 - e.eccentricity},
                               {of(e.inclination), of(e.ascending_node), of(e.periapsis_argument)},
                               of(e.true_anomaly / 2), mu);
}

State state_at_true_anomaly(const Conic& conic, const Orientation& orientation, const SineCosine& half,
                            double mu) {
  check_conic(conic, mu);
  const double e = conic.eccentricity(), share = 2 * half.cosine * half.cosine;  // 1 + cos nu
  const double denominator = conic.one_minus_e + e * share;                      // 1 + e cos nu
  if (!(denominator > 0)) {
    throw invalid_argument(
        "the true anomaly lies {} the asymptote of a conic with e = {:.17g}, which is at {:.17g} degrees",
        denominator < 0 ? "beyond" : "on", e, std::acos(-1 / e) / degree);
  }
  const double root = std::sqrt(1 + e), r = (1 + e) / denominator, sine = 2 * half.sine * half.cosine;
  return in_space(
      conic, orientation,
      {r * (share - 1), r * sine, 0 - sine / root, (share - conic.one_minus_e) / root},  // e + cos nu
      mu);
}

State state_at_eccentric_anomaly(const Conic& conic, const Orientation& orientation, const SineCosine& half,
                                 double mu) {
  check_conic(conic, mu);
  const double alpha = conic.one_minus_e, sine = half.sine, u2 = 2 * sine * sine;
  if (!(alpha > 0))
    throw invalid_argument("an eccentric anomaly is one of ellipses, and e = {:.17g} is none",
                           conic.eccentricity());
  return in_space(conic, orientation,
                  by_universal(conic, 1 - u2, 2 * sine * half.cosine / std::sqrt(alpha), u2 / alpha), mu);
}

State state_at_hyperbolic_anomaly(const Conic& conic, const Orientation& orientation, double anomaly,
                                  double mu) {
  check_conic(conic, mu);
  const double alpha = conic.one_minus_e, sine = std::sinh(anomaly / 2), u2 = 2 * sine * sine;
  if (!(alpha < 0))
    throw invalid_argument("a hyperbolic anomaly is one of hyperbolas, and e = {:.17g} is none",
                           conic.eccentricity());
  return in_space(
      conic, orientation,
      by_universal(conic, 1 + u2, 2 * sine * std::cosh(anomaly / 2) / std::sqrt(-alpha), u2 / -alpha), mu);
}

State state_at_mean_anomaly(const Conic& conic, const Orientation& orientation, double anomaly, double mu) {
  check_conic(conic, mu);
  const double alpha = std::abs(conic.one_minus_e);
  if (alpha == 0)
    throw std::invalid_argument("a parabola has no mean anomaly; give the time since periapsis");
  return in_space(conic, orientation, by_time(conic, anomaly / (std::sqrt(alpha) * alpha)), mu);
}

State state_at_time(const Conic& conic, const Orientation& orientation, double time, double mu) {
  check_conic(conic, mu);
  const double q = conic.periapsis_distance;
  return in_space(conic, orientation, by_time(conic, time * (root_of_ratio(mu, q) / q)), mu);
}

}  // namespace nlmech::orbit

#include "nlmech/orbit/elements.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/orbits.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::two_body_series::elements {
namespace {

using nlmech::orbit::Elements;

constexpr double degree = std::numbers::pi / 180;

/// Longitude of the periapsis, Omega + omega, in degrees.
double longitude_of(const Elements& e) { return (e.ascending_node + e.periapsis_argument) / degree; }

/// An element as printed, and with mu of WGS 84 (`computed`) and the implied mu (`with_implied_mu`).
struct Row {
  std::string orbit, element, unit, printed;
  double computed, with_implied_mu;
  std::string remark;
};

/// An orbit with the elements printed in Eq. 3.72 or 3.74.
struct Source {
  Orbit orbit;
  double e;
  std::string axis, longitude, period, on_longitude, on_period;

  /// Implied mu = v^2 r_p/(1 + e); both states are at their periapsis.
  [[nodiscard]] double implied_mu() const {
    return orbit.start.velocity.squaredNorm() * orbit.start.position.norm() / (1 + e);
  }
  [[nodiscard]] Elements by(double mu) const { return orbit::elements_of(orbit.start, mu); }
};

std::vector<Row> rows_of(const Source& s) {
  const double mu = s.implied_mu();
  const Elements computed = s.by(earth_mu), with_implied_mu = s.by(mu);
  const std::string name = s.orbit.name;
  return {
      {name, "a", "m", s.axis, computed.semi_major_axis, with_implied_mu.semi_major_axis, ""},
      {name, "e", "1", scene::format_number(s.e, 2), computed.eccentricity, with_implied_mu.eccentricity, ""},
      {name, "i", "deg", "0", computed.inclination / degree, with_implied_mu.inclination / degree, ""},
      {name, "longitude of the periapsis", "deg", s.longitude, longitude_of(computed),
       longitude_of(with_implied_mu), s.on_longitude},
      {name, "true anomaly", "deg", "", computed.true_anomaly / degree, with_implied_mu.true_anomaly / degree,
       ""},
      {name, "T_p", "s", s.period, computed.period(earth_mu), with_implied_mu.period(mu), s.on_period}};
}

void check(const Source& low, const Source& high, scene::Show& show) {
  const double mu = low.implied_mu();
  const Elements of_low = low.by(earth_mu), of_high = high.by(earth_mu);
  const char *digits = "tools/oracles/two_body_series_orbits.py, all its digits",
             *handbooks = "mu of older handbooks, nine digits; the state has sixteen";
  // oracle: two_body_series_orbits LEO *, HEO *
  show.near("mu implied by the LEO state", {mu, "m^3/s^2"}, 3.98600433e14, 1e-14, handbooks);
  show.near("mu implied by the HEO state", {high.implied_mu(), "m^3/s^2"}, 3.98600433e14, 1e-14, handbooks);
  show.near("mu of WGS 84 over the implied one, less 1", earth_mu / mu - 1, 2.208e-8, 1e-3,
            "3.986004418/3.98600433 - 1 by hand");
  show.near("a of LEO", {low.by(mu).semi_major_axis, "m"}, 7309041.111, 1e-10, digits);
  show.near("T_p of LEO", {of_low.period(earth_mu), "s"}, 6218.7281, 1e-8, digits);
  show.near("T_p of LEO with the implied mu", {low.by(mu).period(mu), "s"}, 6218.7284, 1e-8, digits);
  show.near("T_p of HEO with the implied mu", {high.by(mu).period(mu), "s"}, 44152.6355, 2e-9, digits);
  show.near("e of LEO", of_low.eccentricity, 0.0999999757, 1e-9, digits);
  show.near("e of HEO", of_high.eccentricity, 0.6999999625, 1e-10, digits);
  show.near("longitude of the periapsis of LEO", {longitude_of(of_low), "deg"}, 75, 1e-12,
            "atan2 of the printed position by hand: tan 75 deg = 2 + sqrt(3), sixteen digits");
  show.near("longitude of the periapsis of HEO", {longitude_of(of_high), "deg"}, 75, 1e-12,
            "45 + 30 deg as printed; sixteen digits of the state");
}

void measure(const std::string& place, const std::string& longitude, const Source& source,
             scene::Show& show) {
  const Elements e = source.by(earth_mu);
  show.measured(place + "a", e.semi_major_axis);
  show.measured(place + "e", e.eccentricity);
  show.measured(place + longitude, longitude_of(e));
  show.measured(place + "T_p", e.period(earth_mu));
}

void put(scene::Show& show) {
  const Source low{low_orbit(),      show.printed("elgohary/eq-3.72/LEO/e"),
                   "7.30904e6",      "0 (omega)",
                   "6.21872e3",      "the state stands at its periapsis, at this longitude",
                   "printed cut off"};
  const Source high{high_orbit(), show.printed("elgohary/eq-3.74/HEO/e"),           "2.7e7", "75 (45 + 30)",
                    "4.41526e4",  "Omega and omega alone have no meaning at i = 0", ""};
  std::vector<Row> rows = rows_of(low);
  for (Row& row : rows_of(high)) rows.push_back(std::move(row));
  show.table(rows, {{"orbit", &Row::orbit},
                    {"element", &Row::element},
                    {"unit", &Row::unit},
                    {"printed", &Row::printed},
                    {"mu of WGS 84", &Row::computed, 10},
                    {"implied mu", &Row::with_implied_mu, 10},
                    {"remark", &Row::remark}});
  check(low, high, show);
  measure("elgohary/eq-3.72/LEO/", "omega", low, show);
  measure("elgohary/eq-3.74/HEO/", "Omega + omega", high, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "elements",
           .title = "Elements of both orbits from the printed states",
           .place = "Equations 3.72 and 3.74",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::two_body_series::elements

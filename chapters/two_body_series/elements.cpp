#include "nlmech/orbit/elements.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/two_body_series/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double degree = std::numbers::pi / 180;

/// What Eqs. 3.72 and 3.74 print.
struct Printed {
  const char *a, *longitude, *period;
  double e;
};

Printed printed_of(const Orbit& orbit) {
  if (orbit.order == low_orbit().order) return {"7.30904e6", "0 (omega)", "6.21872e3", 0.1};
  return {"2.7e7", "75 (45 + 30)", "4.41526e4", 0.7};
}

/// mu = v^2 r_p/(1 + e): both states stand at their periapsis.
double implied_mu(const Orbit& orbit) {
  return orbit.start.velocity.squaredNorm() * orbit.start.position.norm() / (1 + printed_of(orbit).e);
}

/// Omega + omega in degrees.
double longitude_of(const orbit::Elements& e) { return (e.ascending_node + e.periapsis_argument) / degree; }

void add_rows(scene::Table& table, const Orbit& orbit) {
  const double mu = implied_mu(orbit);
  const orbit::Elements ours = orbit::elements_of(orbit.start, earth_mu),
                        theirs = orbit::elements_of(orbit.start, mu);
  const Printed printed = printed_of(orbit);
  const auto add = [&](const char* element, const char* unit, const std::string& text, double with_ours,
                       double with_theirs, const char* remark) {
    table.add({orbit.name, element, unit, text, with_ours, with_theirs, remark});
  };
  const bool low = orbit.order == low_orbit().order;
  add("a", "m", printed.a, ours.semi_major_axis, theirs.semi_major_axis, "");
  add("e", "1", fmt::format("{:g}", printed.e), ours.eccentricity, theirs.eccentricity, "");
  add("i", "deg", "0", ours.inclination / degree, theirs.inclination / degree, "");
  add("longitude of the periapsis", "deg", printed.longitude, longitude_of(ours), longitude_of(theirs),
      low ? "the state stands at its periapsis, at this longitude"
          : "Omega and omega alone have no meaning at i = 0");
  add("true anomaly", "deg", "", ours.true_anomaly / degree, theirs.true_anomaly / degree, "");
  add("T_p", "s", printed.period, ours.period(earth_mu), theirs.period(mu), low ? "printed cut off" : "");
}

scene::Showing show() {
  scene::Table table(
      {{"orbit"}, {"element"}, {"unit"}, {"printed"}, {"mu of WGS 84", 10}, {"implied mu", 10}, {"remark"}});
  const Orbit low = low_orbit(), high = high_orbit();
  add_rows(table, low);
  add_rows(table, high);
  const double mu = implied_mu(low);
  const orbit::Elements of_low = orbit::elements_of(low.start, earth_mu),
                        of_high = orbit::elements_of(high.start, earth_mu);
  const char* digits = "tools/oracles/two_body_series_orbits.py, all its digits";
  scene::Showing showing;
  showing.table = std::move(table);
  // oracle: two_body_series_orbits LEO *, HEO *
  showing.quantities = {
      scene::near("mu implied by the LEO state", "m^3/s^2", mu, 3.98600433e14, 1e-14,
                  "mu of older handbooks, nine digits; the state has sixteen"),
      scene::near("mu implied by the HEO state", "m^3/s^2", implied_mu(high), 3.98600433e14, 1e-14,
                  "mu of older handbooks, nine digits; the state has sixteen"),
      scene::near("mu of WGS 84 over the implied one, less 1", "1", earth_mu / mu - 1, 2.208e-8, 1e-3,
                  "3.986004418/3.98600433 - 1 by hand"),
      scene::near("a of LEO", "m", orbit::elements_of(low.start, mu).semi_major_axis, 7309041.111, 1e-10,
                  digits),
      scene::near("T_p of LEO", "s", of_low.period(earth_mu), 6218.7281, 1e-8, digits),
      scene::near("T_p of LEO with the implied mu", "s", orbit::elements_of(low.start, mu).period(mu),
                  6218.7284, 1e-8, digits),
      scene::near("T_p of HEO with the implied mu", "s", orbit::elements_of(high.start, mu).period(mu),
                  44152.6355, 2e-9, digits),
      scene::near("e of LEO", "1", of_low.eccentricity, 0.0999999757, 1e-9, digits),
      scene::near("e of HEO", "1", of_high.eccentricity, 0.6999999625, 1e-10, digits),
      scene::near("longitude of the periapsis of LEO", "deg", longitude_of(of_low), 75, 1e-12,
                  "atan2 of the printed position by hand: tan 75 deg = 2 + sqrt(3), sixteen digits"),
      scene::near("longitude of the periapsis of HEO", "deg", longitude_of(of_high), 75, 1e-12,
                  "45 + 30 deg as printed; sixteen digits of the state")};
  return showing;
}

}  // namespace

void add_elements(scene::Chapter& chapter) {
  struct Row {
    const char* name;
    double (*value)(const orbit::Elements&);
  };
  const auto axis = [](const orbit::Elements& e) { return e.semi_major_axis; };
  const auto eccentricity = [](const orbit::Elements& e) { return e.eccentricity; };
  const auto period = [](const orbit::Elements& e) { return e.period(earth_mu); };
  const auto add = [&chapter](const Orbit& orbit, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
      chapter.add(
          scene::Measurement{fmt::format("elgohary/{}", row.name), {}, [orbit, value = row.value](Workshop&) {
                               const auto elements = orbit::elements_of(orbit.start, earth_mu);
                               return scene::Measured{value(elements), {}};
                             }});
    }
  };
  add(low_orbit(), {{"eq-3.72/LEO/a", axis},
                    {"eq-3.72/LEO/e", eccentricity},
                    {"eq-3.72/LEO/omega", longitude_of},
                    {"eq-3.72/LEO/T_p", period}});
  add(high_orbit(), {{"eq-3.74/HEO/a", axis},
                     {"eq-3.74/HEO/e", eccentricity},
                     {"eq-3.74/HEO/Omega + omega", longitude_of},
                     {"eq-3.74/HEO/T_p", period}});
  chapter.add({.name = "elements",
               .title = "Elements of both orbits from the printed states",
               .place = "Equations 3.72 and 3.74",
               .needs = {},
               .show = [](Workshop&) { return show(); }});
}

}  // namespace nlmech::chapters

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "chapters/two_body_series/orbits/orbits.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::two_body_series::zonal {
namespace {

/// An initial state (metres, seconds, decimal) and the reference state after 86400 s with J_2.
struct ZonalDay {
  const char* name;                   ///< name, such as "LEO"
  std::array<const char*, 6> start;   ///< initial position and velocity
  std::array<const char*, 6> end_j2;  ///< final state to 20 digits by tools/oracles/two_body_series_orbits.py
};

/// A day, s.
inline constexpr double day = 86400;

using Quad = ExtendedReal<34>;

/// LEO of Eq. 3.71; LEO with the velocity tilted by 60 degrees out of the equatorial plane; a nearly circular
/// orbit.
// Taylor series of orders 45 and 50 and RKN12(10) with the gradient in closed form agree to 1e-22 m.
constexpr ZonalDay days[] = {
    {"LEO",
     {"1702547.136867679", "6353992.417071098", "0", "-7886.014053829254", "2113.051097224035", "0"},
     {"4716214.3704235458298", "4749998.9519703381918", "0", "-5997.5458577857867381",
      "5346.8532333571407564", "0"}},
    {"LEO tilted",
     {"1702547.136867679", "6353992.417071098", "0", "-3943.007026914627", "1056.5255486120175",
      "7070.406775"},
     {"3544510.0483122083031", "4581007.8506592658063", "-3355191.8038390635496", "-1887.9190659227612934",
      "5135.8435966509096777", "5879.8284577273064914"}},
    {"CIRC",
     {"7000000", "0", "0", "0", "4700", "5900"},
     {"4532841.9627156031062", "-3542172.7947567830238", "-3979637.2144251580166", "5734.8996777060516273",
      "2776.6232497172643882", "4041.2475851671119507"}}};

orbit::BasicState<Quad> parsed(const std::array<const char*, 6>& digits) {
  orbit::BasicState<Quad> s;
  for (std::size_t i = 0; i < 3; ++i) {
    s.position[static_cast<int>(i)] = Quad(digits[i]);
    s.velocity[static_cast<int>(i)] = Quad(digits[3 + i]);
  }
  return s;
}

/// Errors of the final state with J_2 against the reference.
struct ZonalErrors {
  double position = 0;  ///< m
  double velocity = 0;  ///< m/s
  double energy = 0;    ///< relative change
};

ZonalErrors errors(const orbit::BasicState<Quad>& end, const ZonalDay& d) {
  const orbit::BasicState<Quad> exact = parsed(d.end_j2);
  const auto length = [](const orbit::Vector3<Quad>& v) { return static_cast<double>(Quad(sqrt(v.dot(v)))); };
  const auto field = orbit::earth(2).as<Quad>();
  const Quad before = orbit::energy(parsed(d.start), field), after = orbit::energy(end, field);
  return {length(end.position - exact.position), length(end.velocity - exact.velocity),
          std::abs(static_cast<double>(Quad(after / before - 1)))};
}

/// Initial state rounded to double.
orbit::State start_of(const ZonalDay& d) {
  const auto s = parsed(d.start);
  return {s.position.cast<double>(), s.velocity.cast<double>()};
}

/// Errors of orbit::propagate() in double precision.
ZonalErrors day_in_double(const ZonalDay& d) {
  const auto end = orbit::propagate(start_of(d), 0, day, orbit::earth(2), orbit::AnalyticContinuation{});
  if (!end.status.ok()) throw Failure(end.status);
  return errors({end.x.position.cast<Quad>(), end.x.velocity.cast<Quad>()}, d);
}

/// Errors of orbit::continue_analytically() in quadruple precision.
ZonalErrors day_in_extended(const ZonalDay& d) {
  return errors(orbit::continue_analytically<Quad>(parsed(d.start), Quad(day), orbit::earth(2).as<Quad>(), 30,
                                                   Quad(1e-21)),
                d);
}

/// Acceleration for general integrators: gradient of the potential by dual numbers, independent of the
/// recursion.
struct PotentialGradient {
  static constexpr int dimension = 6;
  orbit::Gravity gravity;

  void acceleration(double /*t*/, const Vector<double, 3>& q, const Vector<double, 3>& /*v*/,
                    Vector<double, 3>& a) const {
    using D = Dual<double, 3>;
    const orbit::BasicState<D> at{variables<double, 3>(q), Vector<D, 3>::Zero()};
    const D minus_potential = orbit::energy(at, gravity.as<D>());
    for (int i = 0; i < 3; ++i) a[i] = -minus_potential.partial[static_cast<std::size_t>(i)];
  }
};

orbit::Vector3<double> by_rkn(const orbit::State& start, int degree) {
  const ivp::Direct system(PotentialGradient{orbit::earth(degree)});
  ivp::State x(6);
  x << start.position, start.velocity;
  const auto end = ivp::integrate(system, x, 0, day,
                                  ivp::Rkn1210{.relative_tolerance = 1e-14, .absolute_tolerance = 1e-14});
  if (!end.status.ok()) throw Failure(end.status);
  return end.x.head<3>();
}

/// States at equidistant times over a day.
std::vector<orbit::State> sampled(const orbit::State& start, int degree, int samples) {
  std::vector<orbit::State> all = {start};
  const auto time = [samples](std::size_t i) { return day * static_cast<double>(i) / samples; };
  const auto observe = [&](const orbit::Step& step) {
    while (all.size() <= static_cast<std::size_t>(samples) && time(all.size()) <= step.t1)
      all.push_back(step.at(time(all.size())));
    return true;
  };
  const auto end =
      orbit::propagate(start, 0, day, orbit::earth(degree), orbit::AnalyticContinuation{}, observe);
  if (!end.status.ok()) throw Failure(end.status);
  all.back() = end.x;
  return all;
}

double distance(const orbit::State& a, const orbit::State& b) { return (a.position - b.position).norm(); }

/// Results of one orbit over a day.
struct Study {
  const ZonalDay* what = nullptr;
  std::vector<orbit::State> kepler, j2, j6;  ///< states at equidistant times
  ZonalErrors in_double, in_extended;        ///< errors with J_2
  double by_rkn_j2 = 0, by_rkn_j6 = 0;       ///< distance of the final positions from rkn1210, m
  double node = 0, node_rate = 0;  ///< rotation of the node with J_2, and by secular theory, degrees
  std::int64_t steps = 0;

  [[nodiscard]] std::string name() const { return what->name; }
  /// Position after a day with J_2.
  [[nodiscard]] const orbit::Vector3<double>& end() const { return j2.back().position; }
  [[nodiscard]] double from_kepler_km() const { return distance(j2.back(), kepler.back()) / 1e3; }
  [[nodiscard]] double further_km() const { return distance(j6.back(), j2.back()) / 1e3; }
};

/// Computes the rotation of the node: from the elements, and by -3/2 n J_2 (R/p)^2 cos i t with the mean
/// motion n.
void turn_of_node(Study& s) {
  const orbit::Elements before = orbit::elements_of(s.j2.front(), earth_mu),
                        after = orbit::elements_of(s.j2.back(), earth_mu);
  const orbit::Gravity g = orbit::earth(2);
  const double degree = 360 / revolution;
  s.node = std::remainder(after.ascending_node - before.ascending_node, revolution) * degree;
  const double motion = revolution / before.period(earth_mu);
  s.node_rate = -1.5 * motion * g.zonal[0] * std::pow(g.radius / before.semi_latus_rectum, 2) *
                std::cos(before.inclination) * day * degree;
}

Study study(const ZonalDay& d, int samples) {
  Study s{&d, {}, {}, {}, day_in_double(d), day_in_extended(d), 0, 0, 0, 0, 0};
  const orbit::State start = start_of(d);
  for (int i = 0; i <= samples; ++i)
    s.kepler.push_back(orbit::propagate_kepler(start, day * i / samples, earth_mu).state);
  s.j2 = sampled(start, 2, samples);
  s.j6 = sampled(start, 6, samples);
  s.by_rkn_j2 = (by_rkn(start, 2) - s.j2.back().position).norm();
  s.by_rkn_j6 = (by_rkn(start, 6) - s.j6.back().position).norm();
  s.steps = orbit::propagate(start, 0, day, orbit::earth(6), orbit::AnalyticContinuation{}).statistics.steps;
  turn_of_node(s);
  return s;
}

std::vector<Study> studies() {
  constexpr int samples = 720;  // some fifty per revolution, for smooth curves
  std::vector<Study> all;
  for (const ZonalDay& d : days) all.push_back(study(d, samples));
  return all;
}

/// Makes the table, one column per orbit.
void tabulate(const std::vector<Study>& all, scene::Show& show) {
  std::vector<scene::Column> orbits = {{"after a day"}};
  for (const Study& s : all) orbits.push_back({s.name(), 15});
  scene::Table table(orbits);
  const auto add = [&](const char* what, int digits, auto get) {
    std::vector<scene::Cell> row = {what};
    for (const Study& s : all) row.emplace_back(scene::format_number(get(s), digits));
    table.add(std::move(row));
  };
  for (Eigen::Index k = 0; k < 3; ++k) {
    constexpr std::array names = {"x (m)", "y (m)", "z (m)"};
    std::vector<scene::Cell> row = {names.at(static_cast<std::size_t>(k))};
    for (const Study& s : all) row.emplace_back(s.end()[k]);
    table.add(std::move(row));
  }
  add("error in double (m)", 2, [](const Study& s) { return s.in_double.position; });
  add("error in quadruple (m)", 2, [](const Study& s) { return s.in_extended.position; });
  add("energy change in double", 2, [](const Study& s) { return s.in_double.energy; });
  add("energy change in quadruple", 2, [](const Study& s) { return s.in_extended.energy; });
  add("J2: distance from Kepler (km)", 4, [](const Study& s) { return s.from_kepler_km(); });
  add("J3 to J6: further (km)", 3, [](const Study& s) { return s.further_km(); });
  add("J2 to J6: distance from rkn1210 (m)", 2, [](const Study& s) { return s.by_rkn_j6; });
  add("steps, J2 to J6", 6, [](const Study& s) { return static_cast<double>(s.steps); });
  show.table(std::move(table));
}

scene::Table data_of(const std::vector<Study>& all) {
  scene::Table data({{"orbit", 3, true},
                     {"hours"},
                     {"x_km"},
                     {"y_km"},
                     {"z_km"},
                     {"j2_from_kepler_km"},
                     {"j6_from_j2_km"}});
  for (const Study& s : all) {
    for (std::size_t i = 0; i < s.j2.size(); ++i) {
      const auto& r = s.j6[i].position;
      data.add({s.name(), 24.0 * static_cast<double>(i) / static_cast<double>(s.j2.size() - 1), r[0] / 1e3,
                r[1] / 1e3, r[2] / 1e3, distance(s.j2[i], s.kepler[i]) / 1e3,
                distance(s.j6[i], s.j2[i]) / 1e3});
    }
  }
  return data;
}

const std::string small = "font 'sans-serif,11'";

/// Draws the first and last revolution of the tilted orbit, seen from above the pole.
void draw_orbit(scene::Panel& panel, double orbit_hours) {
  panel.caption("LEO tilted, from above the pole").x_range(-9, 9).y_range(-9, 9);
  panel.set("xtics 3").set("ytics 3").set("size ratio -1");
  panel.set("margins screen 0.075, screen 0.44, screen 0.17, screen 0.86");
  panel.set("label 3 'Earth' at 0,0 center front textcolor rgb soft_ink " + small);
  panel.key("at graph 0.01, graph 0.99 left top Left reverse samplen 3 " + small);
  panel.also(
      "'+' using (0):(0):(6.378137) every ::::0 with circles fillcolor rgb pale fillstyle solid 1 noborder");
  const auto where = [](const std::string& condition) {
    return "(" + condition + " ? 1e-3*column('x_km') : NaN):(1e-3*column('y_km'))";
  };
  panel.columns("first revolution", where(fmt::format("column('hours') <= {:.3f}", orbit_hours)),
                {"lines", 2}, 1);
  panel.columns("last of the day", where(fmt::format("column('hours') >= 24 - {:.3f}", orbit_hours)),
                {"lines", 1}, 1);
}

void draw(const std::vector<Study>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("One day about the oblate Earth: 1000 to 1900 km from Kepler's ellipse");
  plot.size(1000, 480).data(data_of(all));
  draw_orbit(plot.panel("x (1000 km)", "y (1000 km)"),
             orbit::elements_of(all[1].j2.front(), earth_mu).period(earth_mu) / 3600);
  scene::Panel& right = plot.panel("time (hours)", "distance");
  right.x_range(0, 24).log_y(1e-3, 2e4).set("xtics 4").set("size noratio");
  right.set("margins screen 0.57, screen 0.975, screen 0.17, screen 0.86");
  right.set(
      "ytics ('1 m' 1e-3, '10 m' 1e-2, '100 m' 1e-1, '1 km' 1, '10 km' 10, '100 km' 100, '1000 km' 1000)");
  right.key("at graph 0.98, graph 0.03 right bottom samplen 4 " + small);
  right.set("label 4 'by J_2, from Kepler' at 0.8, 6e3 left " + small);
  right.set("label 5 'by J_3 to J_6, further (dotted)' at 2.2, 11 left " + small);
  for (int k = 0; k < 3; ++k)
    right.columns(all[static_cast<std::size_t>(k)].name(), "hours:j2_from_kepler_km",
                  {"lines dashtype solid", k + 1}, k);
  for (int k = 0; k < 3; ++k) right.columns("", "hours:j6_from_j2_km", {"lines dashtype 3", k + 1}, k);
}

double energy_change(const Study& s) {
  const orbit::Gravity g = orbit::earth(6);
  return std::abs(orbit::energy(s.j6.back(), g) / orbit::energy(s.j6.front(), g) - 1);
}

void check(const std::vector<Study>& all, scene::Show& show) {
  double least = HUGE_VAL, greatest = 0, rkn = 0, change = 0;
  for (const Study& s : all) {
    show.at_most("error in double, " + s.name(), {s.in_double.position, "m"}, 1e-5,
                 "reference in quadruple precision; eps of the start and of each step, grown over 14 "
                 "revolutions");
    show.at_most("error in quadruple precision, " + s.name(), {s.in_extended.position, "m"}, 1e-9,
                 "two independent methods, which agree to 1e-22 m");
    least = std::min(least, s.from_kepler_km());
    greatest = std::max(greatest, s.from_kepler_km());
    rkn = std::max({rkn, s.by_rkn_j2, s.by_rkn_j6});
    change = std::max({change, s.in_double.energy, energy_change(s)});
  }
  const char* range = "regression value: 995 to 1920 km";
  show.near("least distance from Kepler after a day", {least, "km"}, 995, 1e-3, range);
  show.near("greatest distance from Kepler after a day", {greatest, "km"}, 1920, 1e-3, range);
  show.at_most("greatest distance from rkn1210", {rkn, "m"}, 1e-3,
               "rkn1210 at a tolerance of 1e-14, gradient by dual numbers, errors grown over 14 revolutions");
  show.at_most("greatest change of the energy in double", change, 64 * std::numeric_limits<double>::epsilon(),
               "some 200 steps, each eps/2 or so, and what the default tolerance leaves out");
  show.at_most("change of the energy in quadruple precision, CIRC", all[2].in_extended.energy, 1e-18,
               "tolerance 1e-21 in some hundred steps");
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}})
    show.near("turn of the node, " + all[i].name(), {all[i].node, "deg"}, all[i].node_rate, 0.05,
              "first-order theory; oscillations within an orbit are some hundredths of the sum");
}

void put(const std::vector<Study>& all, scene::Show& show) {
  tabulate(all, show);
  draw(all, show);
  check(all, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "zonal-days",
      "R = 6378137 m, J2 = 1.08262668e-3; adaptive continuation in its default setting; "
      "in quadruple precision order 30 and tolerance 1e-21",
      studies);
  return {{.name = "zonal",
           .title = "One-day orbits with zonal harmonics: difference from Kepler's orbits",
           .place = "our own, for the future work of section 3.2.2",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::two_body_series::zonal

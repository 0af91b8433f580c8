#include "chapters/two_body_series/zonal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "chapters/two_body_series/ellipses.hpp"
#include "chapters/two_body_series/orbits.hpp"
#include "chapters/two_body_series/scenes.hpp"
#include "nlmech/ivp/rkn1210.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/series/dual.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// The attraction for integrators in general: the gradient of the potential by dual numbers, with
/// nothing of the recursion.
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
  ivp::State<6> x;
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
  const auto observe = [&](const orbit::ContinuationStep& step) {
    while (all.size() <= static_cast<std::size_t>(samples) && time(all.size()) <= step.t1)
      all.push_back(step.arc.at(time(all.size())));
    return true;
  };
  const auto end =
      orbit::propagate(start, 0, day, orbit::earth(degree), orbit::AnalyticContinuation{}, observe);
  if (!end.status.ok()) throw Failure(end.status);
  all.back() = end.state;
  return all;
}

/// What comes out for a day.
struct Study {
  const ZonalDay* what = nullptr;
  std::vector<orbit::State> kepler, j2, j6;  ///< at equidistant times
  ZonalErrors in_double, in_extended;        ///< by J_2
  double by_rkn_j2 = 0, by_rkn_j6 = 0;       ///< distance between the ends, m
  double node = 0, node_rate = 0;  ///< what the node turns by with J_2, and by secular theory, degrees
  std::int64_t steps = 0;
};

double distance(const orbit::State& a, const orbit::State& b) { return (a.position - b.position).norm(); }

/// Degrees by which the node turns: found, and -3/2 n J_2 (R/p)^2 cos i t of the mean motion.
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
  constexpr int samples = 720;  // some fifty a revolution; with a few, an orbit would have corners
  std::vector<Study> all;
  for (const ZonalDay& d : zonal_days()) all.push_back(study(d, samples));
  return all;
}

double energy_change(const Study& s) {
  const orbit::Gravity g = orbit::earth(6);
  return std::abs(orbit::energy(s.j6.back(), g) / orbit::energy(s.j6.front(), g) - 1);
}

scene::Table table_of(const std::vector<Study>& all) {
  scene::Table table({{"orbit"},
                      {"x after a day (m)", 15},
                      {"y (m)", 15},
                      {"z (m)", 15},
                      {"error in double (m)", 2},
                      {"error in quadruple (m)", 2},
                      {"energy change in double", 2},
                      {"energy change in quadruple", 2},
                      {"J2: distance from Kepler (km)", 4},
                      {"J3 to J6: further (km)", 3},
                      {"J2 to J6: distance from rkn1210 (m)", 2},
                      {"steps, J2 to J6"}});
  for (const Study& s : all) {
    const auto& r = s.j2.back().position;
    table.add({s.what->name, r[0], r[1], r[2], s.in_double.position, s.in_extended.position,
               s.in_double.energy, s.in_extended.energy, distance(s.j2.back(), s.kepler.back()) / 1e3,
               distance(s.j6.back(), s.j2.back()) / 1e3, s.by_rkn_j6, s.steps});
  }
  return table;
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
      data.add({s.what->name, 24.0 * static_cast<double>(i) / static_cast<double>(s.j2.size() - 1),
                r[0] / 1e3, r[1] / 1e3, r[2] / 1e3, distance(s.j2[i], s.kepler[i]) / 1e3,
                distance(s.j6[i], s.j2[i]) / 1e3});
    }
  }
  return data;
}

scene::Showing show(const std::vector<Study>& all) {
  scene::Showing showing;
  showing.table = table_of(all);
  showing.figure = {
      data_of(all),
      "two_body_series-zonal",
      {{"width", "1000"},
       {"height", "480"},
       {"heading", "A day about the oblate Earth: a thousand kilometres from Kepler's ellipse"},
       {"orbit_hours",
        fmt::format("{:.3f}", orbit::elements_of(all[1].j2.front(), earth_mu).period(earth_mu) / 3600)}}};
  double least = HUGE_VAL, greatest = 0, rkn = 0, kept = 0;
  for (const Study& s : all) {
    const std::string name = s.what->name;
    showing.quantities.push_back(scene::at_most("error in double, " + name, "m", s.in_double.position, 1e-5,
                                                "reference in quadruple precision; eps of the start and of "
                                                "each step, grown over 14 revolutions"));
    showing.quantities.push_back(scene::at_most("error in quadruple precision, " + name, "m",
                                                s.in_extended.position, 1e-9,
                                                "two independent methods, which agree to 1e-22 m"));
    least = std::min(least, distance(s.j2.back(), s.kepler.back()) / 1e3);
    greatest = std::max(greatest, distance(s.j2.back(), s.kepler.back()) / 1e3);
    rkn = std::max({rkn, s.by_rkn_j2, s.by_rkn_j6});
    kept = std::max({kept, s.in_double.energy, energy_change(s)});
  }
  const char* range = "recorded: 995 to 1920 km";
  const double eps = std::numeric_limits<double>::epsilon();
  const auto secular = [&](std::size_t i) {
    return scene::near(fmt::format("turn of the node, {}", all[i].what->name), "deg", all[i].node,
                       all[i].node_rate, 0.05,
                       "first-order theory; oscillations within an orbit are some hundredths of the sum");
  };
  showing.quantities.insert(
      showing.quantities.end(),
      {scene::near("least distance from Kepler after a day", "km", least, 995, 1e-3, range),
       scene::near("greatest distance from Kepler after a day", "km", greatest, 1920, 1e-3, range),
       scene::at_most(
           "greatest distance from rkn1210", "m", rkn, 1e-3,
           "rkn1210 at a tolerance of 1e-14, gradient by dual numbers, errors grown over 14 revolutions"),
       scene::at_most("greatest change of the energy in double", "1", kept, 64 * eps,
                      "some 200 steps, each eps/2 or so, and what the default tolerance leaves out"),
       scene::at_most("change of the energy in quadruple precision, CIRC", "1", all[2].in_extended.energy,
                      1e-18, "tolerance 1e-21 in some hundred steps"),
       secular(1), secular(2)});
  return showing;
}

}  // namespace

void add_zonal(scene::Chapter& chapter) {
  const auto& run =
      chapter.add_run<std::vector<Study>>("zonal-days",
                                          "R = 6378137 m, J2 = 1.08262668e-3; adaptive continuation in its "
                                          "default setting; in quadruple precision "
                                          "order 30 and tolerance 1e-21",
                                          {}, [](Workshop&) { return studies(); });
  chapter.add({.name = "zonal",
               .title = "Orbits of a day with zonal harmonics, and their difference to Kepler",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/algebraic_series/samples.hpp"
#include "chapters/algebraic_series/scenes.hpp"
#include "nlmech/problems/bodies.hpp"

namespace nlmech::chapters {
namespace {

using problems::FourBodies;
using scene::Workshop;
using State = ivp::State<Eigen::Dynamic>;

struct Orbits {
  std::vector<Sample<Eigen::Dynamic>> path;  ///< to t = 3000, every 5
  std::int64_t steps = 0;
  double energy_drift = 0;    ///< greatest, relative
  double momentum_drift = 0;  ///< greatest, relative to the momentum of body 4
  double nearest = HUGE_VAL;  ///< of two bodies
};

double nearest_distance(const State& x) {
  double nearest = HUGE_VAL;
  for (Eigen::Index i = 0; i < 4; ++i) {
    for (Eigen::Index k = i + 1; k < 4; ++k)
      nearest = std::min(nearest, (x.segment<3>(3 * k) - x.segment<3>(3 * i)).norm());
  }
  return nearest;
}

Orbits orbits() {
  const FourBodies problem;
  const ivp::System<Eigen::Dynamic> system(problem);
  const State x0 = FourBodies::initial_state();
  Orbits all;
  all.path = sampled<Eigen::Dynamic>(system, x0, 0, FourBodies::final_time, accurate_series(), 5);
  const auto kept = [&](const State& x) { return problem.invariants(0.0, Vector<double, 24>(x)); };
  const Vector<double, 4> first = kept(x0);
  const double momentum = first.head<3>().norm();
  for (const auto& s : all.path) {
    const Vector<double, 4> now = kept(s.x);
    all.energy_drift = std::max(all.energy_drift, std::abs(now[3] / first[3] - 1));
    all.momentum_drift = std::max(all.momentum_drift, (now - first).head<3>().norm() / momentum);
    all.nearest = std::min(all.nearest, nearest_distance(s.x));
  }
  return all;
}

scene::Showing show_data() {
  const FourBodies problem;
  const auto x0 = FourBodies::initial_state();
  scene::Table table({{"body"}, {"initial position"}, {"initial velocity"}, {"mass"}, {"remark"}});
  const auto triple = [&](int at) {
    return "(" + scene::format_number(x0[at], 4) + ", " + scene::format_number(x0[at + 1], 4) + ", " +
           scene::format_number(x0[at + 2], 4) + ")";
  };
  double mass = 0;
  for (int i = 0; i < 4; ++i) {
    mass += problem.mass[static_cast<std::size_t>(i)];
    table.add({std::int64_t{i + 1}, triple(3 * i), triple(12 + 3 * i),
               problem.mass[static_cast<std::size_t>(i)], "as printed"});
  }
  table.add({"G", "", "", problem.gravity, "not printed: assumed, see the page"});
  // By hand from the printed table: 3^-1 + 5/5 + 5/4 + 1/sqrt(4.5) (twice) + 5/sqrt(8.5).
  const double energy = 0.5 * (0.00125 * 0.00125 + 2 * 0.0005 * 0.0005) -
                        1e-6 * (1 / 3.0 + 1 + 1.25 + 2 / std::sqrt(4.5) + 5 / std::sqrt(8.5));
  return {{},
          table,
          {scene::near("sum of the masses", "1", mass, 8, 0, "1 + 1 + 5 + 1 by hand; exact"),
           scene::near("energy", "1", problem.invariants(0.0, x0)[3], energy, 1e-14,
                       "from distances by hand; rounding")}};
}

scene::Showing show(const Orbits& all) {
  scene::Table data({{"t_s"},
                     {"x1"},
                     {"y1"},
                     {"z1"},
                     {"x2"},
                     {"y2"},
                     {"z2"},
                     {"x3"},
                     {"y3"},
                     {"z3"},
                     {"x4"},
                     {"y4"},
                     {"z4"}});
  for (const auto& s : all.path) {
    std::vector<scene::Cell> row = {s.t};
    for (int i = 0; i < 12; ++i) row.emplace_back(s.x[i]);
    data.add(std::move(row));
  }
  scene::Showing showing;
  showing.figure = {
      std::move(data),
      "algebraic_series-bodies",
      {{"heading", "Four bodies to t = 3000: bodies 1 and 2 are about to meet"}, {"width", "900"}}};
  const State& end = all.path.back().x;
  // oracle: algebraic_series_motions bodies *
  const char* known =
      "tools/oracles/algebraic_series_motions.py; double precision loses five digits to the encounters";
  const auto near = [&](const char* name, double value, double reference) {
    return scene::near(name, "1", value, reference, 1e-10, known);
  };
  showing.quantities = {near("x of body 4 at t = 3000", end[9], -0.2510470313435667),
                        near("y of body 4 at t = 3000", end[10], 3.071464269641001),
                        near("z of body 4 at t = 3000", end[11], 0.9195961609759894),
                        near("x of body 1 at t = 3000", end[0], 1.882222659858648),
                        near("y of body 1 at t = 3000", end[1], 2.142167279707004),
                        near("z of body 1 at t = 3000", end[2], 0.1432282180354737),
                        scene::at_most("relative drift of the energy", "1", all.energy_drift, 1e-12,
                                       "rounding of a few thousand steps, sums of opposite signs"),
                        scene::at_most("relative drift of the momentum", "1", all.momentum_drift, 1e-13,
                                       "rounding of a few thousand steps")};
  return showing;
}

}  // namespace

void add_bodies(scene::Chapter& chapter) {
  chapter.add({.name = "table-1",
               .title = "Data of the four bodies",
               .place = "Table 1",
               .needs = {},
               .show = [](Workshop&) { return show_data(); }});
  const auto& run = chapter.add_run<Orbits>(
      "four-bodies",
      "G T^2 = 1e-6 assumed, with the printed velocities in physical time; G, T, the order and the duration "
      "are not printed; order and steps by the radius of convergence",
      {}, [](Workshop&) { return orbits(); });
  chapter.add({.name = "fig-2",
               .title = "Paths of four bodies under mutual gravitation",
               .place = "Figure 2",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters

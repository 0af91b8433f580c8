#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chapters/algebraic_series/samples.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::bodies {
namespace {

using problems::TextProblem;
using State = ivp::State;

struct Orbits {
  std::vector<Sample> path;   ///< every 5 to t = 3000
  double energy_drift = 0;    ///< largest relative error
  double momentum_drift = 0;  ///< largest error, relative to the initial momentum, which is that of body 4
};

Orbits orbits() {
  const TextProblem problem("bodies");
  const ivp::System system(problem);
  const State& x0 = problem.initial_state();
  Orbits all;
  all.path = sampled(system, x0, 0, problem.final_time, accurate_series(), 5);
  const Vector<double, 4> first = problem.invariants(0.0, x0);
  const double momentum = first.head<3>().norm();
  for (const auto& s : all.path) {
    const Vector<double, 4> now = problem.invariants(0.0, s.x);
    all.energy_drift = std::max(all.energy_drift, std::abs(now[3] / first[3] - 1));
    all.momentum_drift = std::max(all.momentum_drift, (now - first).head<3>().norm() / momentum);
  }
  return all;
}

void put_data(scene::Show& show) {
  const TextProblem problem("bodies");
  const State& x0 = problem.initial_state();
  const auto triple = [&](int at) {
    return "(" + scene::format_number(x0[at], 4) + ", " + scene::format_number(x0[at + 1], 4) + ", " +
           scene::format_number(x0[at + 2], 4) + ")";
  };
  scene::Table table({{"body"}, {"initial position"}, {"initial velocity"}, {"mass"}, {"remark"}});
  double sum = 0;
  for (int body = 0; body < 4; ++body) {
    const double mass = problem.parameter(fmt::format("m{}", body + 1));
    table.add({body + 1, triple(3 * body), triple(12 + 3 * body), mass, "as printed"});
    sum += mass;
  }
  table.add({"G", "", "", problem.parameter("gravity"), "not printed: assumed, see the page"});
  show.table(std::move(table));
  // By hand from the printed table: 3^-1 + 5/5 + 5/4 + 1/sqrt(4.5) (twice) + 5/sqrt(8.5).
  const double energy = 0.5 * (0.00125 * 0.00125 + 2 * 0.0005 * 0.0005) -
                        1e-6 * (1 / 3.0 + 1 + 1.25 + 2 / std::sqrt(4.5) + 5 / std::sqrt(8.5));
  show.equals("sum of the masses", sum, 8, "1 + 1 + 5 + 1 by hand; exact");
  show.near("energy", problem.invariants(0.0, x0)[3], energy, 1e-14, "from distances by hand; rounding");
}

/// Line style and name of a body.
struct Curve {
  int style, width;
  const char* name;
};
constexpr std::array curves = {Curve{1, 2, "body 1, mass 1"}, Curve{5, 2, "body 2, mass 1"},
                               Curve{3, 4, "body 3, mass 5"}, Curve{4, 2, "body 4, mass 1"}};

void draw(const Orbits& all, scene::Show& show) {
  scene::ColumnsOf<decltype(all.path)> columns = {{"t_s", &Sample::t}};
  for (int i = 0; i < 12; ++i)
    columns.push_back({fmt::format("{}{}", "xyz"[i % 3], i / 3 + 1), Component{i}});
  scene::Plot& plot = show.plots("Paths of four bodies to t = 3000: bodies 1 and 2 approach each other");
  plot.size(900, 520).data(scene::table_of(all.path, columns));
  for (const char up : {'y', 'z'}) {
    scene::Panel& panel = plot.panel("{/:Italic x}", fmt::format("{{/:Italic {}}}", up));
    panel.x_range(-0.5, 3.5).key("inside top right samplen 2");
    up == 'y' ? panel.y_range(-0.5, 4.5) : panel.y_range(-0.2, 2);
    for (std::size_t k = 0; k < curves.size(); ++k) {
      const Curve& c = curves.at(k);
      panel.columns(up == 'z' ? c.name : "", fmt::format("x{0}:{1}{0}", k + 1, up),
                    {fmt::format("lines dashtype solid linewidth {}", c.width), c.style});
      panel.columns("", fmt::format("x{0}:(column(0) == 0 ? column('{1}{0}') : NaN)", k + 1, up),
                    {"points pointtype 7 pointsize 1", c.style});
    }
  }
}

void put_paths(const Orbits& all, scene::Show& show) {
  draw(all, show);
  const State& end = all.path.back().x;
  // oracle: algebraic_series_motions bodies *
  const auto check = [&](const char* name, double value, double known) {
    show.near(
        name, value, known, 1e-10,
        "tools/oracles/algebraic_series_motions.py; double precision loses five digits to the encounters");
  };
  check("x of body 4 at t = 3000", end[9], -0.2510470313435667);
  check("y of body 4 at t = 3000", end[10], 3.071464269641001);
  check("z of body 4 at t = 3000", end[11], 0.9195961609759894);
  check("x of body 1 at t = 3000", end[0], 1.882222659858648);
  check("y of body 1 at t = 3000", end[1], 2.142167279707004);
  check("z of body 1 at t = 3000", end[2], 0.1432282180354737);
  show.at_most("relative drift of the energy", all.energy_drift, 1e-12,
               "rounding of a few thousand steps, sums of opposite signs");
  show.at_most("relative drift of the momentum", all.momentum_drift, 1e-13,
               "rounding of a few thousand steps");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "four-bodies",
      "G T^2 = 1e-6 assumed, with the printed velocities in physical time; G, T, the order and the duration "
      "are not printed; order and steps by the radius of convergence",
      orbits);
  return {{.name = "table-1",
           .title = "Data of the four bodies",
           .place = "Table 1",
           .content = scene::Content(put_data)},
          {.name = "fig-2",
           .title = "Paths of four bodies under mutual gravitation",
           .place = "Figure 2",
           .content = scene::Content(put_paths, result)}};
}

}  // namespace nlmech::chapters::algebraic_series::bodies

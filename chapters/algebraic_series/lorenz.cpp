#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::lorenz {
namespace {

using Path = std::vector<Both>;

Motion compute() { return motion(lorenz_example(), published_series(0.1, 20), lorenz_example().t1, 0.01); }

scene::Table data_of(const Path& path) {
  return scene::table_of(path, {{"t", &Both::t},
                                {"u", Exact{0}},
                                {"v", Exact{1}},
                                {"w", Exact{2}},
                                {"u_printed", Printed{0}},
                                {"v_printed", Printed{1}},
                                {"w_printed", Printed{2}}});
}

void put_time(const Motion& m, scene::Show& show) {
  show.plot("Lorenz: the printed steps (T = 0.1) miss the jumps of v after t = 16", "{/:Italic t}",
            "{/:Italic v}")
      .x_range(0, 20)
      .y_range(-30, 30)
      .key("below")
      .columns("T = 0.1, N = 20, as printed", "t:v_printed", {"lines dashtype solid linewidth 1.6", 2})
      .columns("solution", "t:v", {"lines linewidth 1.6", 1});
  show.figure().data(data_of(m.path));
  const auto& end = m.path.back();
  // oracle: algebraic_series_motions Lorenz ?(20), Lorenz T = 0.1: u(20), Lorenz T = 0.1: error at 0.5,
  // Lorenz T = 0.1: above 1 from
  const char* known = "tools/oracles/algebraic_series_motions.py; double loses eight digits by then";
  show.near("u(20)", end.exact[0], -1.356348984580380, 1e-6, known);
  show.near("v(20)", end.exact[1], -2.387300052277071, 1e-6, known);
  show.near("w(20)", end.exact[2], 12.38998499408597, 1e-6, known);
  show.near("u(20) with the printed steps", end.printed[0], -4.78, 2e-3,
            "tools/oracles/algebraic_series_motions.py: -4.78; half a unit of its last digit, and "
            "rounding of 1e-7");
  const auto greatest = [&](bool printed) {
    double size = 0;
    for (const Both& b : m.path) size = std::max(size, (printed ? b.printed : b.exact).cwiseAbs().maxCoeff());
    return size;
  };
  show.between("greatest component by the printed steps over that of the solution",
               greatest(true) / greatest(false), 0.8, 1.2, "both stay on the attractor");
  show.near("error of the printed steps at t = 0.5", m.departure.error.at(4), 0.83, 0.01,
            "tools/oracles/algebraic_series_motions.py: 0.83; half a unit of its last digit");
  show.near("time at which the printed steps err by more than 1", m.departure.first_above(1).value_or(NAN),
            3.3, 0.04, "tools/oracles/algebraic_series_motions.py: 3.3; steps are 0.1 long");
}

void put_phase(const Motion& m, scene::Show& show) {
  scene::Plot& plot = show.plots("Lorenz to t = 20: the printed steps miss one wing of the attractor");
  plot.size(900, 520).data(data_of(m.path));
  const auto panel = [&](const char* caption, const char* columns, const scene::CurveStyle& look) {
    plot.panel("{/:Italic u}", "{/:Italic w}")
        .caption(caption)
        .x_range(-20, 22)
        .y_range(0, 50)
        .columns("", columns, look);
  };
  panel("solution", "u:w", {"lines linewidth 1.2", 1});
  panel("T = 0.1, N = 20, as printed", "u_printed:w_printed", {"lines dashtype solid linewidth 1.2", 5});
  const auto [lowest, highest] = std::ranges::minmax_element(m.path, {}, Exact{0});
  const double least = lowest->exact[0], most = highest->exact[0];
  // oracle: algebraic_series_motions Lorenz least, Lorenz greatest
  const char* known =
      "tools/oracles/algebraic_series_motions.py; samples every 0.01 miss the peak by 0.02 or less";
  show.near("least u", least, -16.336, 0.002, known);
  show.near("greatest u", most, 19.829, 0.002, known);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "lorenz", "T = 0.1 and N = 20 as printed, beside order and steps by the radius of convergence; t to 20",
      compute);
  return {{.name = "fig-3a",
           .title = "Lorenz system: v in time",
           .place = "Figure 3a",
           .content = scene::Content(put_time, result)},
          {.name = "fig-3b",
           .title = "Lorenz system: attractor in phase space",
           .place = "Figure 3b",
           .content = scene::Content(put_phase, result)}};
}

}  // namespace nlmech::chapters::algebraic_series::lorenz

#include <algorithm>
#include <ranges>
#include <utility>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::oscillator {
namespace {

constexpr double euler_step = 0.01;  // the paper states the method, but not the step size

struct Motions {
  std::vector<Sample> series;  ///< T = 0.125, N = 50; every 0.05 s to 375 s
  std::vector<Sample> euler;   ///< forward Euler; every 0.05 s to 40 s
  Departure departure;         ///< departure of the series, to 750 s
};

Motions compute() {
  const auto& c = oscillator_example();
  const auto printed = published_series(0.125, 50);
  return {sampled(c.system, c.x0, c.t0, c.t1, printed, 0.05),
          sampled(c.system, c.x0, c.t0, c.t0 + 40, ivp::Euler{.step = euler_step}, 0.05),
          departure(c, printed, c.t0 + 750)};
}

void put_time(const Motions& m, scene::Show& show) {
  scene::Table data({{"t_s"}, {"series"}, {"euler"}});
  int crossings = 0;
  for (std::size_t i = 0; i < m.euler.size(); ++i) {
    const double t = m.series[i].t, x = m.series[i].x[0];
    data.add({t, x, m.euler[i].x[0]});
    if (i > 0 && t <= 28.14 && x * m.series[i - 1].x[0] < 0) ++crossings;
  }
  show.plot("Displacement: forward Euler (0.01 s) departs from the series before 30 s", "{/:Italic t} (s)",
            "{/:Italic x}")
      .x_range(3, 43.2)
      .y_range(-0.8, 0.8)
      .key("below")
      .columns("forward Euler, h = 0.01 s", "t_s:euler", {"lines dashtype solid linewidth 1.8", 2})
      .columns("series, T = 0.125 s, N = 50", "t_s:series", {"lines linewidth 1.8", 1});
  show.figure().data(std::move(data));
  // oracle: algebraic_series_motions oscillator x, oscillator v
  const char* known = "tools/oracles/algebraic_series_motions.py; rounding of 3000 steps";
  const auto& end = m.series.back().x;
  show.near("x at 375 s", end[0], -0.302938936512582, 1e-9, known);
  show.near("x' at 375 s", end[1], -0.198146428424553, 1e-9, known);
  show.at_most("greatest error of the printed steps to 750 s", m.departure.greatest(800), 3e-10,
               "regression value: 7e-11; rounding, which scatters");
  show.equals("zeros of x up to 28.14 s", crossings, 4, "two waves, as the paper describes");
}

void put_phase(const Motions& m, scene::Show& show) {
  show.plot("Phase plane over 375 s: no decay and no growth", "{/:Italic x}",
            "d{/:Italic x}/d{/:Italic t} (1/s)")
      .x_range(-0.6, 0.6)
      .y_range(-0.4, 0.4)
      .columns("", "x:v", {"lines linewidth 0.8", 1});
  show.figure().size(620, 600).data(scene::table_of(m.series, {{"x", Component{0}}, {"v", Component{1}}}));
  const auto [least, most] = std::ranges::minmax(m.series | std::views::transform(Component{0}));
  // oracle: algebraic_series_motions oscillator least, oscillator greatest
  const char* known =
      "tools/oracles/algebraic_series_motions.py; samples every 0.05 s miss a peak by 1e-4 or less";
  show.near("least x", least, -0.50008, 3e-4, known);
  show.near("greatest x", most, 0.49953, 3e-4, known);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result("oscillator",
                             "T = 0.125 s and N = 50 as printed; forward Euler with h = 0.01 s, the largest "
                             "step that departs visibly as late as in the paper",
                             compute);
  return {{.name = "fig-5",
           .title = "Oscillator with nonlinear damping modulated in time: series and forward Euler",
           .place = "Figure 5",
           .content = scene::Content(put_time, result)},
          {.name = "fig-6a",
           .title = "Oscillator with nonlinear damping modulated in time: phase plane up to 375 s",
           .place = "Figure 6a",
           .content = scene::Content(put_phase, result)}};
}

}  // namespace nlmech::chapters::algebraic_series::oscillator

#include <cmath>
#include <limits>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/scenes.hpp"
#include "nlmech/ivp/explicit_runge_kutta.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double euler_step = 0.01;  // the paper names the method, not the step

struct Motions {
  std::vector<Sample<2>> series;  ///< T = 0.125, N = 50, every twentieth to 375 s
  std::vector<Sample<2>> euler;   ///< forward Euler, the same to 40 s
  Departure departure;            ///< of the series, to 750 s
};

Motions move() {
  const auto& c = oscillator_example();
  const auto printed = published_series(0.125, 50);
  return {sampled<2>(c.system, c.x0, c.t0, c.t1, printed, 0.05),
          sampled<2>(c.system, c.x0, c.t0, c.t0 + 40, ivp::Euler{.step = euler_step}, 0.05),
          departure(c, printed, c.t0 + 750)};
}

scene::Showing show_time(const Motions& m) {
  scene::Table data({{"t_s"}, {"series"}, {"euler"}});
  int crossings = 0;
  for (std::size_t i = 0; i < m.euler.size(); ++i) {
    const double t = m.series[i].t, x = m.series[i].x[0];
    data.add({t, x, m.euler[i].x[0]});
    if (i > 0 && t <= 28.14 && x * m.series[i - 1].x[0] < 0) ++crossings;
  }
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "algebraic_series-oscillator-time",
                    {{"heading", "Forward Euler (h = 0.01 s) parts from the series before 30 s"}}};
  // oracle: algebraic_series_motions oscillator x, oscillator v
  const char* known = "tools/oracles/algebraic_series_motions.py; rounding of 3000 steps";
  const auto& end = m.series.back().x;
  showing.quantities = {
      scene::near("x at 375 s", "1", end[0], -0.302938936512582, 1e-9, known),
      scene::near("x' at 375 s", "1", end[1], -0.198146428424553, 1e-9, known),
      scene::at_most("greatest error of the printed steps to 750 s", "1", m.departure.greatest(800), 3e-10,
                     "recorded: 7e-11; rounding, which scatters"),
      scene::near("zeros of x up to 28.14 s", "1", crossings, 4, 0, "two waves, as the paper describes")};
  return showing;
}

scene::Showing show_phase(const Motions& m) {
  scene::Table data({{"x"}, {"v"}});
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const auto& s : m.series) {
    data.add({s.x[0], s.x[1]});
    least = std::min(least, s.x[0]);
    most = std::max(most, s.x[0]);
  }
  scene::Showing showing;
  showing.figure = {
      std::move(data),
      "algebraic_series-oscillator-phase",
      {{"heading", "375 s in the phase plane: no damping, no growth"}, {"width", "620"}, {"height", "600"}}};
  // oracle: algebraic_series_motions oscillator least, oscillator greatest
  const char* known =
      "tools/oracles/algebraic_series_motions.py; samples every 0.05 s miss a peak by 1e-4 or less";
  showing.quantities = {scene::near("least x", "1", least, -0.50008, 3e-4, known),
                        scene::near("greatest x", "1", most, 0.49953, 3e-4, known)};
  return showing;
}

}  // namespace

void add_oscillator(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Motions>(
      "oscillator",
      "T = 0.125 s and N = 50 as printed; forward Euler with h = 0.01 s, the largest step whose departure "
      "becomes visible where the paper sees it",
      {}, [](Workshop&) { return move(); });
  chapter.add({.name = "fig-5",
               .title = "Oscillator with nonlinear damping modulated in time: series beside forward Euler",
               .place = "Figure 5",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_time(w.result(run)); }});
  chapter.add({.name = "fig-6a",
               .title = "The same in the phase plane, up to 375 s",
               .place = "Figure 6a",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_phase(w.result(run)); }});
}

}  // namespace nlmech::chapters

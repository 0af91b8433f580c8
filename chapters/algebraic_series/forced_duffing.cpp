#include <cmath>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

struct Motions {
  std::vector<Sample<2>> printed, accurate;  ///< every twentieth to t = 100
  Departure departure;                       ///< of the printed steps, to t = 100
};

Motions move() {
  const auto& c = forced_duffing_example();
  const auto printed = published_series(0.35, 20);
  return {sampled<2>(c.system, c.x0, 0, 100, printed, 0.05),
          sampled<2>(c.system, c.x0, 0, 100, accurate_series(), 0.05), departure(c, printed, 100)};
}

scene::Table data_of(const Motions& m, double end) {
  scene::Table data({{"tau"}, {"u"}, {"v"}, {"u_printed"}, {"v_printed"}});
  for (std::size_t i = 0; i < m.accurate.size() && m.accurate[i].t <= end + 1e-9; ++i) {
    const auto &x = m.accurate[i].x, &y = m.printed[i].x;
    data.add({m.accurate[i].t / 0.35, x[0], x[1], y[0], y[1]});
  }
  return data;
}

scene::Showing show_time(const Motions& m) {
  scene::Showing showing;
  showing.figure = {data_of(m, 50),
                    "algebraic_series-duffing-time",
                    {{"heading", "Forced Duffing oscillator: the printed steps are right to the eye"}}};
  const Sample<2>&half = m.accurate.at(1000), &full = m.accurate.back();
  // oracle: algebraic_series_motions Duffing u(*, Duffing v(*, Duffing T = 0.35: greatest error, Duffing T =
  // 0.35: above 1e-3 from
  const char* known = "tools/oracles/algebraic_series_motions.py; rounding grows to 1e-11 on the way";
  showing.quantities = {
      scene::near("u(50)", "1", half.x[0], 1.221946638567542, 1e-10, known),
      scene::near("u'(50)", "1", half.x[1], 5.565479787665349, 1e-10, known),
      scene::near("u(100)", "1", full.x[0], 0.694891370844674, 1e-8, known),
      scene::near("u'(100)", "1", full.x[1], 3.554260292257302, 1e-8, known),
      scene::near("greatest error of the printed steps to t = 100", "1", m.departure.greatest(100), 0.63,
                  0.01, "tools/oracles/algebraic_series_motions.py: 0.63; half a unit of its last digit"),
      scene::near("time at which the printed steps err by more than 1e-3", "1",
                  m.departure.first_above(1e-3).value_or(NAN), 1.75, 1e-9,
                  "tools/oracles/algebraic_series_motions.py: the fifth step")};
  return showing;
}

scene::Showing show_phase(const Motions& m) {
  scene::Showing showing;
  showing.figure = {data_of(m, 100),
                    "algebraic_series-duffing-phase",
                    {{"heading", "Its phase plane: bounded, and never twice the same way"},
                     {"width", "620"},
                     {"height", "600"}}};
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const auto& s : m.accurate) {
    least = std::min(least, s.x[0]);
    most = std::max(most, s.x[0]);
  }
  // oracle: algebraic_series_motions Duffing least, Duffing greatest
  const char* known =
      "tools/oracles/algebraic_series_motions.py; samples every 0.05 miss a peak by 0.02 or less";
  showing.quantities = {scene::near("least u", "1", least, -3.354, 0.006, known),
                        scene::near("greatest u", "1", most, 3.344, 0.006, known)};
  return showing;
}

}  // namespace

void add_forced_duffing(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Motions>(
      "forced-duffing",
      "T = 0.35 and N = 20 as printed, beside order and steps by the radius of convergence; the figure's end "
      "is not printed: 50 in time, 100 in the phase plane",
      {}, [](Workshop&) { return move(); });
  chapter.add({.name = "fig-4a",
               .title = "Forced Duffing oscillator: displacement in time",
               .place = "Figure 4a",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_time(w.result(run)); }});
  chapter.add({.name = "fig-4b",
               .title = "Forced Duffing oscillator: phase plane",
               .place = "Figure 4b",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_phase(w.result(run)); }});
}

}  // namespace nlmech::chapters

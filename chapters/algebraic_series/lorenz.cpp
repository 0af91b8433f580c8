#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// The printed steps, and the solution.
struct Butterflies {
  std::vector<Sample<3>> printed, accurate;  ///< every hundredth to t = 20
  Departure departure;                       ///< of the printed steps
};

Butterflies fly() {
  const auto& c = lorenz_example();
  const auto printed = published_series(0.1, 20);
  return {sampled<3>(c.system, c.x0, c.t0, c.t1, printed, 0.01),
          sampled<3>(c.system, c.x0, c.t0, c.t1, accurate_series(), 0.01), departure(c, printed, c.t1)};
}

scene::Table data_of(const Butterflies& b) {
  scene::Table data({{"t"}, {"u"}, {"v"}, {"w"}, {"u_printed"}, {"v_printed"}, {"w_printed"}});
  for (std::size_t i = 0; i < b.accurate.size(); ++i) {
    const auto &x = b.accurate[i].x, &y = b.printed[i].x;
    data.add({b.accurate[i].t, x[0], x[1], x[2], y[0], y[1], y[2]});
  }
  return data;
}

scene::Showing show_time(const Butterflies& b) {
  scene::Showing showing;
  showing.figure = {data_of(b),
                    "algebraic_series-lorenz-time",
                    {{"heading", "Lorenz: with the printed T = 0.1 another trajectory after three units"}}};
  const auto& end = b.accurate.back().x;
  // oracle: algebraic_series_motions Lorenz ?(20), Lorenz T = 0.1: u(20), Lorenz T = 0.1: error at 0.5,
  // Lorenz T = 0.1: above 1 from
  const char* known = "tools/oracles/algebraic_series_motions.py; double loses eight digits on the way";
  showing.quantities = {
      scene::near("u(20)", "1", end[0], -1.356348984580380, 1e-6, known),
      scene::near("v(20)", "1", end[1], -2.387300052277071, 1e-6, known),
      scene::near("w(20)", "1", end[2], 12.38998499408597, 1e-6, known),
      scene::near("u(20) with the printed steps", "1", b.printed.back().x[0], -4.78, 2e-3,
                  "tools/oracles/algebraic_series_motions.py: -4.78; half a unit of its last digit, and "
                  "rounding of 1e-7"),
      scene::near("error of the printed steps at t = 0.5", "1", b.departure.error.at(4), 0.83, 0.01,
                  "tools/oracles/algebraic_series_motions.py: 0.83; half a unit of its last digit"),
      scene::near("time at which the printed steps err by more than 1", "1",
                  b.departure.first_above(1).value_or(NAN), 3.3, 0.04,
                  "tools/oracles/algebraic_series_motions.py: 3.3; steps are 0.1 long")};
  return showing;
}

scene::Showing show_phase(const Butterflies& b) {
  scene::Showing showing;
  showing.figure = {data_of(b),
                    "algebraic_series-lorenz-phase",
                    {{"heading", "With the printed steps the butterfly has lost a wing"}, {"width", "900"}}};
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const auto& s : b.accurate) {
    least = std::min(least, s.x[0]);
    most = std::max(most, s.x[0]);
  }
  // oracle: algebraic_series_motions Lorenz least, Lorenz greatest
  const char* known =
      "tools/oracles/algebraic_series_motions.py; samples every 0.01 miss the peak by 0.02 or less";
  showing.quantities = {scene::near("least u", "1", least, -16.336, 0.002, known),
                        scene::near("greatest u", "1", most, 19.829, 0.002, known)};
  return showing;
}

}  // namespace

void add_lorenz(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Butterflies>(
      "lorenz", "T = 0.1 and N = 20 as printed, beside order and steps by the radius of convergence; t to 20",
      {}, [](Workshop&) { return fly(); });
  chapter.add({.name = "fig-3a",
               .title = "Lorenz system: v in time",
               .place = "Figure 3a",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_time(w.result(run)); }});
  chapter.add({.name = "fig-3b",
               .title = "Lorenz system: attractor in phase space",
               .place = "Figure 3b",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_phase(w.result(run)); }});
}

}  // namespace nlmech::chapters

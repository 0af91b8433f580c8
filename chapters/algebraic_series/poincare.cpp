#include <algorithm>
#include <cmath>
#include <vector>

#include "chapters/algebraic_series/scenes.hpp"
#include "chapters/algebraic_series/sections.hpp"

namespace nlmech::chapters {
namespace {

using problems::StrongOscillator;
using scene::Workshop;
using States = std::vector<ivp::State<2>>;

constexpr std::int64_t many = 20'000;
constexpr double printed_time = 750;  // s
// The elliptic orbit of 31 periods in the middle of the islands starts here at rest.
/// Of the island. oracle: algebraic_series_motions period 31 at
const ivp::State<2> centre(-0.500135737928720, 0);

std::int64_t sections_within(double seconds) {
  return static_cast<std::int64_t>(seconds / 3.14159265358979323846) + 1;
}

scene::Showing show_printed(const States& all) {
  scene::Table data({{"x"}, {"v"}});
  const auto printed = static_cast<std::size_t>(sections_within(printed_time));
  for (std::size_t k = 0; k < printed; ++k) data.add({all[k][0], all[k][1]});
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "algebraic_series-sections",
                    {{"heading", "239 sections in 31 places: a period of 31, nearly"},
                     {"width", "620"},
                     {"height", "600"}}};
  double greatest = 0;
  for (std::size_t k = 0; k + 31 < printed; k += 31)
    greatest = std::max(greatest, (all[k + 31] - all[k]).norm());
  showing.quantities = {
      scene::near("sections in 750 s", "1", static_cast<double>(printed), 239, 0, "750/pi = 238.7"),
      scene::at_most("way from a section near the begin to that 31 later", "1", greatest, 1.2e-4,
                     "chord of 0.0778 turns on an island of half width 2.35e-4; recorded")};
  return showing;
}

/// Between the outermost of every 31st section.
double width(const States& all, int component) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (std::size_t k = 0; k < all.size(); k += 31) {
    least = std::min(least, all[k][component]);
    most = std::max(most, all[k][component]);
  }
  return most - least;
}

scene::Showing show_islands(const States& all) {
  scene::Table data({{"section"}, {"dx"}, {"dv"}});
  for (std::size_t k = 0; k < all.size(); k += 31)
    data.add({static_cast<std::int64_t>(k), all[k][0] - centre[0], all[k][1]});
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "algebraic_series-islands",
                    {{"heading", "Every 31st of 20 000 sections: a closed island, no transient"},
                     {"width", "620"},
                     {"height", "600"}}};
  // oracle: algebraic_series_motions island width *
  const double rotation = rotation_number(all);
  const std::size_t quarter = all.size() / 4;
  const double first = island_radius(all, centre, 0, quarter),
               last = island_radius(all, centre, 3 * quarter, all.size());
  const States around = sections({}, centre, StrongOscillator::initial_time, 32);
  showing.quantities = {
      {"rotation number", "turns", rotation, 8.0 / 31 - 1e-9, 8.0 / 31 + 1e-9,
       "8/31 exactly, on islands about an orbit of 31 periods; the issue's bound"},
      scene::at_most(
          "distance of the central orbit from itself after 31 periods", "1", (around[31] - centre).norm(),
          1e-12, "its centre by tools/oracles/algebraic_series_motions.py, 15 digits, and rounding of 97 s"),
      scene::near("radius of the island, last quarter over first", "1", last / first, 1, 5e-4,
                  "no damping; points of the island are few"),
      scene::near("width of the island along x", "1", width(all, 0), 2.7e-4, 0.03,
                  "tools/oracles/algebraic_series_motions.py, two digits"),
      scene::near("width of the island along v", "1", width(all, 1), 4.7e-4, 0.03,
                  "tools/oracles/algebraic_series_motions.py, two digits")};
  return showing;
}

}  // namespace

void add_poincare(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<States>(
      "sections", "every pi from t = pi on; order and steps by the radius of convergence, dense output", {},
      [](Workshop&) {
        return sections({}, StrongOscillator::initial_state(), StrongOscillator::initial_time, many);
      });
  chapter.add({.name = "fig-6b",
               .title = "Poincare sections every pi, 750 s",
               .place = "Figure 6b",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_printed(w.result(run)); }});
  chapter.add({.name = "poincare",
               .title = "20 000 sections: rotation number 8/31 and the island chain",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show_islands(w.result(run)); }});
  chapter.add({.name = "filipich-rosales/fig-6b/Poincare map/points", .needs = {}, .measure = [](Workshop&) {
                 return scene::Measured{static_cast<double>(sections_within(printed_time)), {}};
               }});
  chapter.add({.name = "filipich-rosales/fig-6b/Poincare map/time of experiment",
               .needs = {},
               .measure = [](Workshop&) {
                 return scene::Measured{printed_time, {}};
               }});
}

}  // namespace nlmech::chapters

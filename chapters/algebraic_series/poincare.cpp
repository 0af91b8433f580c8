#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "chapters/algebraic_series/sections.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::poincare {
namespace {

using States = std::vector<ivp::State>;

constexpr std::int64_t many = 20'000;
// Start at rest of the elliptic orbit of 31 periods at the centre of the islands.
/// Of the island. oracle: algebraic_series_motions period 31 at
const ivp::State centre{-0.500135737928720, 0};

void put_printed(const States& all, scene::Show& show) {
  const std::string time = "filipich-rosales/fig-6b/Poincare map/time of experiment";
  const auto count = static_cast<std::size_t>(show.printed(time) / std::numbers::pi) + 1;
  const auto printed = all | std::views::take(count);
  show.plot("Poincare sections: 239 points in 31 clusters, near a period of 31", "{/:Italic x}",
            "d{/:Italic x}/d{/:Italic t} (1/s)")
      .x_range(-0.6, 0.6)
      .y_range(-0.4, 0.4)
      .columns("", "x:v", {"points pointsize 0.45", 1});
  show.figure().size(620, 600).data(scene::table_of(
      printed, {{"x", [](const auto& s) { return s[0]; }}, {"v", [](const auto& s) { return s[1]; }}}));
  double greatest = 0;
  for (std::size_t k = 0; k + 31 < count; k += 31)
    greatest = std::max(greatest, (all[k + 31] - all[k]).norm());
  show.equals("sections in 750 s", count, 239, "750/pi = 238.7");
  show.at_most("distance between a section near the start and that 31 later", greatest, 1.2e-4,
               "chord of 0.0778 turns on an island of half width 2.35e-4; regression value");
  ivp::State most = ivp::State::Zero(2);
  for (const ivp::State& s : printed) most = most.cwiseMax(s.cwiseAbs());
  double diamond = 0;
  for (const ivp::State& s : printed) diamond = std::max(diamond, s.cwiseAbs().cwiseQuotient(most).sum());
  show.at_most("greatest |x|/max|x| + |v|/max|v|", diamond, 1.02,
               "1 on the edges of a diamond, and the width of the islands; 1.41 on an ellipse");
  show.measured("filipich-rosales/fig-6b/Poincare map/points", static_cast<double>(count));
  show.measured(time, show.printed(time));
}

/// Range of a component over every 31st section: width of the island.
double width(const States& all, int component) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (std::size_t k = 0; k < all.size(); k += 31) {
    least = std::min(least, all[k][component]);
    most = std::max(most, all[k][component]);
  }
  return most - least;
}

void draw(const States& all, scene::Show& show) {
  scene::Table data({{"section"}, {"dx"}, {"dv"}});
  for (std::size_t k = 0; k < all.size(); k += 31) data.add({k, all[k][0] - centre[0], all[k][1]});
  const auto part = [](const char* which) {
    return fmt::format("(1e4*column('dx')):(column('section') {} ? 1e4*column('dv') : NaN)", which);
  };
  show.plot("Every 31st of 20 000 sections: a closed island, no transient",
            "10^{4} ({/:Italic x} − {/:Italic x}_{31})", "10^{4} d{/:Italic x}/d{/:Italic t} (1/s)")
      .x_range(-2, 2)
      .y_range(-3, 3)
      .key("at graph 0.5, graph 0.5 center center")
      .columns("first 5000", part("< 5000"), {"points pointsize 0.6", 2})
      .columns("last 5000", part(">= 15000"), {"points pointsize 0.3", 1});
  show.figure().size(620, 600).data(std::move(data));
}

void put_islands(const States& all, scene::Show& show) {
  draw(all, show);
  // oracle: algebraic_series_motions island width *
  const std::size_t quarter = all.size() / 4;
  const double first = island_radius(all, centre, 0, quarter),
               last = island_radius(all, centre, 3 * quarter, all.size());
  const States around =
      sections(ivp::System(problems::TextProblem("oscillator")), centre, std::numbers::pi, 32);
  show.between("rotation number", {rotation_number(all), "turns"}, 8.0 / 31 - 1e-9, 8.0 / 31 + 1e-9,
               "8/31 exactly, on islands about an orbit of 31 periods; the tolerance is a requirement");
  show.at_most("distance of the central orbit from itself after 31 periods", (around[31] - centre).norm(),
               1e-12,
               "its centre by tools/oracles/algebraic_series_motions.py, 15 digits, and rounding of 97 s");
  show.near("radius of the island, last quarter over first", last / first, 1, 5e-4,
            "no damping; points of the island are few");
  const char* known = "tools/oracles/algebraic_series_motions.py, two digits";
  show.near("width of the island along x", width(all, 0), 2.7e-4, 0.03, known);
  show.near("width of the island along v", width(all, 1), 4.7e-4, 0.03, known);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "sections", "every pi from t = pi on; order and steps by the radius of convergence, dense output", [] {
        const problems::TextProblem oscillator("oscillator");
        return sections(ivp::System(oscillator), oscillator.initial_state(), oscillator.initial_time, many);
      });
  return {{.name = "fig-6b",
           .title = "Poincare sections every pi, 750 s",
           .place = "Figure 6b",
           .content = scene::Content(put_printed, result)},
          {.name = "poincare",
           .title = "20 000 sections: rotation number 8/31 and the island chain",
           .content = scene::Content(put_islands, result)}};
}

}  // namespace nlmech::chapters::algebraic_series::poincare

#include "nlmech/spacecraft/control/lyapunov.hpp"

#include <fmt/format.h>

#include <ranges>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::gss_control::lyapunov {
namespace {

using spacecraft::LyapunovHistory;

/// Gains with V along the time response.
struct Motion {
  const char* gains;
  LyapunovHistory history;

  [[nodiscard]] double begin() const { return history.samples.front().corrected; }
  [[nodiscard]] double end() const { return history.samples.back().corrected; }
  [[nodiscard]] double corrected_rise() const { return history.corrected_rise; }
  [[nodiscard]] double printed_rise() const { return history.printed_rise; }
  [[nodiscard]] double imbalance() const { return history.imbalance; }
};

std::vector<Motion> motions(bool quick) {
  const double end = 60, step = quick ? 0.02 : 0.01;
  return {{"unit", lyapunov_history(craft(true), unit_gains, 10, end, step)},
          {"designed", lyapunov_history(craft(true), designed_gains, 10, end, step)}};
}

void draw(const std::vector<Motion>& all, scene::Show& show) {
  using Sample = spacecraft::LyapunovSample;
  scene::Plot& plot = show.plots("Lyapunov function V: falls with both appendages; as printed it also rises");
  plot.stacked().size(760, 560).columns({"curve", "panel", "x", "y"});
  for (const Motion& m : all) {
    const bool first = &m == &all.front();
    scene::Panel& panel =
        plot.panel("{/:Italic t} (s)", fmt::format("{{/:Italic V}}/{{/:Italic V}}(0), {} gains", m.gains));
    panel.x_range(0, 30);
    first ? panel.y_range(0, 1.1) : panel.log_y(1e-6, 2);
    const Sample& start = m.history.samples.front();
    const auto drawn =
        m.history.samples | std::views::take_while([](const Sample& s) { return s.time <= 30; });
    panel.curve(first ? "both appendages" : "", drawn, &Sample::time,
                [&](const Sample& s) { return s.corrected / start.corrected; });
    panel.curve(
        first ? "as printed, one appendage" : "", drawn, &Sample::time,
        [&](const Sample& s) { return s.printed / start.printed; }, scene::lines(5));
  }
}

void put(const std::vector<Motion>& all, scene::Show& show) {
  draw(all, show);
  show.table(all, {{"gains", &Motion::gains},
                   {"V at the start", &Motion::begin, 4},
                   {"V at the end", &Motion::end, 4},
                   {"rises of V, over V(0)", &Motion::corrected_rise, 2},
                   {"rises of V as printed, over V(0)", &Motion::printed_rise, 3},
                   {"imbalance", &Motion::imbalance, 2}});
  for (const Motion& m : all) {
    show.at_most(fmt::format("rises of V, {} gains", m.gains), m.corrected_rise(), 1e-12,
                 "V falls by k3 theta'^2; rounding of a few thousand steps");
    show.at_most(
        fmt::format("V against its balance, {} gains", m.gains), m.imbalance(), 8e-8,
        "8e-8 in an independent simulation; Gauss's rule with ten points a step does not resolve the "
        "upper modes");
  }
  show.between("rises of V as printed, unit gains", all[0].printed_rise(), 0.095, 0.115,
               "10.5 % of V(0) in an independent simulation, sampled otherwise");
  show.between("rises of V as printed, designed gains", all[1].printed_rise(), 4e-5, 1.6e-4,
               "8e-5 of V(0) in an independent simulation, sampled otherwise");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "lyapunov-histories",
      "V along the motion of ten assumed modes from rest to theta_f = 1 rad, by the matrix exponential; "
      "printed: (3.52) with one appendage and without the tip's inertia",
      motions);
  return {{.name = "lyapunov",
           .title = "Lyapunov function along the motion, corrected and as printed",
           .place = "our own, for a claim of section 3.1.4",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::gss_control::lyapunov

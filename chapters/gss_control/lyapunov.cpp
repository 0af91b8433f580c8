#include "nlmech/spacecraft/lyapunov.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::LyapunovHistory;

/// Both sets of gains: unit, designed.
using Both = std::array<LyapunovHistory, 2>;

scene::Showing show(const Both& both) {
  Plot plot("V with both appendages falls; as printed it rises too", "{/:Italic t} (s)");
  plot.x_range(0, 30);
  scene::Table table({{"gains"},
                      {"V at the start", 4},
                      {"V at the end", 4},
                      {"rises of V, over V(0)", 2},
                      {"rises of V as printed, over V(0)", 3},
                      {"imbalance", 2}});
  std::vector<scene::Quantity> quantities;
  for (const bool designed : {false, true}) {
    const LyapunovHistory& h = both.at(designed ? 1 : 0);
    const char* name = designed ? "designed" : "unit";
    plot.panel(fmt::format("{{/:Italic V}}/{{/:Italic V}}(0), {} gains", name));
    if (designed)
      plot.log_y(1e-6, 2);
    else
      plot.y_range(0, 1.1);
    plot.begin(designed ? "" : "both appendages", "l1");
    for (const auto& s : h.samples) {
      if (s.time <= 30) plot.add(s.time, s.corrected / h.samples.front().corrected);
    }
    plot.begin(designed ? "" : "as printed, one appendage", "l5");
    for (const auto& s : h.samples) {
      if (s.time <= 30) plot.add(s.time, s.printed / h.samples.front().printed);
    }
    table.add({name, h.samples.front().corrected, h.samples.back().corrected, h.corrected_rise,
               h.printed_rise, h.imbalance});
    quantities.push_back(scene::at_most(fmt::format("rises of V, {} gains", name), "1", h.corrected_rise,
                                        1e-12, "V falls by k3 theta'^2; rounding of a few thousand steps"));
    quantities.push_back(scene::at_most(fmt::format("V against its balance, {} gains", name), "1",
                                        h.imbalance, 8e-8,
                                        "8e-8 in an independent simulation; Gauss's rule with ten points a "
                                        "step does not resolve the upper modes"));
  }
  const double unit = both[0].printed_rise, designed = both[1].printed_rise;
  quantities.push_back({"rises of V as printed, unit gains", "1", unit, 0.095, 0.115,
                        "10.5 % of V(0) in an independent simulation, sampled otherwise"});
  quantities.push_back({"rises of V as printed, designed gains", "1", designed, 4e-5, 1.6e-4,
                        "8e-5 of V(0) in an independent simulation, sampled otherwise"});
  return {plot.with("key1", "top right").take(), table, quantities};
}

}  // namespace

void add_lyapunov(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Both>(
      "lyapunov-histories",
      "V along the motion of ten assumed modes from rest to theta_f = 1 rad, by the matrix exponential; "
      "printed: (3.52) with one appendage and without the tip's inertia",
      {}, [](Workshop& w) {
        const double end = 60, step = w.quick() ? 0.02 : 0.01;
        return Both{lyapunov_history(craft(true), unit_gains, 10, end, step),
                    lyapunov_history(craft(true), designed_gains, 10, end, step)};
      });
  chapter.add({.name = "lyapunov",
               .title = "Lyapunov's function along the motion, corrected and as printed",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters

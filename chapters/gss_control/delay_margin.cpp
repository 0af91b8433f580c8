#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/margins.hpp"
#include "nlmech/spacecraft/optimal_gains.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::ClosedLoop;

constexpr std::array delays = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
constexpr int modes = 9;

/// A loop with what a delay and its sensitivity make of it.
struct Fragile {
  std::string name;
  std::array<int, delays.size()> unstable{};  ///< of the first nine poles
  std::array<int, delays.size()> of_ten{};    ///< of the first ten: the rigid mode and nine flexible ones
  std::vector<spacecraft::SensitivityPeak> peaks;
  spacecraft::Margins margins;
};

Fragile measure(const std::string& name, const spacecraft::Gains& gains, int peaks) {
  const ClosedLoop loop(craft(true), gains);
  Fragile f{name, {}, {}, sensitivity_peaks(loop, peaks), margins(loop, modes)};
  for (std::size_t i = 0; i < delays.size(); ++i) {
    const auto moved = delayed_poles(loop, delays.at(i), modes);
    f.unstable.at(i) = moved.status.ok() ? moved.unstable : -1;
    const auto ten = delayed_poles(loop, delays.at(i), modes + 1);
    f.of_ten.at(i) = ten.status.ok() ? ten.unstable : -1;
  }
  return f;
}

std::vector<Fragile> measure_all(bool quick) {
  const auto optimum = optimal_gains(craft(true), {100, 1 / 144.}).gains;
  const auto pd = optimal_pd_gains(craft(true), {100, 1 / 144.}).gains;
  const int peaks = quick ? 9 : 20;
  return {measure("unit gains", unit_gains, peaks), measure("designed gains", designed_gains, peaks),
          measure("optimum, W = 100", optimum, peaks), measure("PD optimum, W = 100", pd, peaks)};
}

const spacecraft::SensitivityPeak& largest(const Fragile& f) {
  return *std::max_element(f.peaks.begin(), f.peaks.end(),
                           [](const auto& a, const auto& b) { return a.value < b.value; });
}

// Poles followed from delay to delay in doubles. oracle: gss_control_loop * unstable of *, designed
// sensitivity, unit sensitivity ?, unit sensitivity 20
std::vector<scene::Quantity> promises(const std::vector<Fragile>& all, bool quick) {
  const char* counted = "tools/oracles/gss_control_loop.py follows the poles from delay to delay";
  const auto& unit = all[0];
  const auto& designed = all[1];
  const auto& optimum = all[2];
  const auto count = [&](const std::string& name, int value, int expected) {
    return scene::near(name, "1", value, expected, 0, counted);
  };
  std::vector<scene::Quantity> q = {
      count("unstable modes of nine, unit gains, 10 us", unit.unstable[1], 5),
      count("unstable modes of nine, designed gains, 1 ms", designed.unstable[3], 0),
      count("unstable modes of nine, designed gains, 10 ms", designed.unstable[4], 3),
      count("unstable modes of ten, optimum, 1 us", optimum.of_ten[0], 0),
      count("unstable modes of ten, optimum, 10 us", optimum.of_ten[1], 3),
      count("unstable modes of ten, optimum, 100 us", optimum.of_ten[2], 6),
      scene::near("largest sensitivity, designed gains", "1", largest(designed).value, 1.111, 5e-3,
                  "tools/oracles/gss_control_loop.py, four digits")};
  // Unit gains: |S| near successive poles.
  constexpr std::array known = {3.78, 19.4, 139.8, 416.8, 794., 1245.};
  for (std::size_t i = 0; i < known.size() && i < unit.peaks.size(); ++i)
    q.push_back(scene::near(fmt::format("sensitivity near pole {}, unit gains", i + 1), "1",
                            unit.peaks[i].value, known.at(i), 2e-2,
                            "tools/oracles/gss_control_loop.py, three to four digits"));
  if (!quick)
    q.push_back(scene::near("sensitivity near pole 20, unit gains", "1", unit.peaks.back().value, 2.64e4,
                            3e-2, "tools/oracles/gss_control_loop.py, three digits"));
  for (const Fragile& f : all) {
    const double delay = f.margins.delay_margin;
    q.push_back({fmt::format("delay margin over nine modes, {}", f.name), "s", delay, 1e-8, 1e-1,
                 "between a rounding's and the first flexible mode's period"});
  }
  return q;
}

scene::Showing show(const std::vector<Fragile>& all, bool quick) {
  Plot plot("Feedback of the root load makes the loop fragile", "frequency of the mode (rad/s)");
  plot.log_x(0.1, 2e4);
  plot.panel("largest |{/:Italic S}| near the mode");
  plot.log_y(0.5, 1e6);
  const std::array looks = {"b2", "b1", "b5", "b4"};
  scene::Table table({{"gains"},
                      {"unstable of 9 at 1 us"},
                      {"10 us"},
                      {"100 us"},
                      {"1 ms"},
                      {"10 ms"},
                      {"largest |S|", 4},
                      {"at (rad/s)", 5},
                      {"least phase margin (deg)", 3},
                      {"delay margin, 9 modes (s)", 3}});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Fragile& f = all[i];
    plot.begin(f.name, looks.at(i));
    for (const auto& p : f.peaks) plot.add(p.omega, p.value);
    std::vector<scene::Cell> row = {f.name};
    for (const int n : f.unstable) row.emplace_back(std::int64_t{n});
    row.insert(row.end(), {largest(f).value, largest(f).omega,
                           f.margins.phase_margin * 180 / std::numbers::pi, f.margins.delay_margin});
    table.add(std::move(row));
  }
  return {plot.with("key1", "top left").take(), table, promises(all, quick)};
}

}  // namespace

void add_delay_margin(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Fragile>>(
      "delays", "the torque loop with a delay; each pole is followed from that without; theta_f = 1 rad", {},
      [](Workshop& w) { return measure_all(w.quick()); });
  chapter.add({.name = "delay-margin",
               .title = "What a delay in the loop does: unstable modes, sensitivity",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run), w.quick()); }});
}

}  // namespace nlmech::chapters

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/control/margins.hpp"
#include "nlmech/spacecraft/control/optimal_gains.hpp"

namespace nlmech::chapters::gss_control::delay_margin {
namespace {

using spacecraft::ClosedLoop;

constexpr std::array delays = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
constexpr int modes = 9;

/// Closed loop with its margins, sensitivity peaks and numbers of unstable poles under delays.
struct Sensitivity {
  std::string name;
  std::array<int, delays.size()> unstable{};  ///< unstable among the first nine poles, by delay
  std::array<int, delays.size()> of_ten{};    ///< among the first ten: rigid mode and nine flexible modes
  std::vector<spacecraft::SensitivityPeak> peaks;
  spacecraft::Margins margins;

  [[nodiscard]] const spacecraft::SensitivityPeak& largest() const {
    return *std::ranges::max_element(peaks, {}, &spacecraft::SensitivityPeak::value);
  }
  [[nodiscard]] double largest_value() const { return largest().value; }
  [[nodiscard]] double largest_at() const { return largest().omega; }
  [[nodiscard]] double phase_margin() const { return margins.phase_margin * 180 / std::numbers::pi; }
  [[nodiscard]] double delay_margin() const { return margins.delay_margin; }
};

Sensitivity measure(const std::string& name, const spacecraft::Gains& gains, int peaks) {
  const ClosedLoop loop(craft(true), gains);
  Sensitivity f{name, {}, {}, sensitivity_peaks(loop, peaks), margins(loop, modes)};
  for (std::size_t i = 0; i < delays.size(); ++i) {
    const auto moved = delayed_poles(loop, delays.at(i), modes);
    f.unstable.at(i) = moved.status.ok() ? moved.unstable : -1;
    const auto ten = delayed_poles(loop, delays.at(i), modes + 1);
    f.of_ten.at(i) = ten.status.ok() ? ten.unstable : -1;
  }
  return f;
}

std::vector<Sensitivity> measure_all(bool quick) {
  const auto optimum = spacecraft::optimal_gains(craft(true), {100, 1 / 144.}).gains;
  const auto pd = optimal_pd_gains(craft(true), {100, 1 / 144.}).gains;
  const int peaks = quick ? 9 : 20;
  return {measure("unit gains", unit_gains, peaks), measure("designed gains", designed_gains, peaks),
          measure("optimum, W = 100", optimum, peaks), measure("PD optimum, W = 100", pd, peaks)};
}

/// Column of the number of unstable poles at one of the delays.
scene::ColumnOf<Sensitivity> unstable(const std::string& heading, std::size_t delay) {
  return {heading, [delay](const Sensitivity& f) { return f.unstable.at(delay); }};
}

// Poles followed from delay to delay in doubles. oracle: gss_control_loop * unstable of *, designed
// sensitivity, unit sensitivity ?, unit sensitivity 20
void check(const std::vector<Sensitivity>& all, scene::Show& show) {
  const Sensitivity &unit = all[0], &designed = all[1], &optimum = all[2];
  const char* counted = "tools/oracles/gss_control_loop.py follows the poles from delay to delay";
  show.equals("unstable modes of nine, unit gains, 10 us", unit.unstable[1], 5, counted);
  show.equals("unstable modes of nine, designed gains, 1 ms", designed.unstable[3], 0, counted);
  show.equals("unstable modes of nine, designed gains, 10 ms", designed.unstable[4], 3, counted);
  show.equals("unstable modes of ten, optimum, 1 us", optimum.of_ten[0], 0, counted);
  show.equals("unstable modes of ten, optimum, 10 us", optimum.of_ten[1], 3, counted);
  show.equals("unstable modes of ten, optimum, 100 us", optimum.of_ten[2], 6, counted);
  show.near("largest sensitivity, designed gains", designed.largest_value(), 1.111, 5e-3,
            "tools/oracles/gss_control_loop.py, four digits");
  // |S| near successive poles for unit gains.
  constexpr std::array known = {3.78, 19.4, 139.8, 416.8, 794., 1245.};
  for (std::size_t i = 0; i < known.size() && i < unit.peaks.size(); ++i)
    show.near(fmt::format("sensitivity near pole {}, unit gains", i + 1), unit.peaks[i].value, known.at(i),
              2e-2, "tools/oracles/gss_control_loop.py, three to four digits");
  if (!show.quick())
    show.near("sensitivity near pole 20, unit gains", unit.peaks.back().value, 2.64e4, 3e-2,
              "tools/oracles/gss_control_loop.py, three digits");
  for (const Sensitivity& f : all)
    show.between("delay margin over nine modes, " + f.name, {f.delay_margin(), "s"}, 1e-8, 1e-1,
                 "between a rounding's and the first flexible mode's period");
}

void put(const std::vector<Sensitivity>& all, scene::Show& show) {
  scene::Panel& panel =
      show.plot("Sensitivity near each mode: grows with the mode if the root load is fed back",
                "frequency of the mode (rad/s)", "largest |{/:Italic S}| near the mode");
  panel.log_x(0.1, 2e4).log_y(0.5, 1e6).key("top left");
  show.figure().columns({"curve", "panel", "x", "y"});
  constexpr std::array styles = {2, 1, 5, 4};
  for (std::size_t i = 0; i < all.size(); ++i)
    panel.curve(all[i].name, all[i].peaks, &spacecraft::SensitivityPeak::omega,
                &spacecraft::SensitivityPeak::value, scene::linespoints(styles.at(i)));
  show.table(all, {{"gains", &Sensitivity::name},
                   unstable("unstable of 9 at 1 us", 0),
                   unstable("10 us", 1),
                   unstable("100 us", 2),
                   unstable("1 ms", 3),
                   unstable("10 ms", 4),
                   {"largest |S|", &Sensitivity::largest_value, 4},
                   {"at (rad/s)", &Sensitivity::largest_at, 5},
                   {"least phase margin (deg)", &Sensitivity::phase_margin, 3},
                   {"delay margin, 9 modes (s)", &Sensitivity::delay_margin, 3}});
  check(all, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result loops(
      "delays", "the torque loop with a delay; each pole is followed from delay 0; theta_f = 1 rad",
      measure_all);
  return {{.name = "delay-margin",
           .title = "Delay in the loop: unstable modes and sensitivity",
           .place = "our own, for two claims of section 3.1.4",
           .content = scene::Content(put, loops)}};
}

}  // namespace nlmech::chapters::gss_control::delay_margin

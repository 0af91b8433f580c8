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
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"

namespace nlmech::chapters::gss_control::frequency_figures {
namespace {

using spacecraft::Plant;

constexpr const char* sixty_digits = "tools/oracles/gss_control_plant.py, 40 digits, 15 of them printed";
constexpr double axis_end = 4000;

/// Reference values of the frequency response at j omega.
struct Known {
  double omega, theta, middle, tip;
};
// oracle: gss_control_plant bare theta at *, bare y2 at *, bare y4 at *, tip theta at *, tip y2 at *, tip y4
// at *
constexpr std::array without = {Known{0.1, -9.75833120309274, -0.00155072104594153, -0.00447670586136782},
                                Known{1, -0.0974374222149588, -0.00155990461324693, -0.0045038722357598},
                                Known{10, -0.000605717378334455, -0.00388365164035639, -0.011381159135926},
                                Known{100, -1.2643210805556e-5, 5.6814811814159e-5, 3.35433875614072e-5},
                                Known{1000, -1.26289815221454e-7, 9.33002707313804e-7, -1.56096643502893e-7}};
constexpr std::array with_tip = {
    Known{0.1, -5.52448854758618, -0.00475612847846067, -0.0149467556104467},
    Known{1, -0.0536584284810462, -0.00487037747371546, -0.0153109262016674},
    Known{10, -0.00166615919715115, 0.00327536292807089, 0.0106674410862429},
    Known{100, -1.24569176143171e-5, 4.20049688309619e-5, 6.06691862730473e-5},
    Known{1000, -1.19743817340464e-7, -1.50064378421044e-6, 6.96987425587235e-7}};

/// Relative error bound of the response: 14 digits, and the slope times rounding near a pole.
constexpr double fourteen_digits = 2e-13;

/// Frequencies that resolve every peak and notch: a logarithmic grid, and points that accumulate at each
/// pole.
std::vector<double> frequencies(const std::vector<double>& near, double low, double high) {
  std::vector<double> all = logarithmic(low, high, 900);
  for (const double p : near) {
    if (p < low || p > high) continue;
    for (const double distance : {3e-4, 1e-3, 3e-3, 6e-3, 1e-2}) {
      all.push_back(p * (1 - distance));
      all.push_back(p * (1 + distance));
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Draws |y(x)/u| by the exact transfer function and by ten assumed modes.
void compare(bool tip, double x, scene::Show& show) {
  const Plant plant(craft(tip));
  const auto exact_poles = spacecraft::poles(plant, 10);
  const spacecraft::ModalModel model = diagonalise(spacecraft::assumed_modes(plant.parameters(), 10));
  const spacecraft::ModalResponse modes(model, x);
  std::vector<double> both = exact_poles.omega;
  for (const double w : model.omega) both.push_back(w);
  const std::vector<double> omega = frequencies(both, 1, axis_end);
  scene::Plot& plot = show.plots(
      fmt::format("{} at {} ft: ten assumed modes err by {:.2g} % in the tenth frequency",
                  tip ? "With tips," : "No tips,", x, 100 * (model.omega[9] / exact_poles.omega[9] - 1)));
  plot.stacked().size(760, 620).columns({"curve", "panel", "x", "y"});
  const auto add = [&](const char* caption, auto response, int style) {
    scene::Panel& panel = plot.panel("{/:Italic ω} (rad/s)",
                                     fmt::format("|{{/:Italic y}}({} ft)/{{/:Italic u}}| (ft per ft lb)", x));
    panel.log_x(1, axis_end).log_y(1e-9, 1).caption(caption).key("off");
    for (const double pole : exact_poles.omega)
      if (pole < axis_end) panel.mark(pole);
    panel.curve("", omega, std::identity(), response, scene::lines(style));
  };
  add(
      "exact; grey lines: its poles, where it is infinite",
      [&](double w) { return std::abs(plant.at_frequency(w, x).deflection); }, 1);
  add(
      "ten assumed modes; the same lines",
      [&](double w) { return std::abs(modes.at_frequency(w).deflection); }, 5);
  for (const Known& k : tip ? with_tip : without)
    show.near(fmt::format("y/u at {} rad/s", k.omega), {plant.at_frequency(k.omega, x).deflection, "1/lb"},
              x == 2 ? k.middle : k.tip, fourteen_digits, sixty_digits);
  // oracle: gss_control_plant * assumed mode 1, * assumed mode 3, * assumed mode 10
  for (const auto& [n, known] :
       {std::pair{1, tip ? 4.5e-5 : 2.0e-5}, {3, tip ? 1.2e-2 : 7.4e-4}, {10, tip ? 1.7e-1 : 1.5e-2}})
    show.between(fmt::format("frequency of mode {}, assumed over exact, less 1", n),
                 model.omega[n - 1] / exact_poles.omega[static_cast<std::size_t>(n - 1)] - 1, 0.94 * known,
                 1.06 * known, "tools/oracles/gss_control_plant.py, two digits");
}

/// Settings of one of the two Bode plots of the response to a unit step, G/s on the imaginary axis. G is real
/// there, so the phase is -90 or 90 degrees, as in the text.
struct Bode {
  const char *heading, *label, *quantity, *unit;
  double greatest;              ///< upper limit of the axis
  double Known::*known;         ///< member of Known that is plotted
  double first_zero;            ///< rad/s
  std::vector<double> notches;  ///< frequencies of the zeros on the imaginary axis
  bool hub;
};

Bode bode_of_hub(const Plant& plant) {
  return {"Hub angle: poles and zeros alternate, all undamped",
          "|{/:Italic θ}| of a unit step (rad s)",
          "theta/u",
          "1/(lb ft)",
          1000,
          &Known::theta,
          4.372658473946,  // oracle: gss_control_plant tip locked 1
          spacecraft::hub_zeros(plant, 10).omega,
          true};
}

Bode bode_of_deflection(const Plant& plant) {
  std::vector<double> notches;
  for (const spacecraft::Complex& s : spacecraft::deflection_zeros(plant, 2, 1500).s) {
    if (std::abs(s.real()) < 1e-6 * std::abs(s)) notches.push_back(s.imag());
  }
  return {"Deflection at 2 ft: fewer zeros than poles",
          "|{/:Italic y}| of a unit step (ft s)",
          "y/u",
          "1/lb",
          10,
          &Known::middle,
          37.81075762923,  // oracle: gss_control_plant tip first zero of y2
          notches,
          false};
}

void put_bode(Bode (*bode_of)(const Plant&), scene::Show& show) {
  const Plant plant(craft(true));
  const auto p = spacecraft::poles(plant, 10);
  const Bode b = bode_of(plant);
  std::vector<double> peaks = p.omega;
  peaks.insert(peaks.end(), b.notches.begin(), b.notches.end());
  const std::vector<double> omega = frequencies(peaks, 0.1, 1000);
  const auto value = [&](double w) {
    const auto r = plant.at_frequency(w, 2);
    return b.hub ? r.theta : r.deflection;
  };
  const auto step = [&](double w) { return value(w) / spacecraft::Complex(0, w); };
  scene::Plot& plot = show.plots(b.heading);
  plot.stacked().size(760, 560).columns({"curve", "panel", "x", "y"});
  plot.panel("{/:Italic ω} (rad/s)", b.label)
      .log_x(0.1, 1000)
      .log_y(1e-11, b.greatest)
      .curve("", omega, std::identity(), [&](double w) { return std::abs(step(w)); });
  plot.panel("{/:Italic ω} (rad/s)", "phase (deg)")
      .log_x(0.1, 1000)
      .y_range(-120, 120)
      .set("ytics -90, 90")
      .curve("", omega, std::identity(),
             [&](double w) { return std::arg(step(w)) * 180 / std::numbers::pi; });
  for (const Known& k : with_tip)
    show.near(fmt::format("{} at {} rad/s", b.quantity, k.omega), {value(k.omega), b.unit}, k.*(b.known),
              fourteen_digits, sixty_digits);
  // oracle: gss_control_plant tip pole 1
  const char* reason = "tools/oracles/gss_control_plant.py, 13 digits";
  show.near("first pole", {p.omega.front(), "rad/s"}, 6.452959965749, 1e-12, reason);
  show.near("first zero", {b.notches.empty() ? NAN : b.notches.front(), "rad/s"}, b.first_zero, 1e-12,
            reason);
}

scene::Scene scene_of(const std::string& name, const std::string& title, scene::Content content) {
  return {.name = name, .title = title, .place = "Figure " + name.substr(4), .content = std::move(content)};
}

}  // namespace

std::vector<scene::Scene> scenes() {
  std::vector<scene::Scene> all;
  for (const bool tip : {false, true}) {
    for (const double x : {2.0, 4.0})
      all.push_back(scene_of(fmt::format("fig-3.{}", 3 + all.size()),
                             fmt::format("Deflection at {} ft, {} tip mass: exact and by ten assumed modes",
                                         x, tip ? "with" : "without"),
                             scene::Content([tip, x](scene::Show& show) { compare(tip, x, show); })));
  }
  const auto bode = [](Bode (*of)(const Plant&)) {
    return scene::Content([of](scene::Show& show) { put_bode(of, show); });
  };
  all.push_back(
      scene_of("fig-3.7", "Bode plot of a unit step: deflection at 2 ft", bode(bode_of_deflection)));
  all.push_back(scene_of("fig-3.8", "Bode plot of a unit step: hub angle", bode(bode_of_hub)));
  return all;
}

}  // namespace nlmech::chapters::gss_control::frequency_figures

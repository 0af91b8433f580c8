#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/assumed_modes.hpp"
#include "nlmech/spacecraft/poles.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::Plant;

constexpr const char* sixty_digits = "tools/oracles/gss_control_plant.py, 40 digits, 15 of them printed";
constexpr double axis_end = 4000;

/// A response at j omega.
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

/// Relative bound for the response at the frequency: 14 digits, and the slope times rounding near a pole.
constexpr double fourteen_digits = 2e-13;

/// Frequencies that show every peak and notch: a logarithmic grid, and points that close in on each pole.
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

/// |y(x)/u| by the exact transfer function and by ten assumed modes.
scene::Showing compare(bool tip, double x) {
  const Plant plant(craft(tip));
  const auto exact_poles = spacecraft::poles(plant, 10);
  const spacecraft::ModalModel model = diagonalise(spacecraft::assumed_modes(plant.parameters(), 10));
  const spacecraft::ModalResponse modes(model, x);
  std::vector<double> both = exact_poles.omega;
  for (const double w : model.omega) both.push_back(w);
  const std::vector<double> omega = frequencies(both, 1, axis_end);
  Plot plot(
      fmt::format("{} at {} ft: ten assumed modes miss the upper modes", tip ? "With tips," : "No tips,", x),
      "{/:Italic ω} (rad/s)");
  plot.panel(fmt::format("|{{/:Italic y}}({} ft)/{{/:Italic u}}| (ft per ft lb)", x));
  plot.log_x(1, axis_end);
  plot.log_y(1e-9, 1);
  plot.begin("exact", "l1");
  for (const double w : omega) plot.add(w, std::abs(plant.at_frequency(w, x).deflection));
  plot.begin("ten assumed modes", "l5");
  for (const double w : omega) plot.add(w, std::abs(modes.at_frequency(w).deflection));
  std::vector<scene::Quantity> quantities;
  for (const Known& k : tip ? with_tip : without)
    quantities.push_back(scene::near(fmt::format("y/u at {} rad/s", k.omega), "1/lb",
                                     plant.at_frequency(k.omega, x).deflection, x == 2 ? k.middle : k.tip,
                                     fourteen_digits, sixty_digits));
  const auto error = [&](int n) {
    return model.omega[n - 1] / exact_poles.omega[static_cast<std::size_t>(n - 1)] - 1;
  };
  const auto near_two_digits = [&](int n, double reference) {
    quantities.push_back({fmt::format("frequency of mode {}, assumed over exact, less 1", n), "1", error(n),
                          0.94 * reference, 1.06 * reference,
                          "tools/oracles/gss_control_plant.py, two digits"});
  };
  // oracle: gss_control_plant * assumed mode 1, * assumed mode 3, * assumed mode 10
  near_two_digits(1, tip ? 4.5e-5 : 2.0e-5);
  near_two_digits(3, tip ? 1.2e-2 : 7.4e-4);
  near_two_digits(10, tip ? 1.7e-1 : 1.5e-2);
  return {plot.with("key1", "bottom left").take(), {}, quantities};
}

/// Magnitude and phase of the response to a unit step, G/s on the imaginary axis, where G is real: the phase
/// is -90 or 90 degrees, as the text has it.
scene::Showing bode(bool hub) {
  const Plant plant(craft(true));
  const auto p = spacecraft::poles(plant, 10);
  std::vector<double> peaks = p.omega, notches;
  std::vector<scene::Quantity> quantities;
  if (hub) {
    notches = spacecraft::hub_zeros(plant, 10).omega;
  } else {
    for (const spacecraft::Complex& s : spacecraft::deflection_zeros(plant, 2, 1500).s) {
      if (std::abs(s.real()) < 1e-6 * std::abs(s)) notches.push_back(s.imag());
    }
  }
  peaks.insert(peaks.end(), notches.begin(), notches.end());
  const std::vector<double> omega = frequencies(peaks, 0.1, 1000);
  Plot plot(hub ? "Hub angle: poles and zeros take turns, all undamped"
                : "Deflection at 2 ft: fewer zeros than poles",
            "{/:Italic ω} (rad/s)");
  plot.log_x(0.1, 1000);
  plot.panel(hub ? "|{/:Italic θ}| of a unit step (rad s)" : "|{/:Italic y}| of a unit step (ft s)");
  plot.log_y(1e-11, hub ? 1000 : 10);
  const auto value = [&](double w) {
    const auto r = plant.at_frequency(w, 2);
    return hub ? r.theta : r.deflection;
  };
  plot.begin("", "l1");
  const auto step = [&](double w) { return value(w) / spacecraft::Complex(0, w); };
  for (const double w : omega) plot.add(w, std::abs(step(w)));
  plot.panel("phase (deg)");
  plot.y_range(-120, 120);
  plot.y_tics(-90, 90);
  plot.begin("", "l1");
  for (const double w : omega) plot.add(w, std::arg(step(w)) * 180 / std::numbers::pi);
  for (const Known& k : with_tip)
    quantities.push_back(scene::near(fmt::format("{} at {} rad/s", hub ? "theta/u" : "y/u", k.omega),
                                     hub ? "1/(lb ft)" : "1/lb", value(k.omega), hub ? k.theta : k.middle,
                                     fourteen_digits, sixty_digits));
  // oracle: gss_control_plant tip pole 1, tip locked 1, tip first zero of y2
  quantities.push_back(scene::near("first pole", "rad/s", p.omega.front(), 6.452959965749, 1e-12,
                                   "tools/oracles/gss_control_plant.py, 13 digits"));
  quantities.push_back(scene::near("first zero", "rad/s", notches.empty() ? NAN : notches.front(),
                                   hub ? 4.372658473946 : 37.81075762923, 1e-12,
                                   "tools/oracles/gss_control_plant.py, 13 digits"));
  return {plot.take(), {}, quantities};
}

void add_scene(scene::Chapter& chapter, const std::string& name, const std::string& title,
               const std::function<scene::Showing()>& show) {
  chapter.add({.name = name,
               .title = title,
               .place = "Figure " + name.substr(4),
               .needs = {},
               .show = [show](Workshop&) { return show(); }});
}

}  // namespace

void add_frequency_figures(scene::Chapter& chapter) {
  const std::array names = {"fig-3.3", "fig-3.4", "fig-3.5", "fig-3.6"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool tip = i >= 2;
    const double x = i % 2 == 0 ? 2 : 4;
    add_scene(chapter, names.at(i),
              fmt::format("Deflection at {} ft, {} tip mass: exact and by ten assumed modes", x,
                          tip ? "with" : "without"),
              [tip, x] { return compare(tip, x); });
  }
  add_scene(chapter, "fig-3.7", "Bode plot of a unit step: deflection at 2 ft", [] { return bode(false); });
  add_scene(chapter, "fig-3.8", "Bode plot of a unit step: hub angle", [] { return bode(true); });
}

}  // namespace nlmech::chapters

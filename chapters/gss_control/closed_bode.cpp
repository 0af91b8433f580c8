#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using spacecraft::ClosedLoop;
using spacecraft::Complex;

/// A logarithmic grid, and points about each pole's frequency: as many widths away as the peak needs.
std::vector<double> frequencies(const ClosedLoop& loop) {
  std::vector<double> all = logarithmic(0.01, 1000, 900);
  for (const Complex& s : loop.poles(8).s) {
    for (const double widths : {0.0, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0}) {
      for (const double side : {-1.0, 1.0}) {
        const double omega = s.imag() + side * widths * std::abs(s.real());
        if (omega > 0.01 && omega < 1000) all.push_back(omega);
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

struct Peak {
  double omega = 0, size = 0;
};

/// The largest of f about the largest of a grid, by golden section.
template <class F>
Peak largest(const F& f, double low, double high) {
  Peak best;
  const std::vector<double> grid = logarithmic(low, high, 2001);
  std::size_t at = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (f(grid[i]) > best.size) {
      best = {grid[i], f(grid[i])};
      at = i;
    }
  }
  double a = grid[at == 0 ? 0 : at - 1], b = grid[std::min(at + 1, grid.size() - 1)];
  const double golden = (std::sqrt(5.0) - 1) / 2;
  for (int k = 0; k < 60; ++k) {
    const double p = b - golden * (b - a), q = a + golden * (b - a);
    (f(p) > f(q) ? b : a) = f(p) > f(q) ? q : p;
  }
  return {(a + b) / 2, f((a + b) / 2)};
}

scene::Showing show(bool designed, bool hub) {
  const ClosedLoop loop(craft(true), designed ? designed_gains : unit_gains);
  const auto value = [&](double omega) {
    const auto r = loop.response(Complex(0, omega), 2);
    return hub ? r.theta : r.deflection;
  };
  Plot plot(hub ? (designed ? "Designed gains: hardly a peak of the hub angle"
                            : "Unit gains: a peak of 14 dB, and a phase that is ordinary")
                : (designed ? "Designed gains: the deflection still rings at 52 rad/s"
                            : "Unit gains: the deflection rings at every mode"),
            "{/:Italic ω} (rad/s)");
  plot.log_x(0.01, 1000);
  plot.panel(hub ? "|{/:Italic θ}/{/:Italic θ}_f|" : "|{/:Italic y}(2 ft)/{/:Italic θ}_f| (ft/rad)");
  plot.log_y(hub ? 1e-8 : 1e-7, hub ? 10 : 1);
  const std::vector<double> omega = frequencies(loop);
  plot.begin("", "l1");
  for (const double w : omega) plot.add(w, std::abs(value(w)));
  plot.panel("phase (deg)");
  plot.begin("", "l1");
  // Followed from point to point, so that it does not jump by a turn.
  double phase = std::arg(value(omega.front())), low = phase, high = phase;
  for (const double w : omega) {
    phase += std::remainder(std::arg(value(w)) - phase, 2 * std::numbers::pi);
    low = std::min(low, phase);
    high = std::max(high, phase);
    plot.add(w, phase * 180 / std::numbers::pi);
  }
  const auto quarter = [](double angle) { return 90 * std::round(angle * 2 / std::numbers::pi); };
  plot.y_range(quarter(low) - 30, quarter(high) + 30);
  plot.y_tics(quarter(low), 90);
  std::vector<scene::Quantity> quantities;
  // oracle: gss_control_loop * resonance*, * flexible peak
  if (hub) {
    const Peak peak = largest([&](double w) { return std::abs(value(w)); }, 0.02, 4);
    quantities = {
        scene::near("largest modulus of theta/theta_f", "1", peak.size, designed ? 1.099208 : 4.840390, 5e-7,
                    "tools/oracles/gss_control_loop.py, seven digits"),
        scene::near("frequency of it", "rad/s", peak.omega, designed ? 0.5256 : 0.2055, 5e-4,
                    "tools/oracles/gss_control_loop.py, four digits"),
        scene::near("largest theta/theta_f in dB", "dB", 20 * std::log10(peak.size), designed ? 0.82 : 13.70,
                    1e-2, "tools/oracles/gss_control_loop.py, two decimals")};
  } else {
    const Peak peak = largest([&](double w) { return std::abs(value(w)); }, 52.1, 52.7);
    const Peak exact = largest([&](double w) { return std::abs(value(w)); }, 51.5, 53);
    quantities = {scene::near("flexible peak of y(2 ft)/theta_f near 52 rad/s", "ft/rad",
                              std::max(peak.size, exact.size), designed ? 0.794 : 0.721, 1e-3,
                              "tools/oracles/gss_control_loop.py, three digits")};
  }
  return {plot.take(), {}, quantities};
}

}  // namespace

void add_closed_bode(scene::Chapter& chapter) {
  const std::array names = {"fig-3.13", "fig-3.14", "fig-3.15", "fig-3.16"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool designed = i >= 2, hub = i % 2 == 0;
    chapter.add(
        {.name = names.at(i),
         .title = fmt::format("Closed loop, {} gains: Bode plot of the {}", designed ? "designed" : "unit",
                              hub ? "hub angle" : "deflection at 2 ft"),
         .place = std::string("Figure ") + (names.at(i) + 4),
         .needs = {},
         .show = [designed, hub](Workshop&) { return show(designed, hub); }});
  }
}

}  // namespace nlmech::chapters

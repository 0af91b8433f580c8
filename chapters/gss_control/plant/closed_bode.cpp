#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::gss_control::closed_bode {
namespace {

using spacecraft::ClosedLoop;
using spacecraft::Complex;

/// Logarithmic grid, and points around the frequency of each pole at 0 to 100 half-widths of the peak.
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

/// Maximum of f: Brent's method around the largest value on a grid.
template <class F>
Peak largest(const F& f, double low, double high) {
  const std::vector<double> grid = logarithmic(low, high, 2001);
  const auto best = std::ranges::max_element(grid, {}, f);
  const double a = best == grid.begin() ? *best : best[-1], b = best + 1 == grid.end() ? *best : best[1];
  const auto [omega, least] = boost::math::tools::brent_find_minima([&](double w) { return -f(w); }, a, b,
                                                                    std::numeric_limits<double>::digits);
  return {omega, -least};
}

/// Settings of one of the four figures.
struct Figure {
  const char *name, *heading;
  bool designed, hub;

  /// theta/theta_f or y/theta_f at a frequency.
  [[nodiscard]] std::function<Complex(double)> value(const ClosedLoop& loop) const {
    return [hub_angle = hub, &loop](double omega) {
      const auto r = loop.response(Complex(0, omega), 2);
      return hub_angle ? r.theta : r.deflection;
    };
  }
  [[nodiscard]] std::string title() const {
    return fmt::format("Closed loop, {} gains: Bode plot of the {}", designed ? "designed" : "unit",
                       hub ? "hub angle" : "deflection at 2 ft");
  }
};
constexpr std::array figures = {
    Figure{"fig-3.13", "Unit gains: the hub angle has a peak of 14 dB", false, true},
    Figure{"fig-3.14", "Unit gains: the deflection has a sharp peak at every mode", false, false},
    Figure{"fig-3.15", "Designed gains: the hub angle has almost no peak", true, true},
    Figure{"fig-3.16", "Designed gains: the deflection keeps a sharp peak at 52 rad/s", true, false}};

void draw(const Figure& f, const ClosedLoop& loop, scene::Show& show) {
  const std::vector<double> omega = frequencies(loop);
  std::vector<double> size, phase;
  // The phase is unwrapped from point to point.
  const auto value = f.value(loop);
  double angle = std::arg(value(omega.front()));
  for (const double w : omega) {
    size.push_back(std::abs(value(w)));
    angle += std::remainder(std::arg(value(w)) - angle, 2 * std::numbers::pi);
    phase.push_back(angle * 180 / std::numbers::pi);
  }
  scene::Plot& plot = show.plots(f.heading);
  plot.stacked().size(760, 560).columns({"curve", "panel", "x", "y"});
  plot.panel("{/:Italic ω} (rad/s)",
             f.hub ? "|{/:Italic θ}/{/:Italic θ}_f|" : "|{/:Italic y}(2 ft)/{/:Italic θ}_f| (ft/rad)")
      .log_x(0.01, 1000)
      .log_y(f.hub ? 1e-8 : 1e-7, f.hub ? 10 : 1)
      .set("ylabel offset -0.5,0")
      .curve("", omega, size);
  const auto [low, high] = std::ranges::minmax(phase);
  const auto quarter = [](double degrees) { return 90 * std::round(degrees / 90); };
  plot.panel("{/:Italic ω} (rad/s)", "phase (deg)")
      .log_x(0.01, 1000)
      .y_range(quarter(low) - 30, quarter(high) + 30)
      .set(fmt::format("ytics {}, 90", quarter(low)))
      .set("ylabel offset -0.5,0")
      .curve("", omega, phase);
}

void put(const Figure& f, scene::Show& show) {
  const ClosedLoop loop(craft(true), f.designed ? designed_gains : unit_gains);
  draw(f, loop, show);
  const auto modulus = [value = f.value(loop)](double w) { return std::abs(value(w)); };
  // oracle: gss_control_loop * resonance*, * flexible peak
  if (f.hub) {
    const Peak peak = largest(modulus, 0.02, 4);
    show.near("largest modulus of theta/theta_f", peak.size, f.designed ? 1.099208 : 4.840390, 5e-7,
              "tools/oracles/gss_control_loop.py, seven digits");
    show.near("frequency of it", {peak.omega, "rad/s"}, f.designed ? 0.5256 : 0.2055, 5e-4,
              "tools/oracles/gss_control_loop.py, four digits");
    show.near("largest theta/theta_f in dB", {20 * std::log10(peak.size), "dB"}, f.designed ? 0.82 : 13.70,
              1e-2, "tools/oracles/gss_control_loop.py, two decimals");
    show.near("phase at 1000 rad/s, modulus",
              {std::abs(std::arg(f.value(loop)(1000))) * 180 / std::numbers::pi, "deg"}, 180, 1e-3,
              "the rigid body's k1/(J s^2 + k3 s): -180 degrees less k3/(1000 J) at most");
  } else {
    const double peak = std::max(largest(modulus, 52.1, 52.7).size, largest(modulus, 51.5, 53).size);
    show.near("flexible peak of y(2 ft)/theta_f near 52 rad/s", {peak, "ft/rad"}, f.designed ? 0.794 : 0.721,
              1e-3, "tools/oracles/gss_control_loop.py, three digits");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  std::vector<scene::Scene> all;
  for (const Figure& f : figures)
    all.push_back({.name = f.name,
                   .title = f.title(),
                   .place = std::string("Figure ") + (f.name + 4),
                   .content = scene::Content([f](scene::Show& show) { put(f, show); })});
  return all;
}

}  // namespace nlmech::chapters::gss_control::closed_bode

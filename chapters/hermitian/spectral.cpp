#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "nlmech/ivp/hermitian/hermitian_operators.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::hermitian::spectral {
namespace {

using ivp::HermitianStep;
/// Spectral radius and period error of the five operator pairs at z = h omega.
struct Spectrum {
  double z;
  std::array<double, 5> radius, period;
};

HermitianStep step_of(std::size_t row) { return ivp::solved_for_end(ivp::hermitian_table.at(row)); }

// Relative period error, T_numerical / T - 1.
double period_error(const HermitianStep& step, double z) { return z / ivp::amplification(step, z).phase - 1; }

std::vector<Spectrum> spectrum() {
  std::vector<Spectrum> all;
  constexpr int samples = 800;
  for (int i = 0; i <= samples; ++i) {
    Spectrum s{.z = std::pow(10, -1 + 3.0 * i / samples), .radius = {}, .period = {}};
    for (std::size_t row = 0; row < 5; ++row) {
      const auto a = ivp::amplification(step_of(row), s.z);
      s.radius.at(row) = a.spectral_radius;
      s.period.at(row) = std::abs(s.z / a.phase - 1);
    }
    all.push_back(s);
  }
  return all;
}

/// Stability limit of Argyris' pair between a stable and an unstable z, by bisection.
double edge(double stable, double unstable) {
  const HermitianStep argyris = ivp::solved_for_end(ivp::argyris);
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (stable + unstable) / 2;
    (ivp::amplification(argyris, middle).spectral_radius > 1 + 1e-12 ? unstable : stable) = middle;
  }
  return stable;
}

/// Smallest and largest spectral radius of Laier's pair for z from 0.01 to 10^4.
std::pair<double, double> radii_of_laier() {
  const HermitianStep laier = ivp::solved_for_end(ivp::laier);
  double least = HUGE_VAL, greatest = 0;
  for (int i = 0; i <= 6000; ++i) {
    const double radius = ivp::amplification(laier, std::pow(10, -2 + i / 1000.0)).spectral_radius;
    least = std::min(least, radius);
    greatest = std::max(greatest, radius);
  }
  return {least, greatest};
}

void draw(const std::vector<Spectrum>& all, scene::Show& show) {
  scene::Table data({{"z"},
                     {"rho_laier"},
                     {"rho_argyris"},
                     {"rho_newmark"},
                     {"period_laier"},
                     {"period_argyris"},
                     {"period_newmark"}});
  const auto period = [](double error) {
    return std::isfinite(error) && error > 0 ? std::optional(error) : std::nullopt;
  };
  for (const Spectrum& s : all) {
    const bool turns = s.radius[4] < 1 + 1e-12;  // otherwise the phase is 0 or pi: no period
    data.add({s.z, s.radius[0], s.radius[4], s.radius[1], period(s.period[0]),
              turns ? period(s.period[4]) : std::nullopt, period(s.period[1])});
  }
  scene::Plot& plot =
      show.plots("Spectral radius and period error: only Argyris' operators have unstable steps")
          .size(900, 520);
  plot.data(std::move(data));
  scene::Panel& radius = plot.panel("{/:Italic h ω}", "spectral radius of a step");
  radius.set("logscale x").x_range(0.5, 100).set("xtics (0.5, 1, 2, 5, 10, 20, 50, 100)");
  radius.y_range(0, 9).key("at graph 0.03, graph 0.97 left top Left reverse");
  for (const auto& [square, height] : {std::pair{10., 2.}, {12., 2.}, {60., 4.2}})
    radius.set(
        fmt::format("arrow from {0},graph 0 to {0},{1} nohead linestyle 11", std::sqrt(square), height));
  radius.note("√60", std::sqrt(60), 4.5, "center").note("√10, √12", 3.31, 2.3, "center");
  radius.columns("Argyris", "z:rho_argyris", scene::lines(5))
      .columns("Laier", "z:rho_laier", {"lines linewidth 3", 1})
      .columns("Newmark, Hoff, Bazzi", "z:rho_newmark", scene::lines(3));
  scene::Panel& periods = plot.panel("{/:Italic h ω}", "|period error|");
  periods.set("logscale x").x_range(0.1, 10).set("xtics (0.1, 0.2, 0.5, 1, 2, 5, 10)");
  periods.log_y(1e-8, 1).key("off");
  periods.columns("", "z:period_argyris", scene::lines(5))
      .columns("", "z:period_laier", scene::lines(1))
      .columns("", "z:period_newmark", scene::lines(3));
}

void put(const std::vector<Spectrum>& all, scene::Show& show) {
  draw(all, show);
  scene::Table table(
      {{"operators"}, {"greatest spectral radius", 4}, {"period error at h omega = 0.1", 4}, {"at 1", 4}});
  for (std::size_t row = 0; row < 5; ++row) {
    const HermitianStep step = step_of(row);
    double greatest = 0;
    for (const Spectrum& s : all) greatest = std::max(greatest, s.radius.at(row));
    table.add({ivp::hermitian_table.at(row).name, greatest, period_error(step, 0.1), period_error(step, 1)});
  }
  show.table(std::move(table));
  const auto coefficient = [](const ivp::HermitianPair& pair, int power) {
    const double z = 0.05;
    return period_error(ivp::solved_for_end(pair), z) / std::pow(z, power);
  };
  const char* series = "series of the phase angle; at z = 0.05 its next term is some 1e-3 of the first";
  const auto far = ivp::amplification(ivp::solved_for_end(ivp::argyris), 1e6).spectral_radius;
  double same = 0;
  for (const Spectrum& s : all)
    same = std::max({same, std::abs(s.radius[1] - s.radius[2]), std::abs(s.radius[1] - s.radius[3]),
                     std::abs(s.period[1] - s.period[2]), std::abs(s.period[1] - s.period[3])});
  const auto [least, greatest] = radii_of_laier();
  const char* half_trace =
      "half trace (z^4 - 60 z^2 + 144)/(z^4 + 12 z^2 + 144), within -1 and 1 for every z, and the "
      "determinant "
      "is 1: rounding";
  show.between("greatest spectral radius of Laier, h omega from 0.01 to 10000", greatest, 1 - 4e-16,
               1 + 4e-16, half_trace);
  show.between("least spectral radius of Laier, h omega from 0.01 to 10000", least, 1 - 4e-16, 1 + 4e-16,
               half_trace);
  show.near("start of the window of instability of Argyris", edge(3, 3.3), std::sqrt(10.0), 1e-9,
            "half trace -1: z^2 = 10");
  show.near("end of the window of instability of Argyris", edge(3.6, 3.3), std::sqrt(12.0), 1e-9,
            "half trace -1: z^2 = 12");
  show.near("last stable h omega of Argyris", edge(7, 9), std::sqrt(60.0), 1e-9, "half trace 1: z^2 = 60");
  show.near("spectral radius of Argyris for a very long step", far, 3 + std::sqrt(8.0), 1e-9, "half trace 3");
  show.near("period error of Laier over z^4", coefficient(ivp::laier, 4), 1. / 720, 0.01, series);
  show.near("period error of Argyris over z^4", coefficient(ivp::argyris, 4), 1. / 1440, 0.01, series);
  show.near("period error of Newmark over z^2", coefficient(ivp::newmark_pair, 2), 1. / 12, 0.01, series);
  show.at_most("difference of Newmark, Hoff and Bazzi", same, 0, "one method");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result("spectrum", "undamped linear oscillator, one step", spectrum);
  return {{.name = "spectral",
           .title = "Spectral radius and period error of the five pairs of operators",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::hermitian::spectral

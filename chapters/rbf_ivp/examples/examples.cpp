/// The three examples of section 4.4: assignment of runs to figures and tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "chapters/rbf_ivp/examples/histories.hpp"
#include "chapters/rbf_ivp/examples/rows.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::rbf_ivp::examples {
namespace {

using Scenes = std::vector<scene::Scene>;

/// Methods of one setting in the order of the tables: "ODE45-1", "Explicit-1", ...
std::vector<std::string> methods_of(const std::string& setting, bool with_ode45) {
  std::vector<std::string> all;
  if (with_ode45) all.push_back("ODE45-" + setting);
  for (const char* method : {"Explicit-", "RK4-", "Newmark-", "HHT-", "MCPI-", "RBF-Coll-"})
    all.push_back(method + setting);
  return all;
}

/// Methods of both settings, alternating.
std::vector<std::string> both_settings(bool with_ode45) {
  const std::vector<std::string> first = methods_of("1", with_ode45), second = methods_of("2", with_ode45);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < first.size(); ++i) all.insert(all.end(), {first[i], second[i]});
  return all;
}

/// Expected RMS error of v1 of the three masses.
Expected velocity(double value) {
  return about(value, 1e-4, "tools/oracles/rbf_ivp_methods.py, five digits");
}

/// One figure per row, numbered from @p number on.
Scenes histories_of_rows(const Example& example, int number) {
  Scenes scenes;
  for (const Row& row : example.rows) {
    const std::string& method = row.method;
    if (method == "ODE45") continue;  // the reference
    const Shown shown = method.starts_with("Explicit") ? Shown::positions : Shown::state;
    scenes.push_back(history(example, {number++, method, shown}));
  }
  return scenes;
}

void add_free_duffing(Scenes& scenes) {
  const Example example = free_duffing_rows();
  scenes.push_back(histories(example, "histories-duffing", both_settings(true)));
  std::ranges::move(histories_of_rows(example, 2), std::back_inserter(scenes));
  scenes.push_back(comparison(example, {16, 0, "x(t)", methods_of("1", true)}));
  scenes.push_back(result_table(example));
}

void add_impact(Scenes& scenes) {
  const Example example = impact_rows();
  scenes.push_back(histories(example, "histories-impact", both_settings(false)));
  std::ranges::move(histories_of_rows(example, 17), std::back_inserter(scenes));
  scenes.push_back(comparison(example, {29, 0, "x(t)", methods_of("1", false), "RBF-Coll-1"}));
  scenes.push_back(result_table(example));
}

/// Figure 4.31: the dissertation's own reference.
void put_response(const Record& record, scene::Show& show) {
  scene::Table data({{"t_s"}, {"x1"}, {"x2"}, {"x3"}});
  double next = 0, greatest_error = 0;
  for (const auto& value : record.values) {
    greatest_error = std::max(greatest_error, value.error.cwiseAbs().maxCoeff());
    if (value.t < next) continue;
    next = value.t + 0.1;
    data.add({value.t, value.x[0], value.x[1], value.x[2]});
  }
  const double load = problems::TextProblem("three-dof").parameter("frequency");
  scene::Panel& panel =
      show.plot(fmt::format("Positions of three masses: load and slowest mode beat every {:.0f} s",
                            2 * std::numbers::pi / std::abs(load - chain_frequencies()[0])),
                "{/:Italic t} (s)", "position");
  panel.place(0.12, 0.97, 0.13, 0.83).set("title offset 0,1.4").x_range(0, 200);
  panel.key("at screen 0.535, screen 0.905 center top horizontal maxrows 1 samplen 3");
  panel.columns("x_3", "t_s:x3", {"lines dashtype solid linewidth 1.4", 2})
      .columns("x_2", "t_s:x2", {"lines dashtype solid linewidth 1.4", 4})
      .columns("x_1", "t_s:x1", {"lines linewidth 1.8", 1});
  show.figure().data(std::move(data));
  const ivp::State end = record.values.back().x;
  // oracle: rbf_ivp_ends three masses x?
  const char* digits60 = "tools/oracles/rbf_ivp_ends.py; 1e-11 for the tolerance 1e-13 over 17 000 steps";
  show.near("x1 at t = 200", end[0], 0.1621748860002476087, 1e-10, digits60);
  show.near("x2 at t = 200", end[1], 0.3465729515799773249, 1e-10, digits60);
  show.near("x3 at t = 200", end[2], 0.7582358883258399112, 1e-10, digits60);
  show.at_most("greatest error of any component", greatest_error, 1e-11, digits60);
}

void add_three_masses(Scenes& scenes) {
  const Example example = three_mass_rows();
  scenes.push_back(histories(example, "histories-three-masses", both_settings(false)));
  scenes.push_back({.name = "fig-4.31",
                    .title = "Three masses: the three positions in time by ode45",
                    .place = "Figure 4.31",
                    .content = scene::Content(put_response, example.nominal(example.row("ODE45")))});
  // oracle: rbf_ivp_methods 4.6 * v1
  const std::vector<History> histories = {
      {32, "Explicit-1", Shown::positions}, {33, "Explicit-2", Shown::positions},
      {34, "RK4-1", Shown::positions},      {35, "RK4-1", Shown::velocities, velocity(0.0052609)},
      {36, "RK4-2", Shown::positions},      {37, "RK4-2", Shown::velocities, velocity(5.8447e-7)},
      {38, "Newmark-1", Shown::positions},  {39, "Newmark-1", Shown::velocities, velocity(0.047947)},
      {40, "Newmark-2", Shown::positions},  {41, "Newmark-2", Shown::velocities, velocity(0.001171)},
      {42, "HHT-1", Shown::positions},      {43, "HHT-1", Shown::velocities, velocity(0.051642)},
      {44, "HHT-2", Shown::positions},      {45, "HHT-2", Shown::velocities, velocity(0.001469)},
      {46, "MCPI-1", Shown::positions},     {47, "MCPI-1", Shown::velocities, velocity(7.1822e-9)},
      {48, "MCPI-2", Shown::positions},     {49, "MCPI-2", Shown::velocities, velocity(4.4711e-9)},
      {50, "RBF-Coll-1", Shown::positions}, {51, "RBF-Coll-1", Shown::velocities},
      {52, "RBF-Coll-2", Shown::positions}, {53, "RBF-Coll-2", Shown::velocities}};
  for (const History& figure : histories) scenes.push_back(history(example, figure));
  for (int i = 0; i < 3; ++i)
    scenes.push_back(comparison(example, {54 + i, i, fmt::format("x_{}(t)", i + 1), methods_of("1", false)}));
  scenes.push_back(result_table(example));
}

}  // namespace

std::vector<scene::Scene> scenes() {
  Scenes scenes;
  add_free_duffing(scenes);
  add_impact(scenes);
  add_three_masses(scenes);
  return scenes;
}

}  // namespace nlmech::chapters::rbf_ivp::examples

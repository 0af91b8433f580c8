/// The three examples of section 4.4: which figures and tables show which of their runs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chapters/rbf_ivp/examples/histories.hpp"
#include "chapters/rbf_ivp/examples/rows.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/problems/three_mass_chain.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

/// "ODE45-1", "Explicit-1", ...: the methods of one setting, in the order of the tables.
std::vector<std::string> methods_of(const std::string& setting, bool with_ode45) {
  std::vector<std::string> all;
  if (with_ode45) all.push_back("ODE45-" + setting);
  for (const char* method : {"Explicit-", "RK4-", "Newmark-", "HHT-", "MCPI-", "RBF-Coll-"})
    all.push_back(method + setting);
  return all;
}

/// Velocities of the three masses: RMS error of v1.
Expected velocity(double value) {
  return about(value, 1e-4, "tools/oracles/rbf_ivp_methods.py, five digits");
}

}  // namespace

void add_free_duffing(scene::Chapter& chapter) {
  const Example<2> example = free_duffing_rows(chapter);
  std::vector<History> figures;
  int number = 2;
  for (const Row<2>& row : example.rows) {
    const bool explicit_method = row.reading.method.starts_with("Explicit");
    figures.push_back({number++, row.reading.method, explicit_method ? Shown::positions : Shown::state});
  }
  add_histories(chapter, example, figures);
  add_comparison(chapter, example, {16, 0, "x(t)", methods_of("1", true)});
  add_result_table(chapter, example);
}

void add_impact(scene::Chapter& chapter) {
  const Example<2> example = impact_rows(chapter);
  std::vector<History> figures;
  int number = 17;
  for (const Row<2>& row : example.rows) {
    if (row.reading.method == "ODE45") continue;
    const bool explicit_method = row.reading.method.starts_with("Explicit");
    figures.push_back({number++, row.reading.method, explicit_method ? Shown::positions : Shown::state});
  }
  add_histories(chapter, example, figures);
  add_comparison(chapter, example, {29, 0, "x(t)", methods_of("1", false)});
  add_result_table(chapter, example);
}

namespace {

/// Figure 4.31: the dissertation's own reference.
scene::Showing show_response(const Record<6>& record) {
  const double load = problems::ThreeMassChain{}.frequency;
  scene::Table data({{"t_s"}, {"x1"}, {"x2"}, {"x3"}});
  double next = 0, greatest_error = 0;
  for (const auto& value : record.values) {
    greatest_error = std::max(greatest_error, value.error.cwiseAbs().maxCoeff());
    if (value.t < next) continue;
    next = value.t + 0.1;
    data.add({value.t, value.x[0], value.x[1], value.x[2]});
  }
  scene::Showing showing;
  showing.figure = {
      std::move(data),
      "rbf_ivp-response",
      {{"heading", fmt::format("Three masses: load and slowest mode beat every {:.0f} s",
                               2 * std::numbers::pi / std::abs(load - chain_frequencies()[0]))}}};
  const ivp::State<6> end = record.values.back().x;
  // oracle: rbf_ivp_ends three masses x?
  const char* digits60 = "tools/oracles/rbf_ivp_ends.py; 1e-11 for the tolerance 1e-13 over 17 000 steps";
  showing.quantities = {
      scene::near("x1 at t = 200", "1", end[0], 0.1621748860002476087, 1e-10, digits60),
      scene::near("x2 at t = 200", "1", end[1], 0.3465729515799773249, 1e-10, digits60),
      scene::near("x3 at t = 200", "1", end[2], 0.7582358883258399112, 1e-10, digits60),
      scene::at_most("greatest error of any component", "1", greatest_error, 1e-11, digits60)};
  return showing;
}

}  // namespace

void add_three_masses(scene::Chapter& chapter) {
  const Example<6> example = three_mass_rows(chapter);
  const scene::Run<Record<6>>& ode45 = *example.row("ODE45").nominal;
  chapter.add({.name = "fig-4.31",
               .title = "Three masses: the three positions in time by ode45",
               .place = "Figure 4.31",
               .needs = {&ode45},
               .show = [&ode45](scene::Workshop& w) { return show_response(w.result(ode45)); }});
  // oracle: rbf_ivp_methods 4.6 * v1
  const std::vector<History> figures = {
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
  add_histories(chapter, example, figures);
  add_comparison(chapter, example, {54, 0, "x_1(t)", methods_of("1", false)});
  add_comparison(chapter, example, {55, 1, "x_2(t)", methods_of("1", false)});
  add_comparison(chapter, example, {56, 2, "x_3(t)", methods_of("1", false)});
  add_result_table(chapter, example);
}

}  // namespace nlmech::chapters::rbf_ivp

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy::misprint_study {
namespace {

/// A reading of l in Table 2.1 (member length or half span) with a load and its printed accuracy.
struct Case {
  const char* reading;
  double length, load, printed;
};
std::vector<Case> cases() {
  const scene::Printed printed;
  const double last = printed["elgohary/table-2.5/Newton/achieved accuracy"],
               near = printed["elgohary/table-2.4/Newton/achieved accuracy"];
  return {{"l is the member's length", 12.94, last_load, last},
          {"l is the half span", std::hypot(12.94, 0.44), last_load, last},
          {"l is the member's length", 12.94, near_load, near}};
}

/// Last two iterates of Newton's iteration with A_nd as printed, which cycles.
struct Cycle {
  Case setting;
  std::array<double, 2> residual, deflection;  ///< relative; inch
  double root, consistent, misprinted;         ///< delta; dF/ddelta there; tangent with A_nd as printed

  [[nodiscard]] double load() const { return setting.load; }
  [[nodiscard]] const char* reading() const { return setting.reading; }
  [[nodiscard]] double printed() const { return setting.printed; }
  [[nodiscard]] double even() const { return residual[1]; }
  [[nodiscard]] double odd() const { return residual[0]; }
  [[nodiscard]] double greater() const { return std::max(residual[0], residual[1]); }
  [[nodiscard]] double lesser() const { return std::min(residual[0], residual[1]); }
  [[nodiscard]] double even_in_load() const { return residual[1] * setting.load; }
  [[nodiscard]] double odd_in_load() const { return residual[0] * setting.load; }
  [[nodiscard]] double multiplier() const { return 1 - consistent / misprinted; }
};

double slope(Model model, const Case& c, double deflection) {
  LoadedToggle toggle(model, 0.44, c.load, c.length);
  Eigen::MatrixXd b;
  toggle.equations().linearise(toggle.unknowns(deflection));
  toggle.equations().matrix(b);
  return b(0, 0);
}

Cycle cycle(const Case& c) {
  LoadedToggle toggle(Model::element_printed, 0.44, c.load, c.length),
      exact(Model::element, 0.44, c.load, c.length);
  std::vector<IterationRecord> trace, to_root;
  static_cast<void>(iterate(toggle, {.tolerance = relative_tolerance(c.load, 1e-6)}, &trace));
  static_cast<void>(iterate(exact, {.tolerance = 1e-9}, &to_root));
  const IterationRecord &last = trace.at(trace.size() - 1), &before = trace.at(trace.size() - 2);
  const double root = to_root.back().deflection;
  return {c,
          {before.residual / toggle.scale(), last.residual / toggle.scale()},
          {before.deflection, last.deflection},
          root,
          slope(Model::element, c, root),
          slope(Model::element_printed, c, root)};
}

/// Newton's map delta - F/K with the tangent K of a model.
double newton_map(Model model, double deflection) {
  LoadedToggle toggle(model, 0.44, last_load);
  Eigen::VectorXd x = toggle.unknowns(deflection), f(1);
  Eigen::MatrixXd b;
  toggle.equations().residual(x, f);
  toggle.equations().linearise(x);
  toggle.equations().matrix(b);
  x[0] -= f[0] / b(0, 0);
  return toggle.deflection(x);
}

std::vector<Cycle> all_cycles() {
  std::vector<Cycle> all;
  for (const Case& c : cases()) all.push_back(cycle(c));
  return all;
}

void draw(const Cycle& c, scene::Show& show) {
  constexpr double low = 0.56, high = 0.72;
  std::vector<double> grid;
  for (int i = 0; i <= 160; ++i) grid.push_back(low + (high - low) * i / 160);
  scene::Panel& panel =
      show.plot("Newton's map: with A_{nd} as printed the iterates cycle about the root",
                "deflection {/:Italic δ}_{k} (in)", "next deflection {/:Italic δ}_{k+1} (in)");
  panel.key("below").x_range(low, high).y_range(0.56, 0.76);
  show.figure().size(760, 540);
  const auto [a, b] = c.deflection;
  panel.curve("{/:Italic δ}_{k+1} = {/:Italic δ}_{k}", {low, high}, {low, high}, scene::lines(13))
      .curve(
          "consistent tangent", grid, std::identity(), [](double d) { return newton_map(Model::element, d); },
          scene::lines(1))
      .curve(
          "{/:Italic A}_{nd} as printed", grid, std::identity(),
          [](double d) { return newton_map(Model::element_printed, d); }, scene::lines(5))
      .curve("the cycle", {a, b, b, a, a}, {b, b, a, a, b}, scene::linespoints(3))
      .curve("root", {c.root}, {c.root}, scene::large_points(4));
}

void put(const std::vector<Cycle>& all, scene::Show& show) {
  draw(all[0], show);
  show.table(all, {{"load (lb)", &Cycle::load, 4},
                   {"reading", &Cycle::reading},
                   {"|F|/|F(0)|, greater", &Cycle::greater, 5},  // rounding decides which iterations have it
                   {"lesser", &Cycle::lesser, 5},
                   {"greater (lb of load)", [](const Cycle& c) { return c.greater() * c.setting.load; }, 5},
                   {"lesser (lb)", [](const Cycle& c) { return c.lesser() * c.setting.load; }, 5},
                   {"published", &Cycle::printed, 5},
                   {"K at the root (lb/in)", &Cycle::consistent, 4},
                   {"K with A_nd as printed", &Cycle::misprinted, 4},
                   {"multiplier 1 - K/K'", &Cycle::multiplier, 4}});
  // oracle: homotopy_williams cycle under *, element 0.44 slope of the half*
  const char *program = "tools/oracles/homotopy_williams.py, all its digits",
             *four = "tools/oracles/homotopy_williams.py, four digits";
  const Cycle &last = all[0], &span = all[1], &near = all[2];
  show.near("residual of the cycle, 44 lb, iteration 1000", last.even(), 0.30373, 2e-5, program);
  show.near("residual of the cycle, 44 lb, iteration 999", last.odd(), 0.10028, 5e-5, program);
  show.between("the same over the printed 0.3042, less 1", last.even() / last.printed() - 1, -0.002, -0.001,
               "0.30373 is 0.15 % less; nothing is fitted");
  show.near("residual of the cycle, 44 lb, l the half span", span.greater(), 0.30029, 2e-5, program);
  show.near("residual of the cycle, 43.79 lb, iteration 1000", {near.even_in_load(), "lb"}, 4.389, 2e-4,
            program);
  show.near("residual of the cycle, 43.79 lb, iteration 999", {near.odd_in_load(), "lb"}, 13.73, 5e-4,
            program);
  show.near("dF/ddelta at the root, 43.79 lb", {near.consistent, "lb/in"}, 91.00, 1e-4, four);
  show.near("the same with A_nd as printed", {near.misprinted, "lb/in"}, 40.68, 2e-4, four);
  show.near("multiplier of Newton's map, 43.79 lb", near.multiplier(), 1 - 91.00 / 40.68, 3e-4,
            "the same two numbers; below -1 the root repels");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result cycles(
      "cycles", "Newton from rest for 1000 iterations, one element a member, A_nd of Eq. 2.35 as printed",
      all_cycles);
  return {{.name = "misprint-study",
           .title = "Newton's iteration with the tangent as printed: a cycle about the root",
           .content = scene::Content(put, cycles)}};
}

}  // namespace nlmech::chapters::homotopy::misprint_study

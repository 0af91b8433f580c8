#include <fmt/format.h>

#include <cmath>

#include "chapters/homotopy/curves.hpp"
#include "chapters/homotopy/rows.hpp"
#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// Half span and member length read into Table 2.1, and loads.
struct Case {
  const char* reading;
  double length, load, printed;
};
const std::array cases = {Case{"l is the member's length", 12.94, last_load, 0.3042},
                          Case{"l is the half span", std::hypot(12.94, 0.44), last_load, 0.3042},
                          Case{"l is the member's length", 12.94, near_load, 4.2894}};

/// The cycle of Newton's iteration with A_nd as printed.
struct Cycle {
  Case setting;
  std::array<double, 2> residual, deflection;  ///< relative; inch
  double root, consistent, misprinted;         ///< delta, dF/ddelta, and what is taken for it, there
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
  std::vector<Trace> trace, to_root;
  static_cast<void>(iterate(toggle, {.tolerance = relative_tolerance(c.load, 1e-6)}, &trace));
  static_cast<void>(iterate(exact, {.tolerance = 1e-9}, &to_root));
  const Trace &last = trace.at(trace.size() - 1), &before = trace.at(trace.size() - 2);
  const double root = to_root.back().deflection;
  return {c,
          {before.residual / toggle.scale(), last.residual / toggle.scale()},
          {before.deflection, last.deflection},
          root,
          slope(Model::element, c, root),
          slope(Model::element_printed, c, root)};
}

/// Newton's map delta - F/K with the tangent of a model.
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

scene::Figure draw(const Cycle& c) {
  Curves figure("With A_{nd} as printed Newton turns about the root for ever",
                "deflection {/:Italic δ}_{k} (in)", "next deflection {/:Italic δ}_{k+1} (in)");
  constexpr double low = 0.56, high = 0.72;
  figure.begin("{/:Italic δ}_{k+1} = {/:Italic δ}_{k}", "l13");
  figure.add(low, low);
  figure.add(high, high);
  for (const Model model : {Model::element, Model::element_printed}) {
    const bool exact = model == Model::element;
    figure.begin(exact ? "consistent tangent" : "{/:Italic A}_{nd} as printed", exact ? "l1" : "l5");
    for (int i = 0; i <= 160; ++i) {
      const double d = low + (high - low) * i / 160;
      figure.add(d, newton_map(model, d));
    }
  }
  const auto [a, b] = c.deflection;
  figure.begin("the cycle", "b3");
  for (const auto& [x, y] : {std::pair{a, b}, {b, b}, {b, a}, {a, a}, {a, b}}) figure.add(x, y);
  figure.begin("root", "p4");
  figure.add(c.root, c.root);
  return figure.with("below", "1")
      .with("height", "540")
      .with("xrange", "[0.56:0.72]")
      .with("yrange", "[0.56:0.76]")
      .take();
}

scene::Table tabulate(const std::vector<Cycle>& all) {
  scene::Table table({{"load (lb)", 4},
                      {"reading"},
                      {"|F|/|F(0)|, even", 5},
                      {"odd", 5},
                      {"the same (lb of load)", 5},
                      {"odd (lb)", 5},
                      {"published", 5},
                      {"K at the root (lb/in)", 4},
                      {"K with A_nd as printed", 4},
                      {"multiplier 1 - K/K'", 4}});
  for (const Cycle& c : all) {
    const double load = c.setting.load;
    table.add({load, c.setting.reading, c.residual[1], c.residual[0], c.residual[1] * load,
               c.residual[0] * load, c.setting.printed, c.consistent, c.misprinted,
               1 - c.consistent / c.misprinted});
  }
  return table;
}

std::vector<scene::Quantity> quantities(const std::vector<Cycle>& all) {
  // oracle: homotopy_williams cycle under *, element 0.44 slope of the half*
  const char* program = "tools/oracles/homotopy_williams.py, all its digits";
  const Cycle &last = all[0], &span = all[1], &near = all[2];
  return {scene::near("residual of the cycle, 44 lb, iteration 1000", "1", last.residual[1], 0.30373, 2e-5,
                      program),
          scene::near("residual of the cycle, 44 lb, iteration 999", "1", last.residual[0], 0.10028, 5e-5,
                      program),
          {"the same over the printed 0.3042, less 1", "1", last.residual[1] / 0.3042 - 1, -0.002, -0.001,
           "0.30373 is 0.15 % less; nothing is fitted"},
          scene::near("residual of the cycle, 44 lb, l the half span", "1",
                      std::max(span.residual[0], span.residual[1]), 0.30029, 2e-5, program),
          scene::near("residual of the cycle, 43.79 lb, iteration 1000", "lb", near.residual[1] * near_load,
                      4.389, 2e-4, program),
          scene::near("residual of the cycle, 43.79 lb, iteration 999", "lb", near.residual[0] * near_load,
                      13.73, 5e-4, program),
          scene::near("dF/ddelta at the root, 43.79 lb", "lb/in", near.consistent, 91.00, 1e-4,
                      "tools/oracles/homotopy_williams.py, four digits"),
          scene::near("the same with A_nd as printed", "lb/in", near.misprinted, 40.68, 2e-4,
                      "tools/oracles/homotopy_williams.py, four digits"),
          scene::near("multiplier of Newton's map, 43.79 lb", "1", 1 - near.consistent / near.misprinted,
                      1 - 91.00 / 40.68, 3e-4, "the same two numbers; below -1 the root repels")};
}

}  // namespace

void add_misprint_study(scene::Chapter& chapter) {
  const auto& cycles = chapter.add_run<std::vector<Cycle>>(
      "cycles", "Newton from rest for 1000 iterations, one element a member, A_nd of Eq. 2.35 as printed", {},
      [](Workshop&) {
        std::vector<Cycle> all;
        for (const Case& c : cases) all.push_back(cycle(c));
        return all;
      });
  chapter.add({.name = "misprint-study",
               .title = "Newton's iteration with the tangent as printed: a cycle about the root",
               .place = "our own",
               .needs = {&cycles},
               .show = [&cycles](Workshop& w) {
                 const std::vector<Cycle>& all = w.result(cycles);
                 return scene::Showing{draw(all[0]), tabulate(all), quantities(all)};
               }});
}

}  // namespace nlmech::chapters

#include <array>
#include <cmath>
#include <vector>

#include "nlmech/comparison/commands/example_of.hpp"
#include "nlmech/comparison/cost/cost_scene.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::transversal::error_vs_time {
namespace {

using comparison::Kind;
using comparison::MethodSweep;

MethodSweep by_points(int p, bool quick) {
  constexpr std::array factors = {0.4, 0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625};
  MethodSweep c = comparison::by_steps("mtl", {}, Kind::source, 1, factors, quick);
  c.points = p;
  for (comparison::Setting& s : c.settings) s.settings.points = p;
  return c;
}

std::vector<MethodSweep> methods(bool quick) {
  constexpr std::array factors = {0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625};
  std::vector<MethodSweep> all;
  for (const int p : {1, 2, 3, 4, 5, 8}) all.push_back(by_points(p, quick));
  for (const char* name : {"laier", "newmark", "rk4", "rk6"})
    all.push_back(comparison::by_steps(name, {}, Kind::classical, 1, factors, quick));
  all.push_back(comparison::by_tolerances("adaptive-collocation", Kind::own, quick));
  all.push_back(comparison::by_tolerances("series", Kind::series, quick));
  all.push_back(comparison::by_tolerances("ode45", Kind::explicit_, quick));
  return all;
}

comparison::Example example() { return comparison::example_of(problems::TextProblem("driven-duffing")); }

void check(const comparison::Costs& costs, scene::Show& show) {
  const scene::MethodLine& three = costs.lines.of("mtl, p = 3");
  const auto error = [&](std::size_t i) { return three.attempts.at(i).error.value_or(NAN); };
  // Positions of the step sizes 0.1 and 0.025 in the full and the quick sweep.
  const double fourth = show.quick() ? error(1) / error(2) : error(2) / error(4);
  // oracle: transversal_motions driven Duffing *
  show.near("reference position at t = 50", static_cast<double>(example().reference(50)[0]),
            1.203734404401093362708, 1e-15, "tools/oracles/transversal_motions.py");
  show.between("error of p = 3, step over a quarter of it", fourth, 150, 400, "order 4: 256");
  show.at_most("least error of p = 5", costs.lines.of("mtl, p = 5").least_error(), 1e-9,
               "order 6 of steps of 0.00625, above roundings");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {
      comparison::work_precision_scene({.name = "",
                                        .problem = "Driven Duffing oscillator to t = 50",
                                        .reading = "x'' + x + x^3 = cos t from (1, 0); fixed steps by hand, "
                                                   "default settings over one sweep of tolerances",
                                        .example = example,
                                        .methods = methods,
                                        .check = check})};
}

}  // namespace nlmech::chapters::transversal::error_vs_time

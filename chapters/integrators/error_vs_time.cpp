#include <array>
#include <vector>

#include "nlmech/comparison/commands/example_of.hpp"
#include "nlmech/comparison/cost/cost_scene.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::integrators::error_vs_time {
namespace {

using comparison::Kind;

/// The equation of the commands on the chapter's page.
constexpr const char* equation = "x'' + 0.1 x' + x + 3 x^3 = 0.2 cos(1.1 t)";

std::vector<comparison::MethodSweep> methods(bool quick) {
  constexpr std::array<double, 7> factors = {1, 0.5, 0.25, 0.1, 0.05, 0.02, 0.005};
  return {comparison::by_tolerances("adaptive-collocation", Kind::own, quick),
          comparison::by_tolerances("series", Kind::series, quick),
          comparison::by_tolerances("ode45", Kind::explicit_, quick),
          comparison::by_tolerances("dop853", Kind::explicit_, quick),
          comparison::by_steps("rk4", {}, Kind::classical, 0.2, factors, quick),
          comparison::by_steps("newmark", {}, Kind::classical, 0.2, factors, quick)};
}

comparison::Example example() {
  const program::Equations equations(program::SourceText("equation", equation));
  return comparison::example_of(program::Problem(equations), "duffing", {1, 0}, 0, 50);
}

void check(const comparison::Costs& costs, scene::Show& show) {
  for (const char* method : {"adaptive-collocation", "series"}) check_tightest(costs, method, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {comparison::work_precision_scene(
      {.name = "",
       .problem = "A typed Duffing equation to t = 50",
       .reading = "typed equation, x = 1, x' = 0, to t = 50; default settings over one sweep of tolerances, "
                  "fixed steps over one of steps",
       .example = example,
       .methods = methods,
       .change = 1e-8,
       .check = check})};
}

}  // namespace nlmech::chapters::integrators::error_vs_time

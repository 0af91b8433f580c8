#include <array>
#include <string>
#include <vector>

#include "nlmech/comparison/commands/example_of.hpp"
#include "nlmech/comparison/cost/cost_scene.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::hermitian::error_vs_time {
namespace {

using comparison::Kind;
using comparison::MethodSweep;

/// @param scale largest fixed step size
std::vector<MethodSweep> methods(double scale, bool quick) {
  constexpr std::array<double, 7> factors = {1, 0.5, 0.25, 0.1, 0.05, 0.02, 0.005};
  return {comparison::by_tolerances("laier", Kind::source, quick),
          comparison::by_tolerances("argyris", Kind::source, quick),
          comparison::by_steps("newmark", {}, Kind::classical, scale, factors, quick),
          comparison::by_steps("rk4", {}, Kind::classical, scale, factors, quick),
          comparison::by_tolerances("series", Kind::series, quick),
          comparison::by_tolerances("ode45", Kind::explicit_, quick)};
}

/// @param scale largest fixed step size
/// @param change of the initial state, for the condition number
scene::Scene scene_of(const problems::TextProblem& problem, const std::string& title, double end,
                      double scale, double change) {
  return comparison::work_precision_scene(
      {.name = problem.name,
       .problem = title,
       .reading = "default settings over one sweep of tolerances, fixed steps over one of steps",
       .example =
           [=] { return comparison::example_of(problem, problem.name, problem.initial_state(), 0, end); },
       .methods = [=](bool quick) { return methods(scale, quick); },
       .change = change,
       .check = [](const comparison::Costs& costs,
                   scene::Show& show) { check_tightest(costs, "laier", show); }});
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {
      scene_of(problems::TextProblem("driven-duffing"), "Driven Duffing oscillator to t = 50", 50, 0.4, 1e-8),
      scene_of(problems::TextProblem("van-der-pol", {{"mu", 100}}), "Van der Pol, mu = 100, to t = 200", 200,
               0.01, 1e-6)};
}

}  // namespace nlmech::chapters::hermitian::error_vs_time

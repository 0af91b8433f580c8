#include <limits>
#include <string>
#include <vector>

#include "chapters/algebraic_series/examples.hpp"
#include "nlmech/comparison/cost/cost_scene.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::error_vs_time {
namespace {

using comparison::Kind;

std::vector<comparison::MethodSweep> methods(bool quick) {
  return {comparison::by_tolerances("series", Kind::series, quick),
          comparison::by_tolerances("ode45", Kind::explicit_, quick)};
}

// The tolerance bounds the error of a step; the condition number is the growth of a change of the initial
// state. Errors of later steps can grow more, so the bound of one tolerance per step has an empirical factor
// of 20: on the oscillator the error was 13 times the bound without it at 1e-8, 3.4 times at 1e-13. The run
// checked is the one with the tightest tolerance, not the one with the smallest error.
void check(const comparison::Costs& costs, scene::Show& show) {
  const scene::Attempt& last = costs.lines.of("series").attempts.back();
  const double bound =
      20 * comparison::tightest_tolerance(show.quick()) * static_cast<double>(comparison::steps_of(last));
  show.at_most("error of series at its tightest tolerance",
               last.error.value_or(std::numeric_limits<double>::quiet_NaN()), bound * costs.condition,
               "20 tolerances in each step, all of one sign, times the condition number; measured: 13");
}

/// @param change of the initial state, for the condition number
scene::Scene scene_of(const comparison::Example& (*example)(), const std::string& name,
                      const std::string& title, double change) {
  return comparison::work_precision_scene({.name = name,
                                           .problem = title,
                                           .reading = "default settings over one sweep of tolerances",
                                           .example = example,
                                           .methods = methods,
                                           .change = change,
                                           .check = check});
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {scene_of(lorenz_example, "lorenz", "Lorenz system to t = 20", 1e-9),
          scene_of(oscillator_example, "oscillator", "Strongly nonlinear oscillator to 375 s", 1e-8),
          scene_of(bodies_example, "bodies", "Four bodies to t = 3000", 1e-9)};
}

}  // namespace nlmech::chapters::algebraic_series::error_vs_time

/// Parameters on which nothing of this project was chosen.
#include <vector>

#include "chapters/rbf_ivp/cost/sweeps.hpp"
#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/comparison/cost/cost_scene.hpp"

namespace nlmech::chapters::rbf_ivp::held_back {
namespace {

using comparison::Costs;

/// The series knows nothing of the method that is judged.
Costs measure_held_back(bool quick) {
  const Case& c = held_back_case();
  const auto accurate = ivp::named_integrator("series", {.tolerance = 1e-15});
  return {comparison::cost_curves(c, with_step_control(quick), quick), comparison::condition_of(c, accurate)};
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {comparison::cost_scene(
      {.name = "held-back",
       .problem = "Held-back parameters (eta = 10)",
       .reading = "free Duffing oscillator with eta = 10 from x = 2 to t = 100; one sweep of tolerances for "
                  "all",
       .measure = measure_held_back,
       .check = [](const Costs& costs, scene::Show& show) {
         if (show.quick()) return check_at_quick_tolerance(costs, show);
         check_at_rounding(costs, "adaptive-collocation", show);
       }})};
}

}  // namespace nlmech::chapters::rbf_ivp::held_back

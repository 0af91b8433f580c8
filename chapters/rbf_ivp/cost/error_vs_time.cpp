#include <limits>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/cost/sweeps.hpp"
#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/comparison/cost_scene.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

/// What a scene is about.
struct Subject {
  std::string problem, heading;
  double radial_low, radial_high;  ///< least error of RBF-Coll with N = 35, recorded
  const char* reason;
};

template <int n>
comparison::Costs measure(const Case<n>& c, const StepScales& scales, bool quick) {
  const auto accurate = ivp::named_integrator<n>("radau-coll", {.step = scales.many_nodes / 8, .nodes = 17});
  return {comparison::cost_curves(c, contenders(scales, quick), quick),
          comparison::condition_of(c, accurate)};
}

/// That a method errs by no more than four roundings of one sign in each step of its best run.
scene::Quantity at_rounding(const comparison::Costs& costs, const std::string& method) {
  const comparison::Cost* best = comparison::best_of(comparison::curve_of(costs.curves, method));
  const double rounding = costs.condition * std::numeric_limits<double>::epsilon() / 2;
  const double steps = best != nullptr ? static_cast<double>(best->work.steps) : 0;
  return scene::at_most("least error of " + method, "1", comparison::least_error(costs.curves, method),
                        4 * steps * rounding,
                        "condition times half an epsilon, four times in each step and always of one sign");
}

/// With --quick, whose tolerances end at 1e-8: that tolerance in each step, all of one sign, times the
/// condition.
scene::Quantity at_quick_tolerance(const comparison::Costs& costs, const std::string& method) {
  const comparison::Cost* best = comparison::best_of(comparison::curve_of(costs.curves, method));
  const double steps = best != nullptr ? static_cast<double>(best->work.steps) : 0;
  return scene::at_most("least error of " + method, "1", comparison::least_error(costs.curves, method),
                        comparison::tightest_tolerance(true) * steps * costs.condition,
                        "the tightest tolerance in each step, all of one sign, times the condition");
}

std::vector<scene::Quantity> promises(const comparison::Costs& costs, const Subject& subject, bool quick) {
  return {{"least error of rbf-coll, N = 35", "1", comparison::least_error(costs.curves, "rbf-coll, N = 35"),
           subject.radial_low, subject.radial_high, subject.reason},
          at_rounding(costs, "radau-coll, N = 17"),
          quick
              ? at_quick_tolerance(costs, "adaptive-collocation")
              : scene::at_most("least error of adaptive-collocation", "1",
                               comparison::least_error(costs.curves, "adaptive-collocation"), 1e-11,
                               "end errors of hundred periods are the tolerance, 1e-13, times their number")};
}

template <int n>
void add_scene(scene::Chapter& chapter, const Subject& subject, const Case<n>& (*problem)(),
               const StepScales& scales) {
  comparison::add_cost_scene(
      chapter,
      {.name = subject.problem,
       .heading = subject.heading,
       .reading = "default settings over one sweep of tolerances; steps of fixed-step methods by hand, "
                  "beginning with the dissertation's",
       .measure = [problem, scales](bool quick) { return measure(problem(), scales, quick); },
       .promises = [subject](const comparison::Costs& costs,
                             bool quick) { return promises(costs, subject, quick); }});
}

/// The series knows nothing of the method that is judged.
comparison::Costs measure_held_back(bool quick) {
  const Case<2>& c = held_back_case();
  const auto accurate = ivp::named_integrator<2>("series", {.tolerance = 1e-15});
  return {comparison::cost_curves(c, with_step_control(quick), quick), comparison::condition_of(c, accurate)};
}

}  // namespace

void add_error_vs_time(scene::Chapter& chapter) {
  add_scene<2>(chapter,
               {"duffing", "Free Duffing oscillator to t = 500: digits against cost", 2e-7, 2e-5,
                "recorded: 5.4e-6 at the best of its steps; rounding scatters tenfold"},
               free_duffing_case, free_duffing_steps());
  add_scene<2>(chapter,
               {"impact", "Impact on the Duffing oscillator to t = 500: digits against cost", 1e-8, 2e-5,
                "rounding in the derivatives, condition 1e15: as for the free oscillator, at smaller "
                "amplitude"},
               impact_case, impact_steps());
  add_scene<6>(chapter,
               {"three-dof", "Three masses to t = 200: digits against cost", 8e-10, 8e-8,
                "recorded: 7.7e-9 at h = 20; rounding scatters tenfold"},
               three_mass_case, three_mass_steps());
}

void add_held_back(scene::Chapter& chapter) {
  comparison::add_cost_scene(
      chapter, {.name = "held-back",
                .heading = "Parameters held back while tuning (eta = 10, x = 2): digits against cost",
                .reading = "free Duffing oscillator with eta = 10 from x = 2 to t = 100; one sweep of "
                           "tolerances for all",
                .measure = measure_held_back,
                .promises = [](const comparison::Costs& costs, bool quick) -> std::vector<scene::Quantity> {
                  return {quick ? at_quick_tolerance(costs, "adaptive-collocation")
                                : at_rounding(costs, "adaptive-collocation")};
                }});
}

}  // namespace nlmech::chapters::rbf_ivp

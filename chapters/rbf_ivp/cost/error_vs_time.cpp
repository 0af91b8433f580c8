#include <limits>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/cost/sweeps.hpp"
#include "chapters/rbf_ivp/examples/cases.hpp"
#include "nlmech/comparison/cost/cost_scene.hpp"

namespace nlmech::chapters::rbf_ivp::error_vs_time {
namespace {

using comparison::Costs;

/// Settings of a scene.
struct Subject {
  std::string name, title;
  double radial_low, radial_high;  ///< recorded range of the least error of RBF-Coll with N = 35
  const char* reason;
};

/// Checks the least error of a method: at most @p each_step in each step of that run, all of one sign, times
/// the condition number.
void check_least(const Costs& costs, const std::string& method, double each_step, const char* reason,
                 scene::Show& show) {
  const scene::MethodLine& line = costs.lines.of(method);
  const double steps = line.best() != nullptr ? static_cast<double>(comparison::steps_of(*line.best())) : 0;
  show.at_most("least error of " + method, line.least_error(), each_step * steps * costs.condition, reason);
}

scene::Scene against_all(const Subject& subject, const Case& (*problem)(), const StepScales& scales) {
  const auto measure = [problem, scales](bool quick) -> Costs {
    const auto accurate = ivp::named_integrator("radau-coll", {.step = scales.many_nodes / 8, .nodes = 17});
    return {{"", comparison::cost_curves(problem(), sweeps(scales, quick), quick)},
            comparison::condition_of(problem(), accurate)};
  };
  const auto check = [subject](const Costs& costs, scene::Show& show) {
    show.between("least error of rbf-coll, N = 35", costs.lines.of("rbf-coll, N = 35").least_error(),
                 subject.radial_low, subject.radial_high, subject.reason);
    check_least(costs, "radau-coll, N = 17", 4 * std::numeric_limits<double>::epsilon() / 2,
                "condition times half an epsilon, four times in each step and always of one sign", show);
    if (show.quick())
      return check_least(costs, "adaptive-collocation", comparison::tightest_tolerance(true),
                         "the tightest tolerance in each step, all of one sign, times the condition", show);
    show.at_most("least error of adaptive-collocation", costs.lines.of("adaptive-collocation").least_error(),
                 1e-11, "end errors of hundred periods are the tolerance, 1e-13, times their number");
  };
  return comparison::work_precision_scene(
      {.name = subject.name,
       .problem = subject.title,
       .reading = "default settings over one sweep of tolerances; steps of "
                  "fixed-step methods by hand, beginning with the dissertation's",
       .measure = measure,
       .check = check});
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {against_all({"duffing", "Free Duffing oscillator to t = 500", 2e-7, 2e-5,
                       "regression value: 5.4e-6 at the best of its steps; rounding scatters tenfold"},
                      free_duffing_case, free_duffing_steps()),
          against_all({"impact", "Impact on the Duffing oscillator to t = 500", 1e-8, 2e-5,
                       "rounding in the derivatives, condition 1e15: as for the free oscillator, at smaller "
                       "amplitude"},
                      impact_case, impact_steps()),
          against_all({"three-dof", "Three masses to t = 200", 8e-10, 8e-8,
                       "regression value: 7.7e-9 at h = 20; rounding scatters tenfold"},
                      three_mass_case, three_mass_steps())};
}

}  // namespace nlmech::chapters::rbf_ivp::error_vs_time

#include "nlmech/comparison/cost/cost_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nlmech::comparison {

namespace {

/// Heading with the fastest methods, without them if it would be too long.
std::string heading_of(const std::string& problem, const scene::ProblemLines& lines) {
  const std::string whole = problem + ": " + scene::fastest_by_digits(lines);
  return whole.size() <= 118 ? whole : problem + ": achieved digits and cost";
}

/// Runs every setting of every method and peer. The condition number for two changes is that of runs by
/// `series` at the tolerance 1e-16.
Costs costs_of(const WorkPrecisionStudy& study, bool quick) {
  if (study.measure) return study.measure(quick);
  const Example example = study.example();
  std::vector<MethodSweep> all = study.methods(quick);
  for (MethodSweep& peer : all_peers(quick)) all.push_back(std::move(peer));
  Costs costs{{"", cost_curves(example, all, quick)}};
  if (study.change == 0) return costs;
  const auto accurate = ivp::named_integrator("series", {.tolerance = 1e-16});
  costs.condition = condition_of(example, accurate, study.change);
  costs.again = condition_of(example, accurate, 100 * study.change);
  return costs;
}

}  // namespace

void check_tightest(const Costs& costs, const std::string& method, scene::Show& show) {
  const scene::Attempt& tightest = costs.lines.of(method).attempts.back();
  show.at_most("error of " + method + " at the tightest tolerance", tightest.error.value_or(HUGE_VAL),
               tightest_tolerance(show.quick()) * static_cast<double>(steps_of(tightest)) *
                   std::max(1.0, costs.condition),
               "number of steps times tolerance (errors of equal sign) times condition");
}

scene::Scene work_precision_scene(WorkPrecisionStudy what) {
  const std::string suffix = what.name.empty() ? "" : "-" + what.name;
  const scene::Result<Costs> costs(
      "times" + suffix,
      fmt::format("{}; error: median over 16 ends of steps in the last tenth; one thread, median of repeats; "
                  "a curve ends with its first run of more than {} right-hand sides, {} with --quick",
                  what.reading, most_right_hand_sides, most_right_hand_sides_quick),
      [what](bool quick) { return costs_of(what, quick); });
  const auto put = [what](const Costs& all, scene::Show& show) {
    const bool known = all.condition >= 10;  // smaller ones have no effect on the 15 digits of the figure
    scene::show_work_precision({.heading = heading_of(what.problem, all.lines),
                                .work = work_columns(),
                                .work_label = "right-hand sides evaluated",
                                .groups = method_groups(),
                                .rounding = known ? all.condition * 0x1p-53 : 0},
                               {all.lines}, show);
    if (what.change > 0)
      show.near("condition", all.condition, all.again, 0.05,
                "response to a hundred times the change of the initial state: it is linear");
    what.check(all, show);
  };
  return {.name = "error-vs-time" + suffix,
          .title = what.problem + ": achieved digits and cost",
          .content = scene::Content(put, costs)};
}

}  // namespace nlmech::comparison

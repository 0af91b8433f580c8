#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/integrators/sweep.hpp"
#include "nlmech/comparison/cost/cost_curves.hpp"
#include "nlmech/scene/work_precision.hpp"

namespace nlmech::chapters::integrators::diagrams {
namespace {

/// Runs of a method for the diagram; none if the method does not apply to the problem.
scene::MethodLine line_of(const MethodTrials& m) {
  scene::MethodLine line =
      comparison::line_of(m.method, comparison::kind_of(comparison::any_method(m.method)));
  for (const Trial& t : m.trials) {
    if (t.status != "refused")
      line.attempts.push_back(comparison::attempt_of((t.step > 0 ? "" : "tolerance ") + t.setting(), t.status,
                                                     t.error, t.work, t.time));
  }
  return line;
}

/// Draws the work-precision diagram of a problem.
void put(const ProblemTrials& p, scene::Show& show) {
  scene::ProblemLines lines;
  double most = 0;
  for (const MethodTrials& m : p.methods) {
    lines.lines.push_back(line_of(m));
    for (const Trial& t : m.trials) most = std::max(most, t.success() ? t.digits() : 0);
  }
  const bool known = p.condition >= 10;  // smaller rounding is below the 15 digits of the figure
  scene::show_work_precision({.heading = p.problem + ": " + scene::fastest_by_digits(lines),
                              .work = comparison::work_columns(),
                              .work_label = "right-hand sides evaluated",
                              .groups = comparison::method_groups(),
                              .rounding = known ? p.condition * 0x1p-53 : 0},
                             {lines}, show);
  const double lost_digits = std::log10(p.condition), tightest = show.quick() ? 8 : 13;
  show.between("digits of the best run", most, p.kind == Kind::extreme ? 3 : tightest - 2 - lost_digits, 16,
               "the tightest tolerance, accumulated over a hundred steps and multiplied by the condition; "
               "lower for extreme problems, whose work is limited");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  std::vector<scene::Scene> all;
  for (const std::string& problem : problem_names(true))
    all.push_back({.name = "error-vs-time-" + problem,
                   .title = fmt::format("Problem set, {}: achieved digits and cost", problem),
                   .content = scene::Content(put, sweep_of(problem))});
  return all;
}

}  // namespace nlmech::chapters::integrators::diagrams

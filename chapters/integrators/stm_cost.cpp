#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/integrators/sensitivity_cases.hpp"
#include "nlmech/comparison/cost/cost_curves.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::integrators::stm_cost {
namespace {

using comparison::Kind;

Kind kind_of(const std::string& method) {
  if (method == "series") return Kind::series;
  if (method == "adaptive-collocation") return Kind::own;
  if (method == "dop853") return Kind::explicit_;
  if (method == "cvodes-adams") return Kind::adams;
  return method == "cvodes-bdf" ? Kind::implicit : Kind::classical;
}

std::vector<scene::ProblemLines> lines(bool stiff, bool quick) {
  std::vector<scene::ProblemLines> all;
  for (const SensitivityCase& c : sensitivity_cases(stiff)) {
    scene::ProblemLines& problem = all.emplace_back(scene::ProblemLines{c.name, {}});
    for (const std::string& method : c.methods()) {
      scene::MethodLine& line = problem.lines.emplace_back(comparison::line_of(method, kind_of(method)));
      if (method.starts_with("cvodes")) line.side = scene::Side::peer;
      for (int digits = 4; digits <= (quick ? 8 : 13); digits += quick ? 4 : 1) {
        line.attempts.push_back(comparison::cost_of(c.example, fmt::format("tolerance 1e-{:02}", digits),
                                                    c.method(method, std::pow(10, -digits)), quick));
      }
    }
  }
  return all;
}

scene::Scene scene_of(bool stiff) {
  const std::string name = stiff ? "stm-cost-stiff" : "stm-cost";
  const std::string title =
      stiff ? "Sensitivities of two stiff problems: variational equations are ahead of CVODES"
            : "Sensitivities of three problems: variational equations are ahead of CVODES";
  const scene::Result<std::vector<scene::ProblemLines>> result(
      name,
      "solution and its derivatives by initial values and parameters; steps of nlmech methods are controlled "
      "by "
      "the solution alone; error: of any component, relative; median over 16 ends of steps in the last "
      "tenth; "
      "one thread, median of repeats",
      [stiff](bool quick) { return lines(stiff, quick); });
  const auto put = [title](const std::vector<scene::ProblemLines>& all, scene::Show& show) {
    auto groups = comparison::method_groups();
    groups[static_cast<std::size_t>(Kind::classical)].name = "differences of runs";
    scene::show_work_precision({.heading = title, .work = comparison::work_columns(), .groups = groups}, all,
                               show);
    for (const scene::ProblemLines& problem : all) {
      for (const scene::MethodLine& line : problem.lines) {
        if (line.method == "differences") continue;
        show.at_most(fmt::format("least error of {}, {}", line.method, problem.problem), line.least_error(),
                     show.quick() ? 1e-3 : 1e-7,
                     "tolerances down to 1e-13 (1e-8), times the number of steps and the condition");
      }
    }
  };
  return {.name = name, .title = title, .content = scene::Content(put, result)};
}

}  // namespace

std::vector<scene::Scene> scenes() { return {scene_of(false), scene_of(true)}; }

}  // namespace nlmech::chapters::integrators::stm_cost

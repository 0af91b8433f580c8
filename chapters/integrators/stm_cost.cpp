#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/integrators/sensitivity_cases.hpp"
#include "nlmech/comparison/cost/cost_curves.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"

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

/// Errors and times of a method over its tolerances.
scene::MethodLine line_of(const SensitivityCase& c, const SensitivityMethod& method, bool quick) {
  scene::MethodLine line = comparison::line_of(method.name, kind_of(method.name));
  if (method.name.starts_with("cvodes")) line.side = scene::Side::peer;
  for (int digits = 4; digits <= (quick ? 8 : 13); digits += quick ? 4 : 1) {
    const double tolerance = std::pow(10, -digits);
    const SensitivityMethod::Run run = method.make(tolerance);
    const auto error = c.error(run);
    line.attempts.push_back(scene::attempt(
        fmt::format("tolerance 1e-{:02}", digits), [&] { return run(c.end); },
        [&error](const auto& end) -> scene::Ending {
          if (end && error) return {{}, error};
          return {Status::failure(Outcome::not_converged, "the method fails"), {}};
        },
        quick));
  }
  return line;
}

std::vector<scene::ProblemLines> lines(bool quick) {
  std::vector<scene::ProblemLines> all;
  for (const SensitivityCase& c : sensitivity_cases()) {
    scene::ProblemLines& problem = all.emplace_back(scene::ProblemLines{c.name, {}});
    for (const SensitivityMethod& method : c.methods()) problem.lines.push_back(line_of(c, method, quick));
  }
  return all;
}

void put(const std::vector<scene::ProblemLines>& all, scene::Show& show) {
  auto groups = comparison::method_groups();
  groups[static_cast<std::size_t>(Kind::classical)].name = "differences of runs";
  scene::show_work_precision(
      {.heading = "Sensitivities of three problems: digits and run time", .groups = groups}, all, show);
  for (const scene::ProblemLines& problem : all) {
    double best = 1;
    for (const scene::MethodLine& line : problem.lines) {
      if (line.method != "differences") best = std::min(best, line.least_error());
    }
    show.at_most("least error of the sensitivities, " + problem.problem, best, show.quick() ? 1e-4 : 1e-8,
                 "tolerances down to 1e-13 (1e-8), times the number of steps and the condition");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result<std::vector<scene::ProblemLines>> all(
      "stm-cost",
      "derivatives by initial values and parameters, steps controlled by the solution alone; error: of a "
      "column in its maximum norm, the worst, median over 16 ends in the last tenth; one thread",
      lines);
  return {{.name = "stm-cost",
           .title = "Sensitivities: variational equations, CVODES and differences",
           .content = scene::Content(put, all)}};
}

}  // namespace nlmech::chapters::integrators::stm_cost

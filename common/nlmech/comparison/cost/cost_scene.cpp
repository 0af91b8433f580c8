#include "nlmech/comparison/cost/cost_scene.hpp"

#include <fmt/format.h>

#include <utility>

namespace nlmech::comparison {

namespace {

/// Who is fastest, if the picture is wide enough to say it.
std::string heading_of(const std::string& problem, const scene::ProblemLines& lines) {
  const std::string whole = problem + ": " + scene::who_leads(lines);
  return whole.size() <= 118 ? whole : problem + ": digits against cost";
}

}  // namespace

void check_condition(const Costs& costs, scene::Show& show) {
  show.near("condition", costs.condition, costs.again, 0.05,
            "a hundred times the change of the begin: the answer is linear");
}

scene::Scene cost_scene(CostScene what) {
  const std::string suffix = what.name.empty() ? "" : "-" + what.name;
  const scene::Result<Costs> costs(
      "times" + suffix,
      fmt::format("{}; error: median over 16 ends of steps in the last tenth; one thread, median of repeats; "
                  "a curve ends with its first run of more than {} right-hand sides, {} with --quick",
                  what.reading, enough_right_hand_sides, enough_for_a_look),
      what.measure);
  const auto put = [what](const Costs& all, scene::Show& show) {
    const bool known = all.condition >= 10;  // less lies beyond the 15 digits of the picture
    const scene::ProblemLines lines{"", method_lines(all.curves)};
    scene::show_work_precision({.heading = heading_of(what.problem, lines),
                                .work = {"right-hand sides", "steps", "rejected"},
                                .work_label = "right-hand sides evaluated",
                                .groups = method_groups(),
                                .rounding = known ? all.condition * 0x1p-53 : 0},
                               {lines}, show);
    what.check(all, show);
  };
  return {.name = "error-vs-time" + suffix,
          .title = what.problem + ": digits against cost",
          .content = scene::Content(put, costs)};
}

}  // namespace nlmech::comparison

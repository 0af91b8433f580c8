#include "nlmech/comparison/cost_scene.hpp"

#include <fmt/format.h>

#include <utility>

namespace nlmech::comparison {

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
    scene::Figure figure = cost_figure(all.curves, what.heading, all.condition);
    figure.variables.insert(what.variables.begin(), what.variables.end());
    show.draw(std::move(figure.data), std::move(figure.template_name), std::move(figure.variables));
    show.table(cost_table(all.curves));
    what.check(all, show);
  };
  return {.name = "error-vs-time" + suffix, .title = what.heading, .content = scene::Content(put, costs)};
}

void add_cost_scene(scene::Chapter& chapter, const CostScene& what) {
  const std::string suffix = what.name.empty() ? "" : "-" + what.name;
  const auto& run = chapter.add_run<Costs>(
      "times" + suffix,
      fmt::format("{}; error: median over 16 ends of steps in the last tenth; one thread, median of repeats; "
                  "a curve ends with its first run of more than {} right-hand sides, {} with --quick",
                  what.reading, enough_right_hand_sides, enough_for_a_look),
      {}, [measure = what.measure](scene::Workshop& w) { return measure(w.quick()); });
  chapter.add(
      {.name = "error-vs-time" + suffix,
       .title = what.heading,
       .place = "our own",
       .needs = {&run},
       .show = [&run, what](scene::Workshop& w) {
         const Costs& costs = w.result(run);
         scene::Figure figure = cost_figure(costs.curves, what.heading, costs.condition);
         for (const auto& [name, value] : what.variables) figure.variables[name] = value;
         return scene::Showing{std::move(figure), cost_table(costs.curves), what.promises(costs, w.quick())};
       }});
}

}  // namespace nlmech::comparison

#include <limits>
#include <vector>

#include "chapters/rbf_ivp/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "chapters/rbf_ivp/sweeps.hpp"
#include "nlmech/comparison/cost_curves.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

struct HeldBack {
  std::vector<comparison::Curve> curves;
  double condition = 0;
};

HeldBack measure(bool quick) {
  const Case<2>& c = held_back_case();
  const auto accurate = ivp::named_integrator<2>("series", {.tolerance = 1e-15});
  return {comparison::cost_curves(c, with_step_control(quick), quick), comparison::condition_of(c, accurate)};
}

scene::Showing show(const HeldBack& held) {
  scene::Showing showing;
  showing.figure = comparison::cost_figure(held.curves, "eta = 10, x = 2: parameters held back while tuning",
                                           held.condition);
  showing.table = comparison::cost_table(held.curves);
  const comparison::Cost* best =
      comparison::best_of(comparison::curve_of(held.curves, "adaptive-collocation"));
  const double rounding = held.condition * std::numeric_limits<double>::epsilon() / 2;
  const double steps = best != nullptr ? static_cast<double>(best->work.steps) : 0;
  showing.quantities = {
      scene::at_most("least error of adaptive-collocation", "1",
                     comparison::least_error(held.curves, "adaptive-collocation"), 4 * steps * rounding,
                     "condition times half an epsilon, four times in each step and always of one sign")};
  return showing;
}

}  // namespace

void add_held_back(scene::Chapter& chapter) {
  const auto& run = chapter.add_timed_run<HeldBack>(
      "times-held-back",
      "free Duffing oscillator with eta = 10 from x = 2 to t = 100; one sweep of tolerances for all; error: "
      "median over 16 ends of steps in the last tenth; one thread, median of repeats",
      {}, [](Workshop& w) { return measure(w.quick()); });
  chapter.add({.name = "error-vs-time-held-back",
               .title = "Parameters held back while tuning: digits against cost",
               .place = "our own",
               .needs = {&run},
               .seconds = 10,
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters

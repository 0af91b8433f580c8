#include <limits>
#include <utility>
#include <vector>

#include "chapters/rbf_ivp/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "chapters/rbf_ivp/sweeps.hpp"
#include "nlmech/comparison/cost_curves.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

struct Measured {
  std::vector<comparison::Curve> curves;
  double condition = 0;  ///< of the example
};

template <int n>
Measured measure(const Case<n>& c, const StepScales& scales, bool quick) {
  const auto accurate = ivp::named_integrator<n>("radau-coll", {.step = scales.many_nodes / 8, .nodes = 17});
  return {comparison::cost_curves(c, contenders(scales, quick), quick),
          comparison::condition_of(c, accurate)};
}

/// What a scene is about.
struct Subject {
  std::string problem, heading;
  double radial_low, radial_high;  ///< least error of RBF-Coll with N = 35, from an independent program
  const char* reason;
};

scene::Showing show(const Measured& measured, const Subject& subject) {
  const auto& curves = measured.curves;
  scene::Showing showing;
  showing.figure = comparison::cost_figure(curves, subject.heading, measured.condition);
  showing.table = comparison::cost_table(curves);
  const comparison::Cost* radau = comparison::best_of(comparison::curve_of(curves, "radau-coll, N = 17"));
  const double rounding = measured.condition * std::numeric_limits<double>::epsilon() / 2;
  const double steps = radau != nullptr ? static_cast<double>(radau->work.steps) : 0;
  showing.quantities = {
      {"least error of rbf-coll, N = 35", "1", comparison::least_error(curves, "rbf-coll, N = 35"),
       subject.radial_low, subject.radial_high, subject.reason},
      scene::at_most("least error of radau-coll, N = 17", "1",
                     comparison::least_error(curves, "radau-coll, N = 17"), 4 * steps * rounding,
                     "condition times half an epsilon, four times in each step and always of one sign"),
      scene::at_most("least error of adaptive-collocation", "1",
                     comparison::least_error(curves, "adaptive-collocation"), 1e-11,
                     "end errors of hundred periods are the tolerance, 1e-13, times their number")};
  return showing;
}

template <int n>
void add_scene(scene::Chapter& chapter, const Subject& subject, const Case<n>& (*problem)(),
               const StepScales& scales) {
  const auto& run = chapter.add_timed_run<Measured>(
      "times-" + subject.problem,
      "default settings over one sweep of tolerances; steps of fixed-step methods by hand, beginning with "
      "the "
      "dissertation's; error: median over 16 ends of steps in the last tenth; one thread, median of repeats",
      {}, [problem, scales](Workshop& w) { return measure(problem(), scales, w.quick()); });
  chapter.add({.name = "error-vs-time-" + subject.problem,
               .title = subject.heading,
               .place = "our own",
               .needs = {&run},
               .seconds = 15,
               .show = [&run, subject](Workshop& w) { return show(w.result(run), subject); }});
}

}  // namespace

void add_error_vs_time(scene::Chapter& chapter) {
  add_scene<2>(chapter,
               {"duffing", "Free Duffing oscillator to t = 500: digits against cost", 2e-7, 2e-5,
                "an independent program: 5.4e-6 at the best of its steps; rounding scatters tenfold"},
               free_duffing_case, free_duffing_steps());
  add_scene<2>(chapter,
               {"impact", "Impact on the Duffing oscillator to t = 500: digits against cost", 1e-8, 2e-5,
                "rounding in the derivatives, condition 1e15: as for the free oscillator, at smaller "
                "amplitude"},
               impact_case, impact_steps());
  add_scene<6>(chapter,
               {"three-dof", "Three masses to t = 200: digits against cost", 8e-10, 8e-8,
                "an independent program: 7.7e-9 at h = 20; rounding scatters tenfold"},
               three_mass_case, three_mass_steps());
}

}  // namespace nlmech::chapters

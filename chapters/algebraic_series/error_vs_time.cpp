#include <string>
#include <utility>
#include <vector>

#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/samples.hpp"
#include "chapters/algebraic_series/scenes.hpp"
#include "nlmech/comparison/cost_curves.hpp"

namespace nlmech::chapters {
namespace {

using comparison::Contender;
using comparison::Kind;
using scene::Workshop;

struct Measured {
  std::vector<comparison::Curve> curves;
  double condition = 0;  ///< of the example
  double again = 0;      ///< the same by a hundred times the change
};

std::vector<Contender> contenders(bool quick) {
  std::vector<Contender> all = {comparison::by_tolerances("series", Kind::series, quick),
                                comparison::by_tolerances("ode45", Kind::explicit_, quick)};
  for (const Contender& peer : comparison::all_peers(quick)) all.push_back(peer);
  return all;
}

template <int n>
Measured measure(const comparison::Example<n>& c, double change, bool quick) {
  const auto accurate = ivp::named_integrator<n>("series", {.tolerance = 1e-16});
  return {comparison::cost_curves(c, contenders(quick), quick), comparison::condition_of(c, accurate, change),
          comparison::condition_of(c, accurate, 100 * change)};
}

/// What a scene is about.
struct Subject {
  std::string problem, heading;
  double change;  ///< of the begin, for the condition
};

scene::Showing show(const Measured& m, const std::string& heading) {
  scene::Showing showing;
  showing.figure = comparison::cost_figure(m.curves, heading, m.condition);
  showing.table = comparison::cost_table(m.curves);
  const comparison::Cost* best = comparison::best_of(comparison::curve_of(m.curves, "series"));
  const comparison::Cost& tightest = comparison::curve_of(m.curves, "series").costs.back();
  const double steps = static_cast<double>(tightest.work.steps);
  const double tolerance = m.curves.front().costs.size() > 2 ? 1e-13 : 1e-8;
  showing.quantities = {
      scene::near("condition", "1", m.condition, m.again, 0.05,
                  "a hundred times the change of the begin: the answer is linear"),
      scene::at_most("least error of series", "1", best != nullptr ? *best->error : HUGE_VAL,
                     tolerance * steps * m.condition,
                     "the tightest tolerance in each step, all of one sign, times the condition")};
  return showing;
}

template <int n>
void add_scene(scene::Chapter& chapter, const comparison::Example<n>& (*example)(), const Subject& subject) {
  const auto& run = chapter.add_timed_run<Measured>(
      "times-" + subject.problem,
      "default settings over one sweep of tolerances; error: median over 16 ends of steps in the last tenth; "
      "one thread, median of repeats",
      {}, [example, subject](Workshop& w) { return measure(example(), subject.change, w.quick()); });
  chapter.add({.name = "error-vs-time-" + subject.problem,
               .title = subject.heading,
               .place = "our own",
               .needs = {&run},
               .seconds = 5,
               .show = [&run, subject](Workshop& w) { return show(w.result(run), subject.heading); }});
}

}  // namespace

void add_error_vs_time(scene::Chapter& chapter) {
  add_scene<3>(chapter, lorenz_example, {"lorenz", "Lorenz system to t = 20: digits against cost", 1e-9});
  add_scene<2>(chapter, oscillator_example,
               {"oscillator", "Strongly nonlinear oscillator to 375 s: digits against cost", 1e-8});
  add_scene<Eigen::Dynamic>(chapter, bodies_example,
                            {"bodies", "Four bodies to t = 3000: digits against cost", 1e-9});
}

}  // namespace nlmech::chapters

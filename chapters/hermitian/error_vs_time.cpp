#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "chapters/hermitian/scenes.hpp"
#include "nlmech/comparison/cost_curves.hpp"
#include "nlmech/problems/driven_duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/support/errors.hpp"

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

/// @param end of the comparison
template <class Problem>
comparison::Example<2> example(const Problem& problem, double end) {
  using Trajectory = problems::ReferenceTrajectory<long double, Problem>;
  const auto x0 = Problem::initial_state();
  const auto path =
      std::make_shared<const Trajectory>(problem, x0.template cast<long double>().eval(), 0, end);
  if (!path->status().ok()) throw Failure(path->status());
  ivp::State<2> amplitude = x0.cwiseAbs();
  for (int i = 1; i <= 2000; ++i)
    amplitude = amplitude.cwiseMax((*path)(end * i / 2000.0L).template cast<double>().cwiseAbs());
  return {.name = std::string(Problem::name),
          .system = ivp::System<2>(problem),
          .x0 = x0,
          .t0 = 0,
          .t1 = end,
          .amplitude = amplitude,
          .reference = [path](double t) { return (*path)(t); }};
}

std::vector<Contender> contenders(double scale, bool quick) {
  constexpr std::array<double, 7> factors = {1, 0.5, 0.25, 0.1, 0.05, 0.02, 0.005};
  std::vector<Contender> all = {comparison::by_tolerances("laier", Kind::own, quick),
                                comparison::by_tolerances("argyris", Kind::own, quick),
                                comparison::by_steps("newmark", {}, Kind::classical, scale, factors, quick),
                                comparison::by_steps("rk4", {}, Kind::classical, scale, factors, quick),
                                comparison::by_tolerances("series", Kind::series, quick),
                                comparison::by_tolerances("ode45", Kind::explicit_, quick)};
  for (const Contender& peer : comparison::all_peers(quick)) all.push_back(peer);
  return all;
}

Measured measure(const comparison::Example<2>& c, double scale, double change, bool quick) {
  const auto accurate = ivp::named_integrator<2>("series", {.tolerance = 1e-16});
  return {comparison::cost_curves(c, contenders(scale, quick), quick),
          comparison::condition_of(c, accurate, change), comparison::condition_of(c, accurate, 100 * change)};
}

scene::Showing show(const Measured& m, const std::string& heading) {
  scene::Showing showing;
  // The picture ends at 15 digits; a floor beyond is not drawn.
  showing.figure = comparison::cost_figure(m.curves, heading, m.condition < 10 ? 0 : m.condition);
  showing.figure->variables["own_name"] = "Hermitian operators";
  showing.table = comparison::cost_table(m.curves);
  const comparison::Curve& laier = comparison::curve_of(m.curves, "laier");
  const comparison::Cost& tightest = laier.costs.back();
  const double tolerance = laier.costs.size() > 2 ? 1e-13 : 1e-8;
  showing.quantities = {
      scene::near("condition", "1", m.condition, m.again, 0.05,
                  "a hundred times the change of the begin: the answer is linear"),
      scene::at_most("error of laier at the tightest tolerance", "1", tightest.error.value_or(HUGE_VAL),
                     tolerance * static_cast<double>(tightest.work.steps) * std::max(1.0, m.condition),
                     "the tolerance in each step, all of one sign, times the condition")};
  return showing;
}

/// What a scene is about.
struct Subject {
  std::string name, heading;
  double scale;   ///< longest fixed step
  double change;  ///< of the begin, for the condition
};

template <class Problem>
void add_scene(scene::Chapter& chapter, const Problem& problem, double end, const Subject& subject) {
  const auto& run = chapter.add_timed_run<Measured>(
      "times-" + subject.name,
      "default settings over one sweep of tolerances, fixed steps "
      "over one of steps; error: median over 16 ends of "
      "steps in the last tenth; one thread, median of repeats",
      {}, [problem, end, subject](Workshop& w) {
        return measure(example(problem, end), subject.scale, subject.change, w.quick());
      });
  chapter.add({.name = "error-vs-time-" + subject.name,
               .title = subject.heading,
               .place = "our own",
               .needs = {&run},
               .seconds = 5,
               .show = [&run, subject](Workshop& w) { return show(w.result(run), subject.heading); }});
}

}  // namespace

void add_error_vs_time(scene::Chapter& chapter) {
  add_scene(chapter, problems::DrivenDuffing{}, 50,
            {"duffing", "Driven Duffing oscillator to t = 50: digits against cost", 0.4, 1e-8});
  add_scene(chapter, problems::VanDerPol{.mu = 100}, 200,
            {"van-der-pol", "Van der Pol, mu = 100, to t = 200: digits against cost", 0.01, 1e-6});
}

}  // namespace nlmech::chapters

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "chapters/two_body_series/orbits/propagators.hpp"
#include "nlmech/comparison/cost/cost_scene.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::two_body_series::error_vs_time {
namespace {

using comparison::Example;
using comparison::Kind;

constexpr int orbits = 20;
const char* const computed = "analytic-continuation";

/// Settings of a scene.
struct Subject {
  std::string name, title;
  double eccentricity;
  int order;               ///< order of fixed continuation
  std::vector<int> steps;  ///< steps per orbit, coarsest first
  int printed;             ///< index of the dissertation's value in `steps`; -1: none
  double low, high;        ///< recorded bounds of the error with the printed steps
};

/// Example of twenty orbits from the periapsis, a = 1, mu = 1; the error is |dr|/a.
Example example_of(const Subject& subject) {
  const orbit::State start = on_ellipse(subject.eccentricity);
  const auto reference = [start](double t) -> Vector<long double, 6> {
    const auto exact = state_in_50_digits(start, t, 1);
    Vector<long double, 6> x;
    x << exact.position, exact.velocity;
    return x;
  };
  const double greatest_speed = start.velocity.norm();
  ivp::State amplitude(6);
  amplitude << 1 + subject.eccentricity, 1, 1, greatest_speed, greatest_speed, greatest_speed;
  const auto error = [](const ivp::State& found, const Vector<long double, 6>& expected) {
    const Vector<long double, 3> d = found.head<3>().cast<long double>() - expected.head<3>();
    return static_cast<double>(d.norm());
  };
  return {.name = subject.name,
          .system = ivp::System(problems::TextProblem("two-body", {{"mu", 1}})),
          .x0 = joined(start),
          .t0 = 0,
          .t1 = orbits * revolution,
          .amplitude = amplitude,
          .reference = reference,
          .error = error};
}

/// Analytic continuation over the tolerances 1e-4 to 1e-17.
scene::MethodLine adaptive(const Example& c, bool quick) {
  scene::MethodLine curve = comparison::line_of(computed, Kind::own);
  for (int power = 4; power <= 17; power += quick ? 6 : 1) {
    const double tolerance = std::pow(10, -power);
    curve.attempts.push_back(
        cost_of(c, fmt::format("tolerance {:.0e}", tolerance),
                continuation_integrator(orbit::AnalyticContinuation{.tolerance = tolerance}, 1), quick));
  }
  return curve;
}

scene::MethodLine fixed(const Example& c, const Subject& subject, bool quick) {
  scene::MethodLine curve =
      comparison::line_of(fmt::format("fixed steps, order {}", subject.order), Kind::source);
  for (std::size_t i = 0; i < subject.steps.size(); ++i) {
    if (quick && subject.printed < 0 && i % 2 == 1) continue;  // short steps are slow
    const orbit::FixedContinuation method{.step = revolution / subject.steps[i], .order = subject.order};
    const char* remark = static_cast<int>(i) == subject.printed ? " (as printed)" : "";
    curve.attempts.push_back(cost_of(c, fmt::format("{} steps an orbit{}", subject.steps[i], remark),
                                     continuation_integrator(method, 1), quick));
  }
  return curve;
}

/// Kepler's solution at the end. Timed over 1000 calls, since one call is as short as the clock resolution.
scene::MethodLine closed(const Example& c, bool quick) {
  const auto run = kepler_integrator(1);
  scene::MethodLine line = comparison::line_of("Kepler", Kind::closed_form);
  line.attempts = {cost_of(c, "", run, true)};
  constexpr int calls = 1000;
  const orbit::State start = parted(c.x0);
  const auto work = [&] {
    for (int i = 0; i < calls; ++i) static_cast<void>(orbit::propagate_kepler(start, c.t1 - i, 1));
  };
  const Timing t = time_repeats(work, quick ? 1 : 9);
  line.attempts.front().time = {t.median / calls, t.smallest / calls, t.largest / calls, t.repeats};
  return line;
}

/// Condition number near the end: median of rounding_of_data() over 16 times in the last tenth, in units of
/// eps/2.
double condition_near_end(const Subject& subject) {
  std::vector<double> all;
  for (int i = 0; i < 16; ++i) {
    const double t = orbits * revolution * (1 - 0.1 * (i + 0.5) / 16);
    all.push_back(rounding_of_data(on_ellipse(subject.eccentricity), t, 1));
  }
  return median(all) / (std::numeric_limits<double>::epsilon() / 2);
}

/// Measures all methods; the condition number is condition_near_end().
comparison::Costs measure(const Subject& subject, bool quick) {
  const Example c = example_of(subject);
  std::vector<comparison::MethodSweep> others = {comparison::by_tolerances("series", Kind::series, quick),
                                                 comparison::by_tolerances("rkn1210", Kind::explicit_, quick),
                                                 comparison::by_tolerances("ode45", Kind::explicit_, quick)};
  for (const auto& peer : comparison::all_peers(quick)) others.push_back(peer);
  comparison::Costs m{{"", {closed(c, quick), adaptive(c, quick), fixed(c, subject, quick)}},
                      condition_near_end(subject)};
  for (auto& curve : comparison::cost_curves(c, others, quick)) m.lines.lines.push_back(std::move(curve));
  return m;
}

void check(const comparison::Costs& m, const Subject& subject, scene::Show& show) {
  const double rounding = m.condition * std::numeric_limits<double>::epsilon();
  const scene::MethodLine& series = m.lines.of(computed);
  const auto tightest = static_cast<double>(comparison::steps_of(*series.best()));
  const auto least = [&](const char* name) { return m.lines.of(name).least_error(); };
  show.at_most("least error of analytic continuation", least(computed), 8 * rounding,
               "eight roundings of the data times the condition of Kepler's problem, by its derivatives");
  show.at_most("error of Kepler's solution", least("Kepler"), 8 * rounding, "the same");
  show.at_most("error of analytic continuation at a tolerance of 1e-10",
               series.attempts[show.quick() ? 1 : 6].error.value_or(HUGE_VAL), 1e-10 * tightest * m.condition,
               "the tolerance in each step, all of one sign, times the condition");
  show.at_most("least error of rkn1210", least("rkn1210"),
               comparison::tightest_tolerance(show.quick()) * 600 * m.condition,
               "the tightest tolerance in each of at most 600 steps, times the condition");
  if (subject.printed < 0) return;
  show.between("error of the printed steps",
               m.lines.lines[2].attempts[static_cast<std::size_t>(subject.printed)].error.value_or(HUGE_VAL),
               subject.low, subject.high,
               "regression value at the end of 20 orbits; the median of others within a factor of ten");
}

scene::Scene scene_of(const Subject& subject) {
  return comparison::work_precision_scene(
      {.name = subject.name,
       .problem = subject.title,
       .reading = "units a = 1, mu = 1, 20 orbits from the periapsis; one sweep of tolerances in default "
                  "settings, fixed steps by hand; errors are |dr|/a against Kepler's equation in 50 digits",
       .measure = [subject](bool quick) { return measure(subject, quick); },
       .check = [subject](const comparison::Costs& costs,
                          scene::Show& show) { check(costs, subject, show); }});
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {scene_of({.name = "leo",
                    .title = "Twenty orbits, e = 0.1",
                    .eccentricity = 0.1,
                    .order = 10,
                    .steps = {15, 25, 35, 50, 70, 100, 140},
                    .printed = 1,
                    .low = 1e-7,  // 7.6 m of 7.309e6 m
                    .high = 1e-5}),
          scene_of({.name = "heo",
                    .title = "Twenty orbits, e = 0.7",
                    .eccentricity = 0.7,
                    .order = 30,
                    .steps = {50, 70, 100, 140},
                    .printed = 2,
                    .low = 9e-12,  // 2.4e-3 m of 2.7e7 m
                    .high = 9e-10}),
          scene_of({.name = "e099",
                    .title = "Twenty orbits, e = 0.99",
                    .eccentricity = 0.99,
                    .order = 30,
                    .steps = {10'000, 14'000, 20'000, 28'000},
                    .printed = -1,
                    .low = 0,
                    .high = 0})};
}

}  // namespace nlmech::chapters::two_body_series::error_vs_time

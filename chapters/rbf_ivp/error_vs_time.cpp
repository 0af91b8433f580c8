#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "chapters/rbf_ivp/accuracy.hpp"
#include "chapters/rbf_ivp/cases.hpp"
#include "chapters/rbf_ivp/contenders.hpp"
#include "chapters/rbf_ivp/own_reference.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

// After which a run is called off. No clock: it is to come out the same twice.
constexpr std::int64_t most_steps = 20'000'000;

/// One setting of one method.
struct Cost {
  std::string setting, status;
  std::optional<double> error;  ///< median of the relative errors; nothing if the run failed
  Statistics work;
  Timing time;  ///< seconds
};

/// A method with what its settings cost.
struct Curve {
  std::string name;
  Kind kind;
  std::vector<Cost> costs;  ///< empty: not in this build
};

struct Measured {
  std::vector<Curve> curves;
  double condition = 0;  ///< greatest relative change of the end for a relative change of the begin
};

/// Repeats for a tenth of a second; a slow run counts by itself.
Timing timing(const std::function<void()>& work, double first, bool quick) {
  if (quick || first > 0.1) return {first, first, first, 1};
  return time_repeats(work, std::clamp(static_cast<int>(0.1 / first), 1, 9));
}

template <int n>
Cost cost_of(const Case<n>& c, const Contender& contender, const Setting& setting, bool quick) {
  const ivp::NamedIntegrator<n> run = integrator<n>(contender, setting);
  const ivp::Limits limits{.steps = most_steps};
  const Accuracy seen = accuracy_of(c, run, limits);
  const auto again = [&] { static_cast<void>(run(c.system, c.x0, c.t0, c.nominal_end, {}, limits)); };
  return {setting.text, std::string(to_string(seen.status.outcome())), seen.error, seen.work,
          timing(again, seen.work.seconds, quick)};
}

/// By differences, from a method whose error is far below them: changes of the begin of a millionth of the
/// amplitudes, one component after the other, as they are at the end in amplitudes.
template <int n>
double condition_of(const Case<n>& c, double step) {
  constexpr double change = 1e-6;
  const auto run = ivp::named_integrator<n>("radau-coll", {.step = step, .nodes = 17});
  const auto end = [&](const ivp::State<n>& x0) {
    const auto solution = run(c.system, x0, c.t0, c.nominal_end, {}, {});
    if (!solution.status.ok()) throw Failure(solution.status);
    return solution.x;
  };
  const ivp::State<n> plain = end(c.x0);
  double greatest = 0;
  for (int i = 0; i < n; ++i) {
    ivp::State<n> x0 = c.x0;
    x0[i] += change * c.amplitude[i];
    const ivp::State<n> moved = (end(x0) - plain).cwiseQuotient(c.amplitude) / change;
    greatest = std::max(greatest, moved.cwiseAbs().maxCoeff());
  }
  return greatest;
}

template <int n>
Measured measure(const Case<n>& c, const StepScales& scales, bool quick) {
  Measured measured;
  for (const Contender& contender : contenders(scales, quick)) {
    Curve curve{contender.label(), contender.kind, {}};
    for (const Setting& setting : contender.settings)
      curve.costs.push_back(cost_of(c, contender, setting, quick));
    measured.curves.push_back(std::move(curve));
  }
  measured.condition = condition_of(c, scales.many_nodes / 8);
  return measured;
}

/// The digits that rounding leaves: half an epsilon at the begin.
double floor_digits(const Measured& m) {
  return -std::log10(m.condition * std::numeric_limits<double>::epsilon() / 2);
}

/// The setting of a curve with the smallest error; nothing if all failed.
const Cost* best_of(const Curve& curve) {
  const Cost* best = nullptr;
  for (const Cost& c : curve.costs) {
    if (c.error && (best == nullptr || *c.error < *best->error)) best = &c;
  }
  return best;
}

scene::Figure draw(const Measured& measured, std::string heading) {
  scene::Table data({{"kind"},
                     {"number"},
                     {"digits"},
                     {"time_s"},
                     {"time_low_s"},
                     {"time_high_s"},
                     {"rhs_evaluations"},
                     {"best"},
                     {"status"},
                     {"method"},
                     {"setting"}});
  std::vector<std::string> legend, kinds;
  std::int64_t number = 0;
  for (const Curve& curve : measured.curves) {
    if (curve.costs.empty()) continue;
    ++number;
    const auto kind = static_cast<std::int64_t>(curve.kind);
    legend.push_back(curve.name);
    kinds.push_back(std::to_string(kind));
    for (const Cost& c : curve.costs) {
      std::optional<double> digits;
      if (c.error) digits = digits_of(*c.error);
      data.add({kind, number, scene::to_cell(digits), c.time.median, c.time.smallest, c.time.largest,
                c.work.right_hand_sides, std::int64_t{&c == best_of(curve)}, c.status, curve.name,
                c.setting});
    }
  }
  return {std::move(data),
          "rbf_ivp-error-vs-time",
          {{"width", "1000"},
           {"height", "640"},
           {"heading", std::move(heading)},
           {"legend", fmt::format("{}", fmt::join(legend, "|"))},
           {"kinds", fmt::format("{}", fmt::join(kinds, " "))},
           {"floor_digits", fmt::format("{:.2f}", floor_digits(measured))}}};
}

scene::Table tabulate(const Measured& measured) {
  scene::Table table({{"method"},
                      {"setting"},
                      {"status"},
                      {"digits"},
                      {"time (ms)"},
                      {"from"},
                      {"to"},
                      {"right-hand sides"},
                      {"steps"},
                      {"rejected"}});
  for (const Curve& curve : measured.curves) {
    if (curve.costs.empty()) table.add({curve.name, {}, "not in this build", {}, {}, {}, {}, {}, {}, {}});
    for (const Cost& c : curve.costs) {
      std::optional<double> digits;
      if (c.error) digits = digits_of(*c.error);
      table.add({curve.name, c.setting, c.status, scene::to_cell(digits), 1e3 * c.time.median,
                 1e3 * c.time.smallest, 1e3 * c.time.largest, c.work.right_hand_sides, c.work.steps,
                 c.work.rejected});
    }
  }
  return table;
}

const Curve& curve_of(const Measured& measured, const std::string& name) {
  return *std::find_if(measured.curves.begin(), measured.curves.end(),
                       [&](const Curve& curve) { return curve.name == name; });
}

/// What a scene is about.
struct Subject {
  std::string problem, heading;
  double radial_low, radial_high;  ///< least error of RBF-Coll with N = 35, from an independent program
  const char* reason;
};

scene::Showing show(const Measured& measured, const Subject& subject) {
  const auto least = [&](const std::string& name) {
    const Cost* best = best_of(curve_of(measured, name));
    return best != nullptr ? *best->error : NAN;
  };
  scene::Showing showing;
  showing.figure = draw(measured, subject.heading);
  showing.table = tabulate(measured);
  const Cost* radau = best_of(curve_of(measured, "radau-coll, N = 17"));
  const double rounding = measured.condition * std::numeric_limits<double>::epsilon() / 2;
  const double steps = radau != nullptr ? static_cast<double>(radau->work.steps) : 0;
  showing.quantities = {
      {"least error of rbf-coll, N = 35", "1", least("rbf-coll, N = 35"), subject.radial_low,
       subject.radial_high, subject.reason},
      scene::at_most("least error of radau-coll, N = 17", "1", least("radau-coll, N = 17"),
                     4 * steps * rounding,
                     "condition times half an epsilon, four times in each step and always of one sign")};
  return showing;
}

template <int n>
void add_scene(scene::Chapter& chapter, const Subject& subject, const Case<n>& (*problem)(),
               const StepScales& scales) {
  const auto& run = chapter.add_run<Measured>(
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

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "chapters/two_body_series/ellipses.hpp"
#include "chapters/two_body_series/raw_recursion.hpp"
#include "chapters/two_body_series/scenes.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double eccentricity = 0.1;
constexpr int steps_an_orbit = 25;

/// A way to take @p orbits of steps_an_orbit steps of an order.
struct Way {
  std::string name;
  std::function<orbit::State(int order, int orbits)> run;
};

orbit::State by_kernel(InstructionSet set, int order, int orbits) {
  const orbit::FixedContinuation method{
      .step = revolution / steps_an_orbit, .order = order, .instructions = set};
  return orbit::propagate(on_ellipse(eccentricity), 0, orbits * revolution, orbit::Gravity{}, method).state;
}

orbit::State by_expansion(int order, int orbits) {
  orbit::Expansion<double> series(orbit::Gravity{}, order);
  orbit::State s = on_ellipse(eccentricity);
  for (int i = 0; i < orbits * steps_an_orbit; ++i) {
    series.expand(s, order);
    const orbit::State change = series.increments(revolution / steps_an_orbit, order, order - 1);
    s.position += change.position;
    s.velocity += change.velocity;
  }
  return s;
}

/// An orbit by derivatives and binomial coefficients, as the dissertation writes it. Not timed.
orbit::State by_derivatives(int order) {
  orbit::State s = on_ellipse(eccentricity);
  for (int i = 0; i < steps_an_orbit; ++i)
    s = raw_step(raw_derivatives(s, 1.0, order), revolution / steps_an_orbit);
  return s;
}

std::vector<Way> ways() {
  std::vector<Way> all = {{"plain loops", by_expansion}};
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!available(set)) continue;
    all.push_back({fmt::format("unrolled, {}", to_string(set)),
                   [set](int order, int orbits) { return by_kernel(set, order, orbits); }});
  }
  return all;
}

/// Time of a step.
struct StepCost {
  std::string way;
  int order;
  double ns;
  double distance;  ///< from what derivatives give, |dr|/a
};

/// Time of a run of the adaptive method.
struct RunCost {
  double eccentricity;
  int orbits;
  std::int64_t steps;
  double mean_order;
  double seconds, kepler_seconds;
};

struct Measured {
  std::vector<StepCost> steps;
  std::vector<RunCost> runs;
};

double seconds_of(const std::function<void()>& work, int repeats) {
  return time_repeats(work, repeats).median;
}

std::vector<StepCost> step_costs(bool quick) {
  std::vector<StepCost> all;
  const int orbits = quick ? 4 : 40;
  for (int order = 6; order <= 40; order += quick ? 17 : 2) {
    const orbit::State truth = by_derivatives(order);
    for (const Way& way : ways()) {
      const orbit::State end = way.run(order, 1);
      const double seconds = seconds_of([&] { (void)way.run(order, orbits); }, quick ? 1 : 7);
      all.push_back({way.name, order, 1e9 * seconds / (orbits * steps_an_orbit),
                     (end.position - truth.position).norm()});
    }
  }
  return all;
}

std::vector<RunCost> run_costs(bool quick) {
  std::vector<RunCost> all;
  for (const double e : {0.1, 0.7}) {
    const orbit::State start = on_ellipse(e);
    for (const int orbits : {1, 3, 10, 30, 100, 300, 1000}) {
      const double time = orbits * revolution;
      const auto end = orbit::propagate(start, 0, time, orbit::Gravity{}, orbit::AnalyticContinuation{});
      const auto work = [&] {
        (void)orbit::propagate(start, 0, time, orbit::Gravity{}, orbit::AnalyticContinuation{});
      };
      constexpr int calls = 1000;  // one alone is shorter than the clock can tell
      const auto closed = [&] {
        for (int i = 0; i < calls; ++i) (void)orbit::propagate_kepler(start, time, 1);
      };
      const int repeats = quick ? 1 : 5;
      all.push_back({e, orbits, end.statistics.steps, end.mean_order, seconds_of(work, repeats),
                     seconds_of(closed, repeats) / calls});
    }
  }
  return all;
}

scene::Table table_of(const Measured& m) {
  const std::vector<Way> all = ways();
  std::vector<scene::Column> columns = {{"order"}};
  for (const Way& way : all) columns.push_back({"time_ns a step, " + way.name, 3});
  scene::Table table(std::move(columns));
  for (std::size_t i = 0; i < m.steps.size(); i += all.size()) {
    std::vector<scene::Cell> row = {std::int64_t{m.steps[i].order}};
    for (std::size_t k = 0; k < all.size(); ++k) row.emplace_back(m.steps[i + k].ns);
    table.add(std::move(row));
  }
  return table;
}

scene::Table data_of(const Measured& m) {
  scene::Table data({{"line", 3, true}, {"x"}, {"time_s"}, {"steps"}, {"mean_order"}});
  for (const Way& way : ways()) {
    for (const StepCost& c : m.steps) {
      if (c.way == way.name) data.add({c.way, std::int64_t{c.order}, 1e-9 * c.ns, {}, {}});
    }
  }
  for (const RunCost& c : m.runs) {
    data.add({fmt::format("adaptive, e = {:g}", c.eccentricity), std::int64_t{c.orbits}, c.seconds, c.steps,
              c.mean_order});
  }
  for (const RunCost& c : m.runs) {
    if (c.eccentricity == 0.1) data.add({"Kepler", std::int64_t{c.orbits}, c.kepler_seconds, {}, {}});
  }
  return data;
}

const RunCost& run_of(const Measured& m, double e, int orbits) {
  return *std::find_if(m.runs.begin(), m.runs.end(),
                       [&](const RunCost& c) { return c.eccentricity == e && c.orbits == orbits; });
}

scene::Showing show(const Measured& m) {
  scene::Showing showing;
  showing.table = table_of(m);
  std::vector<std::string> names;
  for (const Way& way : ways()) names.push_back(way.name);
  showing.figure = {data_of(m),
                    "two_body_series-cost",
                    {{"width", "1000"},
                     {"height", "460"},
                     {"heading", "Time of a step against its order, and of a run against its orbits"},
                     {"step_lines", fmt::format("{}", fmt::join(names, "|"))}}};
  double distance = 0;
  for (const StepCost& c : m.steps) distance = std::max(distance, c.distance);
  const double rounding = std::numeric_limits<double>::epsilon() * steps_an_orbit *
                          orbit::kepler_condition(on_ellipse(eccentricity), revolution, 1).position;
  const auto linear = [&](double e) {
    return static_cast<double>(run_of(m, e, 1000).steps) / static_cast<double>(run_of(m, e, 10).steps) / 100;
  };
  const char* same = "every orbit is alike, but for the order, which settles within the first of them";
  showing.quantities = {
      scene::at_most("distance from raw derivatives after an orbit", "1", distance, rounding,
                     "the same series, an eps in each of 25 steps times the condition of the orbit"),
      scene::near("growth of the steps from 10 to 1000 orbits over 100, e = 0.1", "1", linear(0.1), 1, 0.06,
                  same),
      scene::near("growth of the steps from 10 to 1000 orbits over 100, e = 0.7", "1", linear(0.7), 1, 0.06,
                  same)};
  return showing;
}

}  // namespace

void add_cost(scene::Chapter& chapter) {
  const auto& run =
      chapter.add_run<Measured>("cost",
                                "e = 0.1, 25 steps an orbit, order from 6 to 40; runs of the adaptive method "
                                "in its default setting and "
                                "Kepler's solution of the same end; one thread, median of repeats",
                                {}, [](Workshop& w) {
                                  return Measured{step_costs(w.quick()), run_costs(w.quick())};
                                });
  chapter.add({.name = "cost",
               .title = "What a step costs by its order, and a run by its orbits",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters

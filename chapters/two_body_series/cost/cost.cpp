#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "chapters/two_body_series/orbits/ellipses.hpp"
#include "chapters/two_body_series/series/raw_recursion.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::two_body_series::cost {
namespace {

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
  return orbit::propagate(on_ellipse(eccentricity), 0, orbits * revolution, orbit::Gravity{}, method).x;
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

struct Outcome {
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
      const auto steps = static_cast<double>(end.statistics.steps),
                 orders = static_cast<double>(end.statistics.right_hand_sides);
      all.push_back({e, orbits, end.statistics.steps, orders / steps, seconds_of(work, repeats),
                     seconds_of(closed, repeats) / calls});
    }
  }
  return all;
}

/// A row an order, a column a way.
void tabulate(const std::vector<StepCost>& steps, scene::Show& show) {
  const std::vector<Way> all = ways();
  std::vector<scene::Column> columns = {{"order"}};
  for (const Way& way : all) columns.push_back({"time_ns a step, " + way.name});
  scene::Table table(std::move(columns));
  for (std::size_t i = 0; i < steps.size(); i += all.size()) {
    std::vector<scene::Cell> row = {steps[i].order};
    for (std::size_t k = 0; k < all.size(); ++k) row.emplace_back(steps[i + k].ns);
    table.add(std::move(row));
  }
  show.table(std::move(table));
}

scene::Table data_of(const Outcome& m) {
  scene::Table data({{"line", 3, true}, {"x"}, {"time_s"}, {"steps"}, {"mean_order"}});
  for (const Way& way : ways()) {
    for (const StepCost& c : m.steps) {
      if (c.way == way.name) data.add({c.way, c.order, 1e-9 * c.ns, {}, {}});
    }
  }
  for (const RunCost& c : m.runs)
    data.add({fmt::format("adaptive, e = {:g}", c.eccentricity), c.orbits, c.seconds, c.steps, c.mean_order});
  for (const RunCost& c : m.runs) {
    if (c.eccentricity == 0.1) data.add({"Kepler", c.orbits, c.kepler_seconds, {}, {}});
  }
  return data;
}

void draw(const Outcome& m, scene::Show& show) {
  scene::Plot& plot = show.plots("Unrolled steps: time grows nearly in proportion to the order");
  plot.size(1000, 460).data(data_of(m));
  scene::Panel& left = plot.panel("order", "time of a step (ns)");
  left.x_range(5, 41)
      .y_range(0, 2500)
      .set("xtics 5")
      .set("ytics 500")
      .set("ylabel offset 1.2,0")
      .key("top left");
  int line = 0;
  for (const Way& way : ways()) left.columns(way.name, "x:(1e9*column('time_s'))", {"linespoints"}, line++);
  scene::Panel& right = plot.panel("orbits", "time of a run");
  right.log_x(0.8, 1250).log_y(5e-8, 1e-1).key("top left");
  right.set("xtics ('1' 1, '10' 10, '100' 100, '1000' 1000)");
  right.set(
      "ytics ('0.1 µs' 1e-7, '1 µs' 1e-6, '10 µs' 1e-5, '0.1 ms' 1e-4, '1 ms' 1e-3, '10 ms' 1e-2, "
      "'100 ms' 1e-1)");
  right.columns("adaptive, e = 0.1", "x:time_s", {"linespoints", 1}, line);
  right.columns("adaptive, e = 0.7", "x:time_s", {"linespoints", 5}, line + 1);
  right.columns("Kepler's equation", "x:time_s", {"linespoints", 3}, line + 2);
}

/// Steps of 1000 orbits over those of 10, over 100.
double growth_of_steps(const std::vector<RunCost>& runs, double e) {
  const auto steps = [&](int orbits) {
    return static_cast<double>(std::ranges::find_if(runs, [&](const RunCost& c) {
                                 return c.eccentricity == e && c.orbits == orbits;
                               })->steps);
  };
  return steps(1000) / steps(10) / 100;
}

void put(const Outcome& m, scene::Show& show) {
  tabulate(m.steps, show);
  draw(m, show);
  const double rounding = std::numeric_limits<double>::epsilon() * steps_an_orbit *
                          orbit::kepler_condition(on_ellipse(eccentricity), revolution, 1).position;
  show.at_most("distance from raw derivatives after an orbit",
               std::ranges::max(m.steps, {}, &StepCost::distance).distance, rounding,
               "the same series, an eps in each of 25 steps times the condition of the orbit");
  for (const double e : {0.1, 0.7})
    show.near(fmt::format("growth of the steps from 10 to 1000 orbits over 100, e = {:g}", e),
              growth_of_steps(m.runs, e), 1, 0.06,
              "every orbit is alike, but for the order, which settles within the first of them");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result outcome("cost",
                              "e = 0.1, 25 steps an orbit, order from 6 to 40; runs of the adaptive method "
                              "in its default setting and Kepler's solution of the same end; one thread, "
                              "median of repeats",
                              [](bool quick) {
                                return Outcome{step_costs(quick), run_costs(quick)};
                              });
  return {{.name = "cost",
           .title = "What a step costs by its order, and a run by its orbits",
           .content = scene::Content(put, outcome)}};
}

}  // namespace nlmech::chapters::two_body_series::cost

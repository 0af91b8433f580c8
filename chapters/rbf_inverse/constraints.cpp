#include <fmt/format.h>

#include <cmath>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"
#include "nlmech/bvp/continuation.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DuffingCase;
using scene::Workshop;

constexpr int samples = 400;
constexpr double end_time = 2;

/// The largest |f| of an extremal without bound, by its samples.
double peak_of(const bvp::Solution& s) {
  double peak = 0;
  for (int i = 0; i <= samples; ++i) peak = std::max(peak, std::abs(s.at(end_time * i / samples)[3]));
  return peak;
}

/// An extremal under a bound on the force.
struct Bounded {
  double limit;
  bvp::Extremal extremal;
  std::vector<double> control;  ///< at the samples; empty if there is no extremal
};

std::vector<Bounded> bounded(const DuffingRuns& runs, Workshop& w) {
  const bvp::ExtremalProblem problem = duffing_problem(printed_settings(DuffingCase::fixed, end_time));
  const bvp::Solution& free = best_of(runs, w, DuffingCase::fixed).solution;
  std::vector<Bounded> all;
  for (const double limit : {15.0, 13.5, 8.0}) {
    const bvp::ConstraintPath path = bvp::control_bound_path(peak_of(free), limit);
    Bounded b{limit, tighten(problem, start_from(free), path), {}};
    if (b.extremal.solution.status.ok()) {
      const bvp::ExtremalProblem clipped = with_constraints(problem, path(1));
      for (int i = 0; i <= samples; ++i)
        b.control.push_back(control_at(clipped, b.extremal.solution, end_time * i / samples)[0]);
    }
    all.push_back(std::move(b));
  }
  return all;
}

scene::Showing show_bounded(const DuffingRuns& runs, const std::vector<Bounded>& all, Workshop& w) {
  const bvp::Extremal& free = best_of(runs, w, DuffingCase::fixed);
  scene::Table table({{"bound of |f|"},
                      {"status"},
                      {"cost", 10},
                      {"lambda1(0)", 8},
                      {"lambda2(0)", 8},
                      {"miss of the flown end", 2},
                      {"what is said"}});
  const Eigen::VectorXd first = free.solution.first();
  table.add({{}, "success", free.cost, first[2], first[3], free.miss, ""});
  ControlCurves figure("A bounded force pumps longer at its limit");
  figure.panel("time (s)", "force {/:Italic f} (1/s^{2})");
  figure.begin("no bound", "l8");
  for (int i = 0; i <= samples; ++i)
    figure.add(end_time * i / samples, -free.solution.at(end_time * i / samples)[3]);
  int style = 1;
  for (const Bounded& b : all) {
    const bvp::Solution& s = b.extremal.solution;
    const bool found = s.status.ok();
    const auto cell = [&](double value) { return found ? scene::Cell(value) : scene::Cell(); };
    table.add({b.limit, std::string(to_string(s.status.outcome())), cell(b.extremal.cost),
               cell(found ? s.first()[2] : 0), cell(found ? s.first()[3] : 0), cell(b.extremal.miss),
               found ? std::string() : std::string(s.status.sentence())});
    if (!found) continue;
    figure.begin(fmt::format("at most {:g}", b.limit), fmt::format("l{}", style++));
    for (int i = 0; i <= samples; ++i)
      figure.add(end_time * i / samples, b.control[static_cast<std::size_t>(i)]);
  }
  figure.with("key", "top left").with("yrange", "[-20:28]");
  double over = 0;
  for (const double f : all[0].control) over = std::max(over, std::abs(f));
  const Eigen::VectorXd z = all[0].extremal.solution.first();
  return {
      figure.take(),
      std::move(table),
      {scene::near("peak of the unbounded force", "1/s^2", peak_of(free.solution), 16.409, 1e-3, "recorded"),
       scene::near("cost at 15", "1", all[0].extremal.cost, 122.3004593, 1e-6,
                   "recorded, its smoothing 1e-4 as well; steps of 0.01"),
       scene::near("lambda1(0) at 15", "1", z[2], -21.30021353, 1e-5, "the same"),
       scene::near("lambda2(0) at 15", "1", z[3], 0.9462278952, 1e-5, "the same"),
       scene::at_most("largest force at 15", "1/s^2", over, 15, "the clip itself"),
       scene::near("is a bound of 8 refused?", "1",
                   all[2].extremal.solution.status.outcome() == Outcome::infeasible ? 1 : 0, 1, 0,
                   "less energy than the target's comes in: see the text")}};
}

/// An extremal through x1(T/2) = x_m.
struct Through {
  double value;
  bvp::Multistart found;
};

std::vector<Through> through(bool quick) {
  const bvp::DuffingStarts fewer = {
      .constants = false, .unforced = 6, .pumps = 1, .direct = 3, .random = 0, .driven = 0};
  std::vector<Through> all;
  for (const double value : {0.0, 1.0, -1.0}) {
    bvp::DuffingSettings settings = printed_settings(DuffingCase::fixed, end_time);
    settings.waypoints = {{end_time / 2, 0, value}};
    all.push_back({value, duffing_extremals(settings, quick ? fewer : bvp::DuffingStarts{})});
    if (all.back().found.found.empty())
      throw Failure(fmt::format("no extremal through x1({:g}) = {:g} was found", end_time / 2, value));
  }
  return all;
}

scene::Showing show_through(const DuffingRuns& runs, const std::vector<Through>& all, Workshop& w) {
  scene::Table table({{"x1(1) ="},
                      {"cost", 10},
                      {"kind"},
                      {"starts that led to it"},
                      {"lambda1(1-)", 8},
                      {"lambda1(1+)", 8},
                      {"jump of lambda2", 2}});
  ControlCurves figure("A prescribed position makes the force's slope jump");
  figure.panel("time (s)", "force {/:Italic f} (1/s^{2})");
  const bvp::Solution& free = best_of(runs, w, DuffingCase::fixed).solution;
  figure.begin("no point between", "l8");
  for (int i = 0; i <= samples; ++i) figure.add(end_time * i / samples, -free.at(end_time * i / samples)[3]);
  double worst_jump = 0;
  int style = 1;
  for (const Through& t : all) {
    for (const bvp::Found& f : t.found.found) {
      const bvp::Solution& s = f.extremal.solution;
      const Eigen::VectorXd before = s.at(end_time / 2, bvp::Side::before),
                            after = s.at(end_time / 2, bvp::Side::after);
      table.add({t.value, f.extremal.cost, std::string(to_string(f.extremal.second_order.kind)),
                 std::int64_t{f.hits}, before[2], after[2], std::abs(after[3] - before[3])});
      worst_jump = std::max(worst_jump, std::abs(after[3] - before[3]));
    }
    figure.begin(fmt::format("{{/:Italic x}}_{{1}}(1) = {:g}", t.value), fmt::format("l{}", style++));
    for (int i = 0; i <= samples; ++i)
      figure.add(end_time * i / samples,
                 -t.found.found.front().extremal.solution.at(end_time * i / samples)[3]);
  }
  figure.with("key", "top left");
  const auto cost = [&](std::size_t i) { return all[i].found.found.front().extremal.cost; };
  const char* const reason = "recorded; the lower one of the two counts";
  return {figure.take(),
          std::move(table),
          {scene::at_most("cost through 0", "1", cost(0), 284.305667 * (1 + 1e-7), reason),
           scene::at_most("cost through 1", "1", cost(1), 362.325047 * (1 + 1e-7), reason),
           scene::at_most("cost through -1", "1", cost(2), 228.250180 * (1 + 1e-7), reason),
           scene::at_most("largest jump of lambda2", "1", worst_jump, 1e-9,
                          "x2 is not prescribed there: its co-state is continuous")}};
}

}  // namespace

void add_bounded_control(scene::Chapter& chapter, const DuffingRuns& runs) {
  const auto& run = chapter.add_run<std::vector<Bounded>>(
      "bounded-force",
      "fixed case, T = 2; the limit is brought down to its value with a wide smoothing, then that to 1e-4",
      {&run_of(runs.extremals, DuffingCase::fixed)}, [runs](Workshop& w) { return bounded(runs, w); });
  chapter.add({.name = "bounded-control",
               .title = "The fixed case under a bound on the force, by continuation",
               .place = "our own",
               .needs = {&run, &run_of(runs.extremals, DuffingCase::fixed)},
               .show = [&run, runs](Workshop& w) { return show_bounded(runs, w.result(run), w); }});
}

void add_interior_point(scene::Chapter& chapter, const DuffingRuns& runs) {
  const auto& run = chapter.add_run<std::vector<Through>>(
      "through-a-point", "fixed case, T = 2, x1 prescribed at t = 1 too; the program's own starts", {},
      [](Workshop& w) { return through(w.quick()); });
  chapter.add({.name = "interior-point",
               .title = "A position prescribed at half the time: the co-state jumps",
               .place = "our own",
               .needs = {&run, &run_of(runs.extremals, DuffingCase::fixed)},
               .show = [&run, runs](Workshop& w) { return show_through(runs, w.result(run), w); }});
}

}  // namespace nlmech::chapters

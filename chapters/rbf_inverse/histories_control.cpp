#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// Recorded with the printed shape at T = 2; "two" are its nine tenths of a decade.
struct KnownErrors {
  double states, costates;
};
KnownErrors known_errors(bvp::DuffingCase which) {
  switch (which) {
    case bvp::DuffingCase::free: return {2.6e-5, 3.2e-5};
    case bvp::DuffingCase::fixed: return {2.9e-4, 8.2e-3};
    case bvp::DuffingCase::x1x1: return {5.5e-3, 7.0e-3};
    case bvp::DuffingCase::x1x2: return {3.4e-5, 2.4e-6};
    case bvp::DuffingCase::x2x1: return {6.5e-4, 5.8e-3};
    default: return {5.2e-3, 1.4e-3};
  }
}

std::string state_heading(bvp::DuffingCase which) {
  switch (which) {
    case bvp::DuffingCase::free: return "Free end: little force, and a stop short of the target";
    case bvp::DuffingCase::fixed: return "Final state given: the force has to pump";
    case bvp::DuffingCase::x1x1: return "Free initial velocity: nearly no force is needed";
    case bvp::DuffingCase::x1x2: return "Initial position, final velocity: hardly any force";
    case bvp::DuffingCase::x2x1: return "Initial velocity, final position: a light touch";
    default: return "Onto a harmonic motion: the force pumps and brakes";
  }
}

std::vector<scene::Quantity> extremal_promises(const bvp::Extremal& e, const KnownExtremal& known) {
  const char* const reason = "tools/oracles/rbf_inverse_extremals.py";
  std::vector<scene::Quantity> all = {scene::at_most("cost", "1", e.cost, known.cost * (1 + 1e-9), reason),
                                      scene::at_most("distance of the flown end from prescribed values", "1",
                                                     e.miss, 1e-9, "the tolerance of the collocation")};
  double worst = 0;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double value = known.first[static_cast<std::size_t>(i)];
    worst = std::max(worst, std::abs(e.solution.first()[i] - value) / std::max(1.0, std::abs(value)));
  }
  all.push_back(scene::at_most("error of the initial states and co-states", "1", worst, 1e-10, reason));
  return all;
}

scene::Table extremal_table(const DuffingRuns& runs, const DuffingSubject& subject, Workshop& w) {
  scene::Table table({{"T"},
                      {"cost", 10},
                      {"extremals found"},
                      {"x1(0)", 6},
                      {"x2(0)", 6},
                      {"lambda1(0)", 8},
                      {"lambda2(0)", 8},
                      {"x1(T)", 6},
                      {"x2(T)", 6},
                      {"miss of the flown end"}});
  for (std::size_t i = 0; i < final_times.size(); ++i) {
    const Extremals& all = w.result(*runs.extremals[i]);
    const bvp::Extremal& e = best_of(all, subject.which);
    const Eigen::VectorXd first = e.solution.first(), last = e.solution.last();
    const auto shown = [](double value) { return std::abs(value) < 1e-12 ? 0.0 : value; };
    table.add({final_times[i], e.cost,
               static_cast<std::int64_t>(all[static_cast<std::size_t>(subject.which)].found.size()),
               shown(first[0]), shown(first[1]), shown(first[2]), shown(first[3]), last[0], last[1], e.miss});
  }
  return table;
}

scene::Showing show_states(const DuffingRuns& runs, const DuffingSubject& subject, Workshop& w) {
  const bvp::Extremal& e = best_of(w.result(*runs.extremals[inferred]), subject.which);
  ControlCurves figure(state_heading(subject.which));
  figure.panel("time (s)", "states, force");
  const std::array<std::pair<const char*, const char*>, 3> curves = {
      {{"{/:Italic x}_{1}", "l1"}, {"{/:Italic x}_{2} (1/s)", "l2"}, {"{/:Italic f} (1/s^{2})", "l3"}}};
  for (int k = 0; k < 3; ++k) {
    figure.begin(curves[static_cast<std::size_t>(k)].first, curves[static_cast<std::size_t>(k)].second);
    constexpr int samples = 200;
    for (int i = 0; i <= samples; ++i) {
      const double t = final_times[inferred] * i / samples;
      const Eigen::VectorXd z = e.solution.at(t);
      figure.add(t, k < 2 ? z[k] : -z[3]);
    }
  }
  figure.with("key", "at screen 0.54, screen 0.01 center bottom maxrows 1").overall("bottom", "0.24");
  return {figure.take(), extremal_table(runs, subject, w),
          extremal_promises(e, known_extremal(subject.which))};
}

scene::Table error_table(const DuffingRuns& runs, std::size_t subject, Workshop& w) {
  scene::Table table({{"T"},
                      {"derivative matrix"},
                      {"status"},
                      {"Newton iterations"},
                      {"largest state error", 2},
                      {"largest co-state error", 2},
                      {"error of the cost, relative", 2}});
  for (std::size_t i = 0; i < final_times.size(); ++i) {
    const double cost = best_of(w.result(*runs.extremals[i]), duffing_subjects()[subject].which).cost;
    const auto& results = w.result(*runs.globals[i])[subject];
    for (std::size_t v = 0; v < results.size(); ++v) {
      const bvp::GlobalResult& r = results[v];
      const NodeErrors errors = node_errors(r);
      const auto cell = [](double x) { return std::isfinite(x) ? scene::Cell(x) : scene::Cell(); };
      table.add({final_times[i], global_variants()[v].name,
                 std::string(to_string(r.extremal.solution.status.outcome())),
                 r.report.statistics.newton_iterations, cell(errors.states), cell(errors.costates),
                 cell(std::abs(r.extremal.cost / cost - 1))});
    }
  }
  return table;
}

/// |error| of one component, or the greater of two, at the nodes.
void draw_errors(ControlCurves& figure, const bvp::GlobalResult& r, int from, int to) {
  const auto& intervals = r.extremal.solution.unknowns.intervals;
  if (intervals.empty() || r.flown.cols() != intervals.front().values.cols()) return;
  const Eigen::MatrixXd error = (intervals.front().values - r.flown).cwiseAbs();
  const std::vector<double> times = r.extremal.solution.node_times();
  for (std::size_t j = 0; j < times.size(); ++j) {
    double worst = 0;
    for (int k = from; k <= to; ++k) worst = std::max(worst, error(k, static_cast<Eigen::Index>(j)));
    if (worst > 0) figure.add(times[j], worst);  // the first node is where the flight begins
  }
}

scene::Showing show_errors(const DuffingRuns& runs, std::size_t index, bool costates, Workshop& w) {
  const DuffingSubject& subject = duffing_subjects()[index];
  const auto& results = w.result(*runs.globals[inferred])[index];
  const NodeErrors printed = node_errors(results[0]);
  const double worst = costates ? printed.costates : printed.states;
  ControlCurves figure(fmt::format("{} errors reach {}, where the text has 1e-7",
                                   costates ? "Co-state" : "State", scene::format_number(worst, 1)));
  figure.panel("time (s)",
               costates ? "|{/:Italic λ} - {/:Italic λ}_{flown}|" : "|{/:Italic x} - {/:Italic x}_{flown}|");
  const int first = costates ? 2 : 0;
  const char* const letter = costates ? "λ" : "x";
  for (int k = 0; k < 2; ++k) {
    figure.begin(fmt::format("{{/:Italic {}}}_{{{}}}, Gaussians as printed", letter, k + 1),
                 k == 0 ? "b1" : "b2");
    draw_errors(figure, results[0], first + k, first + k);
  }
  figure.begin("greater of both, {/:Italic c T} = 7.5", "b4");
  draw_errors(figure, results[1], first, first + 1);
  figure.begin("greater of both, polynomial", "b3");
  draw_errors(figure, results[3], first, first + 1);
  figure.begin("1e-7", "l5");
  figure.add(0, 1e-7);
  figure.add(final_times[inferred], 1e-7);
  figure.with("logy", "1").with("yrange", "[1e-17:1]");
  figure.with("key", "at screen 0.54, screen 0.01 center bottom maxrows 3 samplen 3")
      .overall("bottom", "0.33");
  const KnownErrors known = known_errors(subject.which);
  const double reference = costates ? known.costates : known.states;
  std::vector<scene::Quantity> quantities = {
      {costates ? "largest co-state error, printed shape" : "largest state error, printed shape", "1", worst,
       reference / 15, reference * 15, "recorded; rounding in a matrix of condition 4e17 is a lottery"}};
  quantities.push_back(
      scene::at_most("error of the cost, printed shape, relative", "1",
                     std::abs(results[0].extremal.cost / known_extremal(subject.which).cost - 1), 1e-4,
                     "recorded: 2e-10 to 3e-7 for most roots"));
  return {figure.take(), error_table(runs, index, w), quantities};
}

}  // namespace

void add_duffing_histories(scene::Chapter& chapter, const DuffingRuns& runs) {
  std::vector<const scene::AnyRun*> extremals(runs.extremals.begin(), runs.extremals.end()), all = extremals;
  all.insert(all.end(), runs.globals.begin(), runs.globals.end());
  for (std::size_t i = 0; i < duffing_subjects().size(); ++i) {
    const DuffingSubject& subject = duffing_subjects()[i];
    chapter.add({.name = fmt::format("fig-5.{}", subject.figure),
                 .title = "States and control, " + subject.title,
                 .place = fmt::format("Figure 5.{}", subject.figure),
                 .needs = extremals,
                 .seconds = 0.1,
                 .show = [runs, i](Workshop& w) { return show_states(runs, duffing_subjects()[i], w); }});
    for (const bool costates : {false, true}) {
      const int number = subject.figure + (costates ? 2 : 1);
      chapter.add(
          {.name = fmt::format("fig-5.{}", number),
           .title = fmt::format("{} errors at the nodes, {}", costates ? "Co-state" : "State", subject.title),
           .place = fmt::format("Figure 5.{}", number),
           .needs = all,
           .seconds = 0.1,
           .show = [runs, i, costates](Workshop& w) { return show_errors(runs, i, costates, w); }});
    }
  }
}

}  // namespace nlmech::chapters

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// Recorded: of 100 other guesses at T = 2, the share that Newton's iteration leads to an extremal.
double known_share(bvp::DuffingCase which) {
  switch (which) {
    case bvp::DuffingCase::free: return 0.69;
    case bvp::DuffingCase::fixed: return 0.48;
    case bvp::DuffingCase::x1x1: return 0.21;
    case bvp::DuffingCase::x1x2: return 0.62;
    case bvp::DuffingCase::x2x1: return 0.05;
    default: return 0.44;
  }
}

std::vector<scene::Quantity> extremal_promises(const bvp::Extremal& e, const KnownExtremal& known) {
  const char* const reason = "tools/oracles/rbf_inverse_extremals.py";
  std::vector<scene::Quantity> all = {
      scene::at_most("cost of the cheapest", "1", e.cost, known.cost * (1 + 1e-9), reason),
      scene::at_most("distance of its flown end from prescribed values", "1", e.miss, 1e-9,
                     "the tolerance of the collocation")};
  double worst = 0;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double value = known.first[static_cast<std::size_t>(i)];
    worst = std::max(worst, std::abs(e.solution.first()[i] - value) / std::max(1.0, std::abs(value)));
  }
  all.push_back(scene::at_most("error of its initial states and co-states", "1", worst, 1e-10, reason));
  return all;
}

/// What each guess leads to.
scene::Table guess_table(const FromGuesses& all) {
  scene::Table table({{"guess"},
                      {"status"},
                      {"Newton's iterations"},
                      {"cost", 6},
                      {"kind"},
                      {"largest state error", 2},
                      {"largest co-state error", 2}});
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bvp::Extremal& e = all[k].extremal;
    const bool good = e.solution.status.ok();
    const NodeErrors errors = node_errors(all[k]);
    const auto cell = [&](double value) { return good ? scene::Cell(value) : scene::Cell(); };
    table.add({guess_name(k), std::string(to_string(e.solution.status.outcome())),
               all[k].report.statistics.newton_iterations, cell(e.cost),
               good ? scene::Cell(std::string(to_string(e.second_order.kind))) : scene::Cell(),
               cell(errors.states), cell(errors.costates)});
  }
  return table;
}

/// x1, x2 or f.
double component(const Eigen::VectorXd& z, int k) { return k < 2 ? z[k] : -z[3]; }

/// A panel of x1, x2 or f, and how far its curves reach.
struct Panel {
  ControlCurves& figure;
  int k;
  double low = HUGE_VAL, high = -HUGE_VAL;

  void add(double time, const Eigen::VectorXd& z) {
    const double value = component(z, k);
    figure.add(time, value);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// An extremal of the printed method at its nodes.
  void add_nodes(const bvp::Extremal& e) {
    const std::vector<double> times = e.solution.node_times();
    const Eigen::MatrixXd& values = e.solution.unknowns.intervals.front().values;
    for (std::size_t j = 0; j < times.size(); ++j) add(times[j], values.col(static_cast<Eigen::Index>(j)));
  }
};

bool same_cost(const bvp::Extremal& a, const bvp::Extremal& b) {
  return std::abs(a.cost - b.cost) <= 1e-2 * b.cost;
}

/// Extremals that other guesses lead to.
void draw_others(Panel& panel, const FromGuesses& all, const bvp::Extremal& drawn,
                 const bvp::Extremal& best) {
  bool first = true;
  for (const bvp::Extremal* e : distinct_of(all)) {
    // What costs orders of magnitude more would be steep lines through the picture; the cheapest is there.
    if (same_cost(*e, drawn) || same_cost(*e, best) || e->cost > 10 * drawn.cost) continue;
    panel.figure.begin(first ? "from other guesses" : "", "l8");
    panel.add_nodes(*e);
    first = false;
  }
}

/// A panel for x1, x2 or f: what is found from the guesses, and over it the cheapest known.
void draw_component(ControlCurves& figure, const FromGuesses& all, const bvp::Extremal& best, int k) {
  constexpr std::array<const char*, 3> labels = {"{/:Italic x}_{1}", "{/:Italic x}_{2} (1/s)",
                                                 "{/:Italic f} (1/s^{2})"};
  figure.panel("time (s)", "", labels[static_cast<std::size_t>(k)]);
  const std::size_t chosen = drawn_of(all);
  const bvp::Extremal& drawn = all[chosen].extremal;
  Panel panel{figure, k};
  draw_others(panel, all, drawn, best);
  figure.begin("as printed, from " + guess_name(chosen), "b1");
  panel.add_nodes(drawn);
  const bool by_others = !same_cost(drawn, best) && count_of(all, best.cost).cheapest > 0;
  figure.begin(by_others ? "cheapest known, found from other guesses" : "cheapest known", "l2");
  for (int i = 0; i <= 200; ++i) {
    const double t = final_times[inferred] * i / 200;
    panel.add(t, best.solution.at(t));
  }
  const double margin = 0.1 * (panel.high - panel.low);
  figure.with("yrange", fmt::format("[{:g}:{:g}]", panel.low - margin, panel.high + margin));
  figure.with("key",
              k == 2 ? "at screen 0.5, screen 0.01 center bottom maxrows 1 samplen 3 width -4" : "off");
}

/// What the guesses led to, in numbers.
std::vector<scene::Quantity> guess_promises(const DuffingSubject& subject, const FromGuesses& all,
                                            const bvp::Extremal& best) {
  const GuessCounts counts = count_of(all, best.cost);
  const auto n = static_cast<double>(all.size()), good = double(counts.good);
  const double share = known_share(subject.which), slack = 3 * std::sqrt(n * share * (1 - share)) + 1;
  const std::vector<const bvp::Extremal*> found = distinct_of(all);
  const double cost = all[drawn_of(all)].extremal.cost;
  const char* const least =
      "none costs less than the cheapest that any method found, to the root's own error";
  return {{"guesses of eleven that find an extremal", "1", good, std::max(1.0, n * share - slack),
           std::min(n, n * share + slack), "recorded of 100 other guesses; three deviations"},
          {"guesses that find the cheapest", "1", double(counts.cheapest), 0, good, "some of those"},
          {"guesses that find a root that is no solution", "1", double(counts.spurious), 0, n - good,
           "some of the others"},
          {"different extremals found", "1", double(found.size()), 1, good, "one at least"},
          {"cost of what is drawn", "1", cost, 0.99 * best.cost, HUGE_VAL, least},
          {"cost of what is drawn over the cheapest", "1", cost / best.cost, 0.99, HUGE_VAL, least},
          {"highest cost found", "1", found.back()->cost, 0.99 * best.cost, HUGE_VAL, least}};
}

scene::Showing show_states(const DuffingRuns& runs, const DuffingSubject& subject, Workshop& w) {
  const bvp::Extremal& best = best_of(runs, w, subject.which);
  const FromGuesses& all = w.result(run_of(runs.printed, subject.which));
  const std::size_t chosen = drawn_of(all);
  const double ratio = all[chosen].extremal.cost / best.cost;
  ControlCurves figure(
      same_cost(all[chosen].extremal, best)
          ? fmt::format("From {} the printed method finds the cheapest extremal", guess_name(chosen))
          : fmt::format("From {} the printed method pays {:.2g} times the least", guess_name(chosen), ratio));
  for (int k = 0; k < 3; ++k) draw_component(figure, all, best, k);
  figure.overall("bottom", "0.27").overall("width", "1000").overall("height", "440");
  std::vector<scene::Quantity> quantities = guess_promises(subject, all, best);
  for (scene::Quantity& q : extremal_promises(best, known_extremal(subject.which)))
    quantities.push_back(std::move(q));
  return {figure.take(), guess_table(all), quantities};
}

scene::Table variant_table(const FromGuesses& results) {
  scene::Table table({{"derivative matrix"},
                      {"status"},
                      {"Newton's iterations"},
                      {"cost", 10},
                      {"largest state error", 2},
                      {"largest co-state error", 2}});
  for (std::size_t v = 0; v < results.size(); ++v) {
    const bvp::GlobalResult& r = results[v];
    const NodeErrors errors = node_errors(r);
    const auto cell = [](double x) { return std::isfinite(x) ? scene::Cell(x) : scene::Cell(); };
    table.add({global_variants()[v].name, std::string(to_string(r.extremal.solution.status.outcome())),
               r.report.statistics.newton_iterations, cell(r.extremal.cost), cell(errors.states),
               cell(errors.costates)});
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
  const FromGuesses& results = w.result(*runs.variants[static_cast<std::size_t>(subject.which)]);
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
  for (const auto& [name, look, variant] : {std::tuple("greater of both, {/:Italic c T} = 7.5", "b4", 1U),
                                            {"greater of both, polynomial", "b3", 3U}}) {
    if (!results[variant].extremal.solution.status.ok()) continue;
    figure.begin(name, look);
    draw_errors(figure, results[variant], first, first + 1);
  }
  figure.begin("1e-7", "l5");
  figure.add(0, 1e-7);
  figure.add(final_times[inferred], 1e-7);
  figure.with("logy", "1").with("yrange", "[1e-17:1]");
  figure.with("key", "at screen 0.54, screen 0.01 center bottom maxrows 3 samplen 3")
      .overall("bottom", "0.33");
  return {
      figure.take(),
      variant_table(results),
      {{costates ? "largest co-state error, printed shape" : "largest state error, printed shape", "1", worst,
        1e-7, 1,
        "recorded: 2e-6 to 0.7 by root, T = 0.5 to 6; rounding in a matrix of condition 4e17 is a lottery"}}};
}

}  // namespace

void add_duffing_histories(scene::Chapter& chapter, const DuffingRuns& runs) {
  for (std::size_t i = 0; i < duffing_subjects().size(); ++i) {
    const DuffingSubject& subject = duffing_subjects()[i];
    chapter.add({.name = fmt::format("fig-5.{}", subject.figure),
                 .title = "States and control, " + subject.title,
                 .place = fmt::format("Figure 5.{}", subject.figure),
                 .needs = {&run_of(runs.extremals, subject.which), &run_of(runs.printed, subject.which)},
                 .show = [runs, i](Workshop& w) { return show_states(runs, duffing_subjects()[i], w); }});
    for (const bool costates : {false, true}) {
      const int number = subject.figure + (costates ? 2 : 1);
      chapter.add(
          {.name = fmt::format("fig-5.{}", number),
           .title = fmt::format("{} errors at the nodes, {}", costates ? "Co-state" : "State", subject.title),
           .place = fmt::format("Figure 5.{}", number),
           .needs = {runs.variants[static_cast<std::size_t>(subject.which)]},
           .show = [runs, i, costates](Workshop& w) { return show_errors(runs, i, costates, w); }});
    }
  }
}

}  // namespace nlmech::chapters

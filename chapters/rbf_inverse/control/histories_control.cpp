#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"

namespace nlmech::chapters::rbf_inverse::histories_control {
namespace {

using bvp::DuffingCase;

bool same_cost(const bvp::Extremal& a, const bvp::Extremal& b) {
  return std::abs(a.cost - b.cost) <= 1e-2 * b.cost;
}

/// Panel of x1, x2 or f with the range of its curves.
struct Component {
  scene::Panel& panel;
  Eigen::Index k;
  double low = HUGE_VAL, high = -HUGE_VAL;

  void curve(const std::string& name, const std::vector<double>& t, const Eigen::MatrixXd& z,
             const scene::CurveStyle& look) {
    const Eigen::VectorXd values = k < 2 ? Eigen::VectorXd(z.row(k)) : Eigen::VectorXd(-z.row(3));
    low = std::min(low, values.minCoeff());
    high = std::max(high, values.maxCoeff());
    panel.curve(name, t, {values.begin(), values.end()}, look);
  }
  void curve(const std::string& name, const bvp::Extremal& at_nodes, const scene::CurveStyle& look) {
    curve(name, at_nodes.solution.node_times(), at_nodes.solution.node_values(), look);
  }
};

/// Draws the extremals from the guesses, and the known one of least cost on top.
void draw(Component component, const FromGuesses& all, const bvp::Extremal& best) {
  const bvp::Extremal& drawn = all.drawn().extremal;
  std::string others = "from other guesses";
  for (const bvp::Extremal* e : all.distinct()) {
    // Extremals of a cost higher by orders of magnitude are omitted: they would appear as steep lines.
    if (same_cost(*e, drawn) || same_cost(*e, best) || e->cost > 10 * drawn.cost) continue;
    component.curve(std::exchange(others, ""), *e, scene::lines(8));
  }
  component.curve("as printed, from " + guess_name(all.chosen()), drawn, scene::linespoints(1));
  std::vector<double> t;
  Eigen::MatrixXd z(4, 201);
  for (int i = 0; i <= 200; ++i) {
    t.push_back(inferred * i / 200);
    z.col(i) = best.solution.at(t.back());
  }
  const bool by_others = !same_cost(drawn, best) && all.counts().cheapest > 0;
  component.curve(by_others ? "cheapest known, found from other guesses" : "cheapest known", t, z,
                  scene::lines(2));
  const double margin = 0.1 * (component.high - component.low);
  component.panel.y_range(component.low - margin, component.high + margin).set("bmargin at screen 0.27");
  component.panel.key(
      component.k == 2 ? "at screen 0.5, screen 0.01 center bottom maxrows 1 samplen 3 width -4" : "off");
}

/// Table of results, one row per solve.
/// @param name function from the index to the name
/// @param kinds whether to show the kind of each extremal
template <class Name>
void tabulate(const std::vector<bvp::GlobalResult>& results, const char* heading, Name name, bool kinds,
              scene::Show& show) {
  struct Row {
    std::string name;
    const bvp::GlobalResult* r;
    NodeErrors errors;

    [[nodiscard]] const bvp::Extremal& extremal() const { return r->extremal; }
    [[nodiscard]] scene::Cell if_good(const scene::Cell& cell) const {
      return is_extremal(*r) ? cell : scene::Cell();
    }
  };
  std::vector<Row> rows;
  for (const bvp::GlobalResult& r : results) rows.push_back({name(rows.size()), &r, node_errors(r)});
  scene::ColumnsOf<std::vector<Row>> columns = {
      {heading, &Row::name},
      {"status", [](const Row& r) { return to_string(r.extremal().solution.status.outcome()); }},
      {"Newton's iterations", [](const Row& r) { return r.r->report.statistics.newton_iterations; }},
      {"cost", [](const Row& r) { return r.if_good(r.extremal().cost); }, kinds ? 6 : 10},
      {"kind", [](const Row& r) { return r.if_good(to_string(r.extremal().second_order.kind)); }},
      {"largest state error", [](const Row& r) { return r.if_good(r.errors.states); }, 2},
      {"largest co-state error", [](const Row& r) { return r.if_good(r.errors.costates); }, 2}};
  if (!kinds) columns.erase(columns.begin() + 4);
  show.table(rows, columns);
}

/// Checks the fractions of guesses by outcome.
void check_guesses(const FromGuesses& all, const bvp::Extremal& best, scene::Show& show) {
  // Recorded: fraction of 100 other guesses at T = 2 from which Newton's iteration finds an extremal.
  static const std::map<DuffingCase, double> shares = {
      {DuffingCase::free, 0.69}, {DuffingCase::fixed, 0.48}, {DuffingCase::x1x1, 0.21},
      {DuffingCase::x1x2, 0.62}, {DuffingCase::x2x1, 0.05},  {DuffingCase::harmonic, 0.44}};
  const GuessCounts counts = all.counts();
  const double share = shares.at(all.subject->which), n = static_cast<double>(all.results.size()),
               good = static_cast<double>(counts.good), slack = 3 * std::sqrt(n * share * (1 - share)) + 1,
               cost = all.drawn().extremal.cost;
  const auto found = all.distinct();
  const char* const least =
      "none costs less than the cheapest that any method found, to the root's own error";
  show.between("guesses of eleven that find an extremal", good, std::max(1.0, n * share - slack),
               std::min(n, n * share + slack), "regression value of 100 other guesses; three deviations");
  show.between("guesses that find the cheapest", counts.cheapest, 0, good, "some of those");
  show.between("guesses that find a root that is no solution", counts.spurious, 0, n - good,
               "some of the others");
  show.between("different extremals found", found.size(), 1, good, "one at least");
  show.between("cost of what is drawn", cost, 0.99 * best.cost, HUGE_VAL, least);
  show.between("cost of what is drawn over the cheapest", cost / best.cost, 0.99, HUGE_VAL, least);
  show.between("highest cost found", found.back()->cost, 0.99 * best.cost, HUGE_VAL, least);
}

void put_states(const bvp::Multistart& found, const FromGuesses& all, scene::Show& show) {
  const bvp::Extremal &best = cheapest_of(found), &drawn = all.drawn().extremal;
  const KnownExtremal& known = known_extremal(all.subject->which);
  const std::string from = guess_name(all.chosen());
  scene::Plot& plot = show.plots(
      same_cost(drawn, best)
          ? fmt::format("States and control from {}: the printed method finds the cheapest extremal", from)
          : fmt::format("States and control from {}: {:.2g} times the least cost", from,
                        drawn.cost / best.cost));
  plot.size(1000, 440).columns({"panel", "curve", "x", "y"});
  const char* const names[] = {"{/:Italic x}_{1}", "{/:Italic x}_{2} (1/s)", "{/:Italic f} (1/s^{2})"};
  for (int k = 0; k < 3; ++k)
    draw({.panel = plot.panel("time (s)", "").caption(names[k]), .k = k}, all, best);
  tabulate(all.results, "guess", guess_name, true, show);
  check_guesses(all, best, show);
  const char* const oracle = "tools/oracles/rbf_inverse_extremals.py";
  show.at_most("cost of the cheapest", best.cost, known.cost * (1 + 1e-9), oracle);
  show.at_most("distance of its integrated end from prescribed values", best.miss, 1e-9,
               "the tolerance of the collocation");
  show.at_most("error of its initial states and co-states", known.error_of(best), 1e-10, oracle);
}

/// Draws the largest |error| of some components at the nodes.
void draw_error(scene::Panel& panel, const std::string& name, const bvp::GlobalResult& r, Eigen::Index first,
                Eigen::Index count, int style, const char* look = "linespoints linewidth 1.2") {
  if (!is_extremal(r)) return;
  const Eigen::MatrixXd error =
      (r.extremal.solution.node_values() - r.integrated).cwiseAbs().middleRows(first, count);
  const std::vector<double> times = r.extremal.solution.node_times();
  std::vector<double> t, worst;
  for (std::size_t j = 0; j < times.size(); ++j) {
    const double e = error.col(static_cast<Eigen::Index>(j)).maxCoeff();
    if (!(e > 0)) continue;  // the integration starts at the first node
    t.push_back(times[j]);
    worst.push_back(e);
  }
  panel.curve(name, t, worst, {look, style});
}

/// @param states_accuracy whether the text states 1e-7 for this case
void put_errors(const std::vector<bvp::GlobalResult>& results, bool costates, bool states_accuracy,
                scene::Show& show) {
  const NodeErrors printed = node_errors(results[0]);
  const double worst = costates ? printed.costates : printed.states;
  const std::string letter = costates ? "λ" : "x";
  scene::Panel& panel =
      show.plot(fmt::format("{} errors: up to {}{}", costates ? "Co-state" : "State",
                            scene::format_number(worst, 1), states_accuracy ? "; the text states 1e-7" : ""),
                "time (s)", fmt::format("|{{/:Italic {0}}} - {{/:Italic {0}}}_{{integrated}}|", letter));
  show.figure().size(760, 480).columns({"panel", "curve", "x", "y"});
  const int first = costates ? 2 : 0;
  for (int k = 0; k < 2; ++k)
    draw_error(panel, fmt::format("{{/:Italic {}}}_{{{}}}, Gaussians as printed", letter, k + 1), results[0],
               first + k, 1, k + 1);
  draw_error(panel, "greater of both, {/:Italic c T} = 7.5", results[1], first, 2, 4);
  draw_error(panel, "greater of both, polynomial", results[3], first, 2, 3);
  panel.curve("1e-7", {0, inferred}, {1e-7, 1e-7}, scene::lines(5));
  panel.log_y(1e-17, 1).set("bmargin at screen 0.33");
  panel.key("at screen 0.54, screen 0.01 center bottom maxrows 3 samplen 3");
  const auto name = [](std::size_t i) { return global_variants()[i].name; };
  tabulate(results, "derivative matrix", name, false, show);
  show.between(
      costates ? "largest co-state error, printed shape" : "largest state error, printed shape", worst, 1e-7,
      1,
      "regression value: 2e-6 to 0.7 by root, T = 0.5 to 6; rounding in a matrix of condition 4e17 decides");
}

/// Draws the largest errors of states and co-states: one row of panels per case, one column per derivative
/// matrix, with common axes.
void put_all_errors(const std::vector<const std::vector<bvp::GlobalResult>*>& cases, scene::Show& show) {
  struct Matrix {
    const char* name;
    std::size_t variant;  ///< of global_variants()
    std::ptrdiff_t good = 0;
  };
  constexpr double text = 1e-7;  // error stated in the text
  std::array<Matrix, 3> matrices = {
      {{"Gaussians as printed", 0}, {"{/:Italic c T} = 7.5", 1}, {"polynomials", 3}}};
  for (Matrix& m : matrices)
    m.good =
        std::ranges::count_if(cases, [&](const auto* of) { return largest_error((*of)[m.variant]) <= text; });
  scene::Plot& plot = show.plots(fmt::format(
      "Errors below 1e-7: {} of {} cases as printed, {} with {{/:Italic c T}} = 7.5, {} with polynomials",
      matrices[0].good, cases.size(), matrices[1].good, matrices[2].good));
  const int rows = static_cast<int>(cases.size()), top = 84, foot = 96, height = 88, gap = 32;
  const int whole = top + rows * (height + gap) + foot - gap;
  plot.size(760, whole).columns({"panel", "curve", "x", "y"});
  for (int row = 0; row < rows; ++row) {
    const double above = 1 - double(top + row * (height + gap)) / whole;
    const bool last = row + 1 == rows;
    for (std::size_t k = 0; k < matrices.size(); ++k) {
      const double left = 0.125 + 0.292 * static_cast<double>(k);
      scene::Panel& panel = plot.panel(last ? "time (s)" : "", k == 0 ? "error" : "");
      panel.place(left, left + 0.265, above - double(height) / whole, above)
          .caption(k == 0 ? duffing_subjects()[static_cast<std::size_t>(row)].row : "")
          .x_range(0, inferred)
          .log_y(1e-17, 1)
          .set("ytics 1e-16, 1e4, 1")
          .set(k == 0 ? "format y power_of_ten" : "format y ''")
          .level(text)
          .key(last && k == 1 ? "at screen 0.55, screen 0.005 center bottom maxrows 1 samplen 3" : "off");
      if (!last) panel.set("format x ''");
      if (row == 0)
        panel.set(fmt::format("label 900 '{}' at screen {:.3f}, screen {:.4f} center", matrices[k].name,
                              left + 0.1325, 1 - 52.0 / whole));
      const bvp::GlobalResult& r = (*cases[static_cast<std::size_t>(row)])[matrices[k].variant];
      draw_error(panel, "states", r, 0, 2, 1, "lines linewidth 1.6");
      draw_error(panel, "co-states", r, 2, 2, 2, "lines linewidth 1.6");
    }
  }
  for (const Matrix& m : matrices)
    show.between(fmt::format("cases with errors below 1e-7, {}", global_variants()[m.variant].name), m.good,
                 0, static_cast<double>(cases.size()), "some of the six");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  std::vector<scene::Scene> all;
  std::vector<scene::Result<std::vector<bvp::GlobalResult>>> of_cases;
  for (const DuffingSubject& subject : duffing_subjects()) of_cases.push_back(variants(subject));
  all.push_back({.name = "histories-errors",
                 .title = "Errors of states and co-states in time, six cases by three derivative matrices",
                 .content = scene::Content(put_all_errors, of_cases)});
  for (const DuffingSubject& subject : duffing_subjects()) {
    all.push_back(
        {.name = fmt::format("fig-5.{}", subject.figure),
         .title = "States and control, " + subject.title,
         .place = fmt::format("Figure 5.{}", subject.figure),
         .content = scene::Content(put_states, extremals(subject.which), printed_results(subject))});
    for (const bool costates : {false, true}) {
      const int number = subject.figure + (costates ? 2 : 1);
      const bool stated = subject.which == DuffingCase::free || subject.which == DuffingCase::harmonic;
      const auto put = [costates, stated](const std::vector<bvp::GlobalResult>& results, scene::Show& show) {
        put_errors(results, costates, stated, show);
      };
      all.push_back(
          {.name = fmt::format("fig-5.{}", number),
           .title = fmt::format("{} errors at the nodes, {}", costates ? "Co-state" : "State", subject.title),
           .place = fmt::format("Figure 5.{}", number),
           .content = scene::Content(put, variants(subject))});
    }
  }
  return all;
}

}  // namespace nlmech::chapters::rbf_inverse::histories_control

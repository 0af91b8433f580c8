#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/duffing_runs.hpp"
#include "chapters/rbf_inverse/shooting_methods.hpp"
#include "nlmech/peers/bvp/ipopt.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using bvp::DerivativeMatrix;
using bvp::DuffingCase;

/// How a solve ended, and with which x and lambda at 0.
struct Answer {
  Status status;
  Eigen::VectorXd first;
};

/// A setting of a method on a case.
struct Setting {
  std::string name;
  std::function<Answer()> solve;
};

/// What it came to.
struct Cost {
  std::string setting, status;
  std::optional<double> error;  ///< of the initial co-states, relative; nothing if it failed
  Timing time;

  [[nodiscard]] double seconds() const { return time.median; }
  [[nodiscard]] double digits() const { return -std::log10(*error); }
};
/// A method on a case.
struct Line {
  DuffingCase which;
  std::string method;
  int style;
  std::vector<Cost> costs = {};  ///< empty if this build has it not

  [[nodiscard]] double best() const {
    double least = HUGE_VAL;
    for (const Cost& c : costs) least = std::min(least, c.error.value_or(HUGE_VAL));
    return least;
  }
};

/// One case. All begin at the same trajectory: a coarse direct method's.
struct Subject {
  const KnownExtremal& known;
  bool quick;
  bvp::ExtremalProblem problem = duffing_problem(printed_settings(known.which));
  bvp::ControlGuess guess = {Eigen::VectorXd::Zero(2), [](double, Eigen::VectorXd& u) { u[0] = 0; }};
  bvp::Start start = direct_start(problem, guess, {.pieces = 40}).start;

  [[nodiscard]] Cost cost(const Setting& setting) const {
    const Stopwatch watch;
    const Answer answer = setting.solve();
    const double first = watch.seconds();
    Cost c{setting.name, std::string(to_string(answer.status.outcome())), {}, {first, first, first, 1}};
    if (!answer.status.ok()) return c;
    const Eigen::Vector2d right(known.first[2], known.first[3]), found = answer.first.tail<2>();
    c.error = std::max((found - right).cwiseAbs().maxCoeff() / right.cwiseAbs().maxCoeff(), 1e-16);
    if (!quick && first < 0.1)
      c.time = time_repeats([&] { static_cast<void>(setting.solve()); }, first < 0.02 ? 7 : 3);
    return c;
  }
  [[nodiscard]] Line line(const std::string& method, int style, const std::vector<Setting>& settings) const {
    Line line{known.which, method, style};
    for (const Setting& setting : settings) line.costs.push_back(cost(setting));
    return line;
  }
};

Answer answer_of(const bvp::Solution& s) { return {s.status, s.status.ok() ? s.first() : Eigen::VectorXd()}; }

/// @param shape c T; 0: that of the text, which grows with the nodes
std::vector<Setting> one_interval(const Subject& s, DerivativeMatrix derivative, double shape) {
  std::vector<Setting> all;
  for (const int nodes : {10, 15, 20, 25, 30, 40, 50, 60, 80}) {
    if (s.quick && nodes % 20 != 0) continue;
    const bvp::GlobalMethod method{.nodes = nodes,
                                   .relative_shape = shape > 0 ? shape : (nodes - 1) / 4.,
                                   .derivative = derivative,
                                   .rows = printed_rows(s.problem)};
    all.push_back({fmt::format("{} nodes", nodes), [&s, method] {
                     return answer_of(solve_global(s.problem, method, s.start, 0.1, true).extremal.solution);
                   }});
  }
  return all;
}

/// Tolerances of powers of ten.
std::vector<Setting> by_tolerance(int first, int step, const std::function<Answer(double)>& solve) {
  std::vector<Setting> all;
  for (int power = first; power <= 12; power += step)
    all.push_back({fmt::format("tolerance 1e-{}", power),
                   [solve, tolerance = std::pow(10, -power)] { return solve(tolerance); }});
  return all;
}

Answer refined(const Subject& s, double tolerance) {
  return answer_of(
      solve_extremal(s.problem, s.start,
                     {.family = bvp::Family::lobatto, .nodes = 6, .intervals = 3, .tolerance = tolerance})
          .solution);
}

Answer multiple(const Subject& s, double tolerance) {
  const Shot shot = shoot(s.problem, s.start, {.tolerance = tolerance});
  return {shot.status, shot.first};
}

std::vector<Setting> direct(const Subject& s, bool with_ipopt) {
  std::vector<Setting> all;
  for (const int pieces : {50, 100, 200, 400, 800}) {
    if (s.quick && pieces > 100) continue;
    all.push_back({fmt::format("{} pieces", pieces), [&s, with_ipopt, pieces] {
                     const bvp::DirectResult r =
                         with_ipopt ? peers::ipopt_start(s.problem, s.guess, {.pieces = pieces})
                                    : direct_start(s.problem, s.guess, {.pieces = pieces});
                     Eigen::VectorXd z(4);
                     if (r.status.ok()) r.start.states(0, z);
                     return Answer{r.status, z};
                   }});
  }
  return all;
}

std::vector<Line> measure(bool quick) {
  std::vector<Line> lines;
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const Subject s{known_extremal(which), quick};
    const auto add = [&](const std::string& method, int style, const std::vector<Setting>& settings) {
      lines.push_back(s.line(method, style, settings));
    };
    const std::vector<Setting> none;
    add("Gaussian, printed shape", 5, one_interval(s, DerivativeMatrix::gaussian, 0));
    add("stable Gaussian, c T = 5", 2, one_interval(s, DerivativeMatrix::stable_gaussian, 5));
    add("polynomial, one interval", 3, one_interval(s, DerivativeMatrix::polynomial, 5));
    add("polynomial, refined", 1, by_tolerance(3, quick ? 3 : 1, [&](double t) { return refined(s, t); }));
    add("multiple shooting, CVODE", 4,
        multiple_shooting_available()
            ? by_tolerance(4, quick ? 4 : 1, [&](double t) { return multiple(s, t); })
            : none);
    add("direct, own start", 8, direct(s, false));
    add("direct, Ipopt", 7, peers::ipopt_available() ? direct(s, true) : none);
  }
  return lines;
}

void draw(const std::vector<Line>& lines, scene::Show& show) {
  scene::Plot& plot = show.plots("Digits of the initial co-states against time");
  plot.size(1000, 540).columns({"panel", "curve", "time_s", "y"});
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const bool is_free = which == DuffingCase::free;
    scene::Panel& panel = plot.panel("median run time (s)", is_free ? "digits of {/:Italic λ}(0)" : "");
    panel.caption(is_free ? "free final state, {/:Italic T} = 2" : "final state given, {/:Italic T} = 2");
    panel.log_x(1e-4, 10).y_range(0, 16).set("bmargin at screen 0.3");
    panel.set("xtics ('0.1 ms' 1e-4, '1 ms' 1e-3, '10 ms' 1e-2, '0.1 s' 0.1, '1 s' 1, '10 s' 10)");
    panel.key(is_free ? "off" : "at screen 0.5, screen 0.01 center bottom maxrows 3 samplen 3");
    for (const Line& line : lines) {
      auto drawn = line.costs | std::views::filter([](const Cost& c) { return c.error && *c.error < 1; });
      if (line.which == which && !drawn.empty())
        panel.curve(line.method, drawn, &Cost::seconds, &Cost::digits, scene::linespoints(line.style));
    }
  }
}

void tabulate(const std::vector<Line>& lines, scene::Show& show) {
  struct Row {
    const Line* line;
    std::optional<Cost> cost;

    [[nodiscard]] std::optional<double> milliseconds(double Timing::*what) const {
      return cost ? std::optional(1e3 * (cost->time.*what)) : std::nullopt;
    }
  };
  std::vector<Row> rows;
  for (const Line& line : lines) {
    for (const Cost& c : line.costs) rows.push_back({&line, c});
    if (line.costs.empty()) rows.push_back({&line, {}});
  }
  show.table(rows,
             {{"case", [](const Row& r) { return to_string(r.line->which); }},
              {"method", [](const Row& r) { return r.line->method; }},
              {"setting", [](const Row& r) { return r.cost ? scene::Cell(r.cost->setting) : scene::Cell(); }},
              {"status", [](const Row& r) { return r.cost ? r.cost->status : "not in this build"; }},
              {"error of the initial co-states",
               [](const Row& r) { return r.cost ? r.cost->error : std::nullopt; }, 2},
              {"time (ms)", [](const Row& r) { return r.milliseconds(&Timing::median); }},
              {"from", [](const Row& r) { return r.milliseconds(&Timing::smallest); }},
              {"to", [](const Row& r) { return r.milliseconds(&Timing::largest); }}});
}

/// The errors of a method's settings.
void check(const Line& line, scene::Show& show) {
  const std::string name = fmt::format(", {}", to_string(line.which));
  if (line.method == "polynomial, refined")
    show.at_most("least error, polynomial, refined" + name, line.best(), 1e-10,
                 "a tolerance of 1e-12 against tools/oracles/rbf_inverse_extremals.py");
  if (line.method == "Gaussian, printed shape") {
    double worst = 0;
    for (const Cost& c : line.costs)
      if (c.setting != "10 nodes" && c.setting != "15 nodes")
        worst = std::max(worst, c.error.value_or(HUGE_VAL));
    show.between("largest error of 20 and more nodes, Gaussian, printed shape" + name, worst, 1e-7, 1e-1,
                 "recorded: no convergence with the nodes");
  }
  if (line.method == "multiple shooting, CVODE" && !line.costs.empty())
    show.at_most("least error, multiple shooting" + name, line.best(), 1e-8,
                 "a tolerance of 1e-12 in each step");
  if (line.method == "direct, own start")
    show.at_most("least error, direct, own start" + name, line.best(), show.quick() ? 0.1 : 1e-2,
                 "piecewise constant controls: of the second order in their length");
}

void put(const std::vector<Line>& lines, scene::Show& show) {
  draw(lines, show);
  tabulate(lines, show);
  for (const Line& line : lines) check(line, show);
}

}  // namespace

std::vector<scene::Scene> error_vs_time_control() {
  const scene::Result lines(
      "times-control",
      "T = 2, S = I; all begin at the trajectory of a direct method of 40 pieces, which is not timed; direct "
      "methods begin without force; error of lambda(0) against 36 digits; one thread, median of repeats",
      measure);
  return {{.name = "error-vs-time-ocp",
           .title = "Digits of the initial co-states against time",
           .content = scene::Content(put, lines)}};
}

}  // namespace nlmech::chapters::rbf_inverse

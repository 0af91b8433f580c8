#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/multiple_shooting.hpp"
#include "chapters/rbf_inverse/scenes.hpp"
#include "nlmech/peers/bvp/ipopt.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DerivativeMatrix;
using bvp::DuffingCase;
using scene::Workshop;

/// One setting of a method.
struct Cost {
  std::string setting, status;
  std::optional<double> error;  ///< of the initial co-states, relative; nothing if it failed
  Timing time;
};
struct Line {
  std::string method, look;
  std::vector<Cost> costs;  ///< empty if this build has it not
};
struct Panel {
  DuffingCase which;
  std::vector<Line> lines;
};

/// The initial co-states, or nothing, with the status.
using Answer = std::pair<std::optional<Eigen::Vector2d>, Status>;

class Subject {
 public:
  Subject(DuffingCase which, bool quick)
      : problem_(duffing_problem(printed_settings(which, final_times[inferred]))), quick_(quick) {
    const KnownExtremal& known = known_extremal(which);
    reference_ = {known.first[2], known.first[3]};
    // All begin at the same trajectory: a coarse direct method's.
    start_ = direct(40).start;
  }
  [[nodiscard]] const bvp::ExtremalProblem& problem() const { return problem_; }
  [[nodiscard]] const bvp::Start& start() const { return start_; }
  [[nodiscard]] bvp::ControlGuess guess() const {
    return {Eigen::VectorXd::Zero(2), [](double, Eigen::VectorXd& u) { u[0] = 0; }};
  }
  [[nodiscard]] bvp::DirectResult direct(int pieces) const {
    return direct_start(problem_, guess(), {.pieces = pieces});
  }

  Cost cost(const std::string& setting, const std::function<Answer()>& work) const {
    const Stopwatch watch;
    const auto [costates, status] = work();
    const double first = watch.seconds();
    Cost c{setting, std::string(to_string(status.outcome())), {}, {first, first, first, 1}};
    if (!costates) return c;
    c.error =
        std::max((*costates - reference_).cwiseAbs().maxCoeff() / reference_.cwiseAbs().maxCoeff(), 1e-16);
    if (!quick_ && first < 0.1)
      c.time = time_repeats([&] { static_cast<void>(work()); }, first < 0.02 ? 7 : 3);
    return c;
  }

 private:
  bvp::ExtremalProblem problem_;
  bool quick_;
  Eigen::Vector2d reference_;
  bvp::Start start_;
};

Answer answer_of(const Status& status, const std::function<Eigen::VectorXd()>& first) {
  if (!status.ok()) return {std::nullopt, status};
  const Eigen::VectorXd z = first();
  return {Eigen::Vector2d(z[2], z[3]), status};
}

Line global_line(const Subject& s, const std::string& name, const std::string& look,
                 DerivativeMatrix derivative, double shape, bool quick) {
  Line line{name, look, {}};
  const auto rows = printed_rows(s.problem());
  for (const int nodes : {10, 15, 20, 25, 30, 40, 50, 60, 80}) {
    if (quick && nodes % 20 != 0) continue;
    // A shape of 0: that of the text, which grows with the nodes.
    const double relative = shape > 0 ? shape : (nodes - 1) / 4.;
    line.costs.push_back(s.cost(fmt::format("{} nodes", nodes), [&] {
      const bvp::GlobalResult r = solve_global(
          s.problem(), {.nodes = nodes, .relative_shape = relative, .derivative = derivative, .rows = rows},
          s.start(), 0.1, true);
      return answer_of(r.extremal.solution.status, [&] { return r.extremal.solution.first(); });
    }));
  }
  return line;
}

Line refined_line(const Subject& s, bvp::Family family, const std::string& name, const std::string& look,
                  bool quick) {
  Line line{name, look, {}};
  for (int power = 3; power <= 12; power += quick ? 3 : 1) {
    const bvp::Options options{
        .family = family, .nodes = 6, .intervals = 3, .tolerance = std::pow(10, -power)};
    line.costs.push_back(s.cost(fmt::format("tolerance 1e-{}", power), [&] {
      const bvp::Extremal e = solve_extremal(s.problem(), s.start(), options);
      return answer_of(e.solution.status, [&] { return e.solution.first(); });
    }));
  }
  return line;
}

Line shooting_line(const Subject& s, bool quick) {
  Line line{"multiple shooting, CVODE", "b4", {}};
  if (!multiple_shooting_available()) return line;
  for (int power = 4; power <= 12; power += quick ? 4 : 1) {
    line.costs.push_back(s.cost(fmt::format("tolerance 1e-{}", power), [&] {
      const ShotSolution shot = shoot(s.problem(), s.start(), {.tolerance = std::pow(10, -power)});
      return answer_of(shot.status, [&] { return shot.first; });
    }));
  }
  return line;
}

Line direct_line(const Subject& s, bool with_ipopt, bool quick) {
  Line line{with_ipopt ? "direct, Ipopt" : "direct, own start", with_ipopt ? "b7" : "b8", {}};
  if (with_ipopt && !peers::ipopt_available()) return line;
  for (const int pieces : {50, 100, 200, 400, 800}) {
    if (quick && pieces > 100) continue;
    line.costs.push_back(s.cost(fmt::format("{} pieces", pieces), [&] {
      const bvp::DirectResult r =
          with_ipopt ? peers::ipopt_start(s.problem(), s.guess(), {.pieces = pieces}) : s.direct(pieces);
      return answer_of(r.status, [&] {
        Eigen::VectorXd z(4);
        r.start.states(0, z);
        return z;
      });
    }));
  }
  return line;
}

std::vector<Panel> measure(bool quick) {
  std::vector<Panel> panels;
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const Subject s(which, quick);
    Panel panel{which, {}};
    panel.lines.push_back(
        global_line(s, "Gaussian, printed shape", "b5", DerivativeMatrix::gaussian, 0, quick));
    panel.lines.push_back(
        global_line(s, "stable Gaussian, c T = 5", "b2", DerivativeMatrix::stable_gaussian, 5, quick));
    panel.lines.push_back(
        global_line(s, "polynomial, one interval", "b3", DerivativeMatrix::polynomial, 5, quick));
    panel.lines.push_back(refined_line(s, bvp::Family::lobatto, "polynomial, refined", "b1", quick));
    panel.lines.push_back(shooting_line(s, quick));
    panel.lines.push_back(direct_line(s, false, quick));
    panel.lines.push_back(direct_line(s, true, quick));
    panels.push_back(std::move(panel));
  }
  return panels;
}

scene::Figure draw(const std::vector<Panel>& panels) {
  ControlCurves figure("Digits of the initial co-states against time", "time_s");
  for (const Panel& panel : panels) {
    const bool is_free = panel.which == DuffingCase::free;
    figure.panel("median run time (s)", is_free ? "digits of {/:Italic λ}(0)" : "",
                 is_free ? "free final state, {/:Italic T} = 2" : "final state given, {/:Italic T} = 2");
    for (const Line& line : panel.lines) {
      const auto drawn = std::count_if(line.costs.begin(), line.costs.end(),
                                       [](const Cost& c) { return c.error && *c.error < 1; });
      if (drawn == 0) continue;
      figure.begin(line.method, line.look);
      for (const Cost& c : line.costs)
        if (c.error && *c.error < 1) figure.add(c.time.median, -std::log10(*c.error));
    }
    figure.with("logx", "1").with("xrange", "[1e-4:10]").with("yrange", "[0:16]");
    figure.with("xtics",
                "(\"0.1 ms\" 1e-4, \"1 ms\" 1e-3, \"10 ms\" 1e-2, \"0.1 s\" 0.1, \"1 s\" 1, \"10 s\" 10)");
    figure.with("key", is_free ? "off" : "at screen 0.5, screen 0.01 center bottom maxrows 3 samplen 3");
  }
  figure.overall("bottom", "0.3").overall("width", "1000").overall("height", "540");
  return figure.take();
}

scene::Table tabulate(const std::vector<Panel>& panels) {
  scene::Table table({{"case"},
                      {"method"},
                      {"setting"},
                      {"status"},
                      {"error of the initial co-states", 2},
                      {"time (ms)"},
                      {"from"},
                      {"to"}});
  for (const Panel& panel : panels)
    for (const Line& line : panel.lines) {
      const std::string name(to_string(panel.which));
      if (line.costs.empty())
        table.add({name, line.method, {}, std::string("not in this build"), {}, {}, {}, {}});
      for (const Cost& c : line.costs)
        table.add({name, line.method, c.setting, c.status, scene::to_cell(c.error), 1e3 * c.time.median,
                   1e3 * c.time.smallest, 1e3 * c.time.largest});
    }
  return table;
}

double best(const Panel& panel, std::size_t line) {
  double least = HUGE_VAL;
  for (const Cost& c : panel.lines[line].costs) least = std::min(least, c.error.value_or(HUGE_VAL));
  return least;
}

std::vector<scene::Quantity> promises(const std::vector<Panel>& panels, bool quick) {
  std::vector<scene::Quantity> all;
  for (const Panel& panel : panels) {
    const std::string name = fmt::format(", {}", to_string(panel.which));
    all.push_back(scene::at_most("least error, polynomial, refined" + name, "1", best(panel, 3), 1e-10,
                                 "a tolerance of 1e-12 against tools/oracles/rbf_inverse_extremals.py"));
    double worst = 0;
    for (const Cost& c : panel.lines[0].costs)
      if (c.setting != "10 nodes" && c.setting != "15 nodes")
        worst = std::max(worst, c.error.value_or(HUGE_VAL));
    all.push_back({"largest error of 20 and more nodes, Gaussian, printed shape" + name, "1", worst, 1e-7,
                   1e-1, "recorded: no convergence with the nodes"});
    if (!panel.lines[4].costs.empty())
      all.push_back(scene::at_most("least error, multiple shooting" + name, "1", best(panel, 4), 1e-8,
                                   "a tolerance of 1e-12 in each step"));
    all.push_back(scene::at_most("least error, direct, own start" + name, "1", best(panel, 5),
                                 quick ? 0.1 : 1e-2,
                                 "piecewise constant controls: of the second order in their length"));
  }
  return all;
}

}  // namespace

void add_error_vs_time_control(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Panel>>(
      "times-control",
      "T = 2, S = I; all begin at the trajectory of a direct method of 40 pieces, which is not timed; direct "
      "methods begin without force; error of lambda(0) against 36 digits; one thread, median of repeats",
      {}, [](Workshop& w) { return measure(w.quick()); });
  chapter.add({.name = "error-vs-time-ocp",
               .title = "Digits of the initial co-states against time",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) {
                 const auto& panels = w.result(run);
                 return scene::Showing{draw(panels), tabulate(panels), promises(panels, w.quick())};
               }});
}

}  // namespace nlmech::chapters

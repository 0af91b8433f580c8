#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "chapters/homotopy/solvers/load_stepping.hpp"
#include "nlmech/algebraic/homotopies/scalar_homotopy.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::homotopy::load_stepping_study {
namespace {

std::string name_of(const Stepping& how) {
  const bool newton = how.iteration.scheme == Scheme::newton, printed = how.model == Model::element_printed;
  return fmt::format("{}{}", newton ? "Newton" : "fixed-point homotopy", printed ? ", A_nd as printed" : "");
}

/// Loads a pound or half of one apart by the homotopy, a pound apart by Newton; both with A_nd as printed.
std::vector<Stepping> settings() {
  std::vector<Stepping> all;
  for (const double height : heights) {
    for (const Model model : {Model::williams, Model::element}) {
      all.push_back({.model = model, .height = height});
      all.push_back({.model = model, .height = height, .step = 0.5});
      all.push_back({.model = model, .height = height, .iteration = {}});
    }
  }
  all.push_back({.model = Model::element_printed, .height = 0.44});
  all.push_back({.model = Model::element_printed, .height = 0.44, .iteration = {}});
  return all;
}

/// A way up or down by Euler's rule with some step of fictitious time.
struct Way {
  double euler;    ///< that step
  bool up, early;  ///< does it leave the branch before the limit load?
  int missed;      ///< loads past the limit load that were given up
  int jump, most;  ///< iterations of the jump; the most of another load
};

Way way_of(const Stepped& steps, bool up) {
  const auto& way = up ? steps.up : steps.down;
  const auto all = jumps(steps, up);
  const bool early = points_on(way, Branch::falling) > 0 || !(past_limit(steps, up) > 0);
  return {steps.how.iteration.step,  up, early, unsolved(way), all.empty() ? 0 : all[0].after.iterations,
          most_iterations(steps, up)};
}

/// Both toggles that have limit points, both models, up and down, equally spaced Euler steps.
std::vector<Way> census(bool quick) {
  const int intervals = quick ? 11 : 33;
  std::vector<Way> all;
  for (int i = 0; i <= intervals; ++i) {
    for (const double height : {heights[1], heights[2]}) {
      for (const Model model : {Model::williams, Model::element}) {
        const Stepped steps = step_loads(
            {.model = model,
             .height = height,
             .iteration = {.scheme = Scheme::fixed_point, .step = 0.3 + (1.95 - 0.3) * i / intervals}});
        for (const bool up : {true, false}) all.push_back(way_of(steps, up));
      }
    }
  }
  return all;
}

/// 1000 iterations under 1 lb, from rest, with two elements a member: they have the path of one.
struct TwoElements {
  double condition;  ///< of the stiffness at rest
  bool solved;       ///< to 1e-6 lb
};

TwoElements two_elements_a_member() {
  const frames::ToggleFrame toggle = make_frame(frames::Toggle{.height = 0.44, .elements = 2});
  frames::Equilibrium equations(toggle.frame, toggle.load, 1, frames::Coupling::consistent);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(toggle.load.size());
  Eigen::MatrixXd stiffness;
  equations.linearise(x);
  equations.matrix(stiffness);
  const Eigen::VectorXd singular = stiffness.jacobiSvd().singularValues();
  const auto report = find_root(
      algebraic::ScalarHomotopy{.step = example_step, .tolerance = 1e-6, .steps = 1000}, equations, x);
  return {singular[0] / singular[singular.size() - 1], report.status.ok()};
}

struct Study {
  std::vector<Stepped> all;
  std::vector<Way> census;
  TwoElements two_elements;
};

Study study(bool quick) {
  Study s{{}, census(quick), two_elements_a_member()};
  for (const Stepping& how : settings()) s.all.push_back(step_loads(how));
  return s;
}

/// Something of every jump, or "none".
std::string list(const std::vector<Jump>& all, const std::function<std::string(const Jump&)>& text) {
  std::string line;
  for (const Jump& jump : all) line += (line.empty() ? "" : "; ") + text(jump);
  return line.empty() ? "none" : line;
}

/// A row of the table: one way of a stepping.
struct Line {
  const Stepped& steps;
  bool up;
  std::vector<Jump> all = jumps(steps, up);

  [[nodiscard]] const std::vector<LoadPoint>& loads() const { return up ? steps.up : steps.down; }
  [[nodiscard]] std::string toggle() const {
    return fmt::format("{} in, {}", steps.how.height, is_williams(steps) ? "Williams" : "element");
  }
  [[nodiscard]] std::string iteration() const { return name_of(steps.how); }
  [[nodiscard]] std::string way() const {
    return fmt::format("{} lb {}", steps.how.step, up ? "up" : "down");
  }
  [[nodiscard]] std::size_t count() const { return loads().size(); }
  [[nodiscard]] int missed() const { return unsolved(loads()); }
  [[nodiscard]] int falling() const { return points_on(loads(), Branch::falling); }
  [[nodiscard]] std::string jumps_in_load() const {
    return list(all, [](const Jump& j) { return fmt::format("{} to {}", j.before.load, j.after.load); });
  }
  [[nodiscard]] std::string jumps_in_drop() const {
    return list(all, [](const Jump& j) {
      return fmt::format("{:.4f} to {:.4f}", j.before.deflection, j.after.deflection);
    });
  }
  [[nodiscard]] std::string iterations_of_jumps() const {
    return list(all, [](const Jump& j) { return std::to_string(j.after.iterations); });
  }
  [[nodiscard]] int most() const { return most_iterations(steps, up); }
  [[nodiscard]] double distance() const { return greatest_distance(steps); }
};

void put_table(const std::vector<Stepped>& all, scene::Show& show) {
  std::vector<Line> lines;
  for (const Stepped& steps : all) {
    for (const bool up : {true, false}) lines.push_back({steps, up});
  }
  show.table(lines, {{"height, model", &Line::toggle},
                     {"iteration", &Line::iteration},
                     {"load steps", &Line::way},
                     {"loads", &Line::count},
                     {"not solved", &Line::missed},
                     {"on the falling branch", &Line::falling},
                     {"jumps (lb)", &Line::jumps_in_load},
                     {"jumps (in)", &Line::jumps_in_drop},
                     {"iterations of the jumps", &Line::iterations_of_jumps},
                     {"most of another load", &Line::most},
                     {"farthest from the path (in)", &Line::distance, 2}});
}

/// Iterations against the step of fictitious time.
void draw(const std::vector<Way>& census, scene::Show& show) {
  std::map<double, int> most;  // by step
  for (const Way& w : census) most[w.euler] = std::max(most[w.euler], w.most);
  scene::Panel& panel = show.plot("A load on the branch is routine, a jump is a lottery",
                                  "step Δ{/:Italic t} of fictitious time", "iterations");
  panel.key("below").y_range(0, 1050);
  panel.curve("most for a load without a jump", most, &std::pair<const double, int>::first,
              &std::pair<const double, int>::second, scene::lines(1));
  for (const bool up : {true, false}) {
    std::vector<Way> ways;
    std::ranges::copy_if(census, std::back_inserter(ways),
                         [up](const Way& w) { return w.up == up && w.jump > 0; });
    panel.curve(up ? "jumps, loading" : "jumps, unloading", ways, &Way::euler, &Way::jump,
                triangles(up, up ? 5 : 1));
  }
  panel.curve("given up beyond 1000", {0.3, 1.95}, {1000, 1000}, scene::lines(13));
}

void check_census(const std::vector<Way>& census, scene::Show& show) {
  int missed = 0;
  std::vector<double> iterations;
  for (const Way& w : census) {
    missed += w.missed;
    iterations.push_back(w.jump);
  }
  show.at_most("ways that leave the branch before the limit load, all Euler steps",
               std::ranges::count_if(census, &Way::early), 0,
               "with dt below 2 no step goes past a root on the branch");
  show.between("loads past the limit given up after 1000 iterations, share of the jumps",
               missed / static_cast<double>(census.size()), 0, 0.05, "recorded: 0.01; chaotic");
  show.between("median iterations of a jump, all Euler steps", median(iterations), 30, 200,
               "recorded; chaotic");
}

/// The homotopy and Newton's iteration with the derivative of F.
void check_exact(const std::vector<Stepped>& steps, scene::Show& show) {
  double distance = 0, least = HUGE_VAL, greatest = -HUGE_VAL;
  int falling = 0, most = 0, newton = 0;
  for (const Stepped& s : steps) {
    if (s.how.model == Model::element_printed) continue;
    distance = std::max(distance, greatest_distance(s));
    for (const bool up : {true, false}) {
      const auto& way = up ? s.up : s.down;
      falling += points_on(way, Branch::falling);
      int& count = s.how.iteration.scheme == Scheme::newton ? newton : most;
      count = std::max(count, most_iterations(s, up));
      if (s.how.height == heights[0]) continue;
      const double past = past_limit(s, up) / s.how.step;
      least = std::min(least, past);
      greatest = std::max(greatest, past - unsolved(way));
    }
  }
  const char* first =
      "the first load past the limit load of tools/oracles that is solved; those given up left out";
  show.at_most("greatest distance of a found point from the path", {distance, "in"}, 2e-7,
               "the tolerance of 1e-6 lb on F over its slope, at least 5 lb/in here");
  show.at_most("found points on the falling branch", falling, 0,
               "no step goes past a root on a rising branch; past the limit it has none");
  show.between("least load of a jump past the limit load, in load steps", least, 0, 1, first);
  show.between("greatest load of a jump past the limit load, in load steps", greatest, 0, 1, first);
  show.between("most iterations of the homotopy for a load without a jump", most, 22, 30,
               "each leaves 1 - dt/2 = 0.5525 of a residual that begins at 0.5 lb: 22 to the tolerance; some "
               "more where the path bends");
  show.between("most iterations of Newton for a load without a jump", newton, 3, 7,
               "quadratic from a start that is a load step off");
}

double slope(Model model, double deflection) {
  LoadedToggle toggle(model, 0.44, near_load);
  Eigen::MatrixXd b;
  toggle.equations().linearise(toggle.unknowns(deflection));
  toggle.equations().matrix(b);
  return b(0, 0);
}

/// The load on the far branch at which an iteration that takes a part @p factor of Newton's step with A_nd as
/// printed has the multiplier 1 - factor K/K' = -1: roots under smaller loads repel.
double least_attracting_load(double factor) {
  double low = 0.5, high = 0.7;
  for (int i = 0; i < 60; ++i) {
    const double d = (low + high) / 2;
    (slope(Model::element_printed, d) < factor / 2 * slope(Model::element, d) ? low : high) = d;
  }
  return element_curve(0.44)->load(high);
}

/// Both with A_nd as printed.
void check_printed(const Stepped& s, scene::Show& show) {
  const bool newton = s.how.iteration.scheme == Scheme::newton;
  const std::string name = newton ? "Newton" : "homotopy";
  show.between("loads not solved, loading, A_nd as printed, " + name, unsolved(s.up), newton ? 6 : 0,
               newton ? 7 : 1,
               newton ? "recorded: 7, of 43 to 49 lb; the multiplier of 49 lb is close to -1"
                      : "recorded: 0; a jump is chaotic");
  if (!newton) {
    const auto found = jumps(s, false);
    show.between("found points on the falling branch, unloading, A_nd as printed, homotopy",
                 points_on(s.down, Branch::falling), 0, 3,
                 "recorded: 2; where it ends after it has left the far branch is chaotic");
    show.equals("last load on the far branch, unloading, A_nd as printed, homotopy",
                {found.empty() ? NAN : found[0].before.load, "lb"}, 36,
                "the first whole number above the least attracting load");
  }
  show.between("least load whose root on the far branch attracts, A_nd as printed, " + name,
               {least_attracting_load(newton ? 1 : example_step / 2), "lb"}, newton ? 48 : 35,
               newton ? 50 : 36, "between the loads that are solved and those that are not");
}

void put(const Study& s, scene::Show& show) {
  draw(s.census, show);
  put_table(s.all, show);
  check_exact(s.all, show);
  check_census(s.census, show);
  for (const Stepped& steps : s.all) {
    if (steps.how.model == Model::element_printed) check_printed(steps, show);
  }
  // Euler's rule is gradient descent of |F|^2/2 here, with Polyak's steps (scalar_homotopy.hpp).
  show.between("square of the condition, two elements a member, at rest",
               std::pow(s.two_elements.condition, 2), 1e5, HUGE_VAL,
               "gradient descent takes so many iterations in order: a hundred times 1000");
  show.equals("first load solved in 1000 iterations, two elements a member", s.two_elements.solved, 0,
              "1000 are a hundredth of the square of the condition or less");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "load-stepping",
      "loads 1 or 0.5 lb apart up to 50 lb and back, each from the solution before, by the fixed-point "
      "homotopy and by Newton; Euler steps from 0.3 to 1.95",
      study);
  return {{.name = "load-stepping",
           .title = "Load stepping: where it leaves the path, with other steps and by Newton",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::homotopy::load_stepping_study

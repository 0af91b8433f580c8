#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "chapters/homotopy/load_stepping.hpp"
#include "chapters/homotopy/scenes.hpp"
#include "nlmech/algebraic/scalar_homotopy.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

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

/// |F| over that at rest after 1000 iterations under 1 lb, from rest, with two elements a member: they have
/// the path of one.
double residual_of_two_elements() {
  const frames::ToggleFrame toggle = make_frame(frames::Toggle{.height = 0.44, .elements = 2});
  frames::Equilibrium equations(toggle.frame, toggle.load, 1, frames::Coupling::consistent);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(toggle.load.size());
  const auto report = find_root(
      algebraic::ScalarHomotopy{.step = example_step, .tolerance = 1e-6, .steps = 1000}, equations, x);
  return report.last / report.first;
}

struct Study {
  std::vector<Stepped> all;
  std::vector<Way> census;
  double two_elements;
};

Study study(bool quick) {
  Study s{{}, census(quick), residual_of_two_elements()};
  for (const Stepping& how : settings()) s.all.push_back(step_loads(how));
  return s;
}

/// Something of every jump, or "none".
std::string list(const std::vector<Jump>& all, const std::function<std::string(const Jump&)>& text) {
  std::string line;
  for (const Jump& jump : all) line += (line.empty() ? "" : "; ") + text(jump);
  return line.empty() ? "none" : line;
}

scene::Table tabulate(const Study& s) {
  scene::Table table({{"height (in)"},
                      {"model"},
                      {"iteration"},
                      {"load step (lb)"},
                      {"way"},
                      {"loads"},
                      {"not solved"},
                      {"on the falling branch"},
                      {"jumps (lb)"},
                      {"jumps (in)"},
                      {"iterations of the jumps"},
                      {"most of another load"},
                      {"farthest from the path (in)", 2}});
  for (const Stepped& steps : s.all) {
    for (const bool up : {true, false}) {
      const auto& way = up ? steps.up : steps.down;
      const auto all = jumps(steps, up);
      table.add(
          {steps.how.height, is_williams(steps) ? "Williams" : "element", name_of(steps.how), steps.how.step,
           up ? "up" : "down", static_cast<std::int64_t>(way.size()), std::int64_t{unsolved(way)},
           std::int64_t{points_on(way, Branch::falling)},
           list(all, [](const Jump& j) { return fmt::format("{} to {}", j.before.load, j.after.load); }),
           list(all,
                [](const Jump& j) {
                  return fmt::format("{:.4f} to {:.4f}", j.before.deflection, j.after.deflection);
                }),
           list(all, [](const Jump& j) { return fmt::format("{}", j.after.iterations); }),
           std::int64_t{most_iterations(steps, up)}, greatest_distance(steps)});
    }
  }
  return table;
}

/// Iterations against the step of fictitious time.
scene::Figure draw(const Study& s) {
  Curves figure("A load on the branch is routine, a jump is a lottery",
                "step Δ{/:Italic t} of fictitious time", "iterations");
  figure.begin("most for a load without a jump", "l1");
  for (std::size_t i = 0; i < s.census.size();) {
    const double euler = s.census[i].euler;
    int most = 0;
    for (; i < s.census.size() && s.census[i].euler == euler; ++i) most = std::max(most, s.census[i].most);
    figure.add(euler, most);
  }
  for (const bool up : {true, false}) {
    figure.begin(up ? "jumps, loading" : "jumps, unloading", up ? "u5" : "v1");
    for (const Way& w : s.census)
      if (w.up == up && w.jump > 0) figure.add(w.euler, w.jump);
  }
  figure.begin("given up beyond 1000", "l13");
  figure.add(0.3, 1000);
  figure.add(1.95, 1000);
  return figure.with("below", "1").with("height", "520").with("yrange", "[0:1050]").take();
}

void add_census(std::vector<scene::Quantity>& all, const std::vector<Way>& census) {
  int early = 0, missed = 0;
  std::vector<double> iterations;
  for (const Way& w : census) {
    early += w.early ? 1 : 0;
    missed += w.missed;
    iterations.push_back(w.jump);
  }
  all.push_back(scene::at_most("ways that leave the branch before the limit load, all Euler steps", "1",
                               early, 0, "with dt below 2 no step goes past a root on the branch"));
  all.push_back({"loads past the limit given up after 1000 iterations, share of the jumps", "1",
                 missed / static_cast<double>(census.size()), 0, 0.05, "recorded: 0.01; chaotic"});
  all.push_back({"median iterations of a jump, all Euler steps", "1", median(iterations), 30, 200,
                 "recorded; chaotic"});
}

/// The homotopy and Newton's iteration with the derivative of F.
void add_exact(std::vector<scene::Quantity>& all, const std::vector<Stepped>& steps) {
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
  all.push_back(scene::at_most("greatest distance of a found point from the path", "in", distance, 2e-7,
                               "the tolerance of 1e-6 lb on F over its slope, at least 5 lb/in here"));
  all.push_back(scene::at_most("found points on the falling branch", "1", falling, 0,
                               "no step goes past a root on a rising branch; past the limit it has none"));
  all.push_back({"least load of a jump past the limit load, in load steps", "1", least, 0, 1, first});
  all.push_back({"greatest load of a jump past the limit load, in load steps", "1", greatest, 0, 1, first});
  all.push_back(
      {"most iterations of the homotopy for a load without a jump", "1", static_cast<double>(most), 22, 30,
       "each leaves 1 - dt/2 = 0.5525 of a residual that begins at 0.5 lb: 22 to the tolerance; some "
       "more where the path bends"});
  all.push_back({"most iterations of Newton for a load without a jump", "1", static_cast<double>(newton), 3,
                 7, "quadratic from a start that is a load step off"});
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
void add_printed(std::vector<scene::Quantity>& all, const std::vector<Stepped>& steps) {
  for (const Stepped& s : steps) {
    if (s.how.model != Model::element_printed) continue;
    const bool newton = s.how.iteration.scheme == Scheme::newton;
    const std::string name = newton ? "Newton" : "homotopy";
    all.push_back({"loads not solved, loading, A_nd as printed, " + name, "1",
                   static_cast<double>(unsolved(s.up)), newton ? 6.0 : 0.0, newton ? 7.0 : 1.0,
                   newton ? "recorded: 7, of 43 to 49 lb; the multiplier of 49 lb is close to -1"
                          : "recorded: 0; a jump is chaotic"});
    const auto found = jumps(s, false);
    const double last = found.empty() ? NAN : found[0].before.load;
    if (!newton)
      all.push_back({"found points on the falling branch, unloading, A_nd as printed, homotopy", "1",
                     static_cast<double>(points_on(s.down, Branch::falling)), 0, 3,
                     "recorded: 2; where it ends after it has left the far branch is chaotic"});
    if (!newton)
      all.push_back({"last load on the far branch, unloading, A_nd as printed, homotopy", "lb", last, 36, 36,
                     "the first whole number above the least attracting load"});
    all.push_back({"least load whose root on the far branch attracts, A_nd as printed, " + name, "lb",
                   least_attracting_load(newton ? 1 : example_step / 2), newton ? 48.0 : 35.0,
                   newton ? 50.0 : 36.0, "between the loads that are solved and those that are not"});
  }
}

std::vector<scene::Quantity> quantities(const Study& s) {
  std::vector<scene::Quantity> all;
  add_exact(all, s.all);
  add_census(all, s.census);
  add_printed(all, s.all);
  all.push_back({"residual after 1000 iterations, two elements a member, first load", "1", s.two_elements,
                 0.5, 1, "recorded: 0.867; slow by the square of the condition"});
  return all;
}

}  // namespace

void add_load_stepping_study(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Study>(
      "load-stepping",
      "loads 1 or 0.5 lb apart up to 50 lb and back, each from the solution before, by the fixed-point "
      "homotopy and by Newton; Euler steps from 0.3 to 1.95",
      {}, [](Workshop& w) { return study(w.quick()); });
  chapter.add({.name = "load-stepping",
               .title = "Load stepping: where it leaves the path, with other steps and by Newton",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) {
                 const Study& s = w.result(run);
                 return scene::Showing{draw(s), tabulate(s), quantities(s)};
               }});
}

}  // namespace nlmech::chapters

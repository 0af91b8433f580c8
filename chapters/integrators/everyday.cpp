#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::integrators::everyday {
namespace {

/// Output of the command `integrate`.
struct Printed {
  std::vector<double> t, x;         ///< all rows, including those just before and after a jump
  std::vector<std::string> events;  ///< event of each row; may be empty
};

/// @param every time between rows
Printed printed(const comparison::UserProblem& problem, const std::string& until, const std::string& every) {
  comparison::TypedOptions options;
  options.until = until;
  options.every = every;
  const comparison::RunOptions run =
      comparison::run_options(options, problem, problem.initial_state(options.initial));
  const comparison::Trajectory found =
      comparison::trajectory(problem, run, comparison::method_of(options, problem, run));
  Printed all;
  for (const std::string& line : scene::split(found.rows, '\n')) {
    const std::vector<std::string> cells = scene::split(line, ',');
    double t = 0, x = 0;
    if (cells.size() < 2 || !scene::parse_number(cells[0], t) || !scene::parse_number(cells[1], x)) continue;
    all.t.push_back(t);
    all.x.push_back(x);
    all.events.push_back(cells.back());
  }
  return all;
}

Printed printed(const std::string& equation, const std::string& until, const std::string& every) {
  comparison::TypedOptions options;
  options.equation = equation;
  return printed(comparison::problem_of(options)({}), until, every);
}

/// The time of the last event of the given name.
double last_time(const Printed& run, const std::string& name) {
  double t = std::nan("");
  for (std::size_t i = 0; i < run.t.size(); ++i) {
    if (run.events[i] == name) t = run.t[i];
  }
  return t;
}

struct Runs {
  Printed ball, dose, rectifier;
};

constexpr double restitution = 0.8, gravity = 9.81, rate = 0.1;

Runs runs() {
  return {printed("y'' = -9.81; y(0) = 1; y'(0) = 0; when y = 0 falling: y' -> -0.8 y'", "3.4", "0.01"),
          printed("c' = -0.1 c; c(0) = 0; at t = 0:12:60: c -> c + 5", "72", "0.25"),
          printed("v' = (max(sin(t), 0) - v)/3; v(0) = 0", "30", "0.05")};
}

void put(const Runs& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Events and switches: a bouncing ball, doses, a rectifier");
  plot.panel("time (s)", "height (m)").y_range(0, 1).curve("", all.ball.t, all.ball.x);
  plot.panel("time (h)", "amount (mg)").curve("", all.dose.t, all.dose.x);
  plot.panel("time (s)", "voltage (V)").curve("", all.rectifier.t, all.rectifier.x);
  plot.size(1100, 450);

  const double first = std::sqrt(2 / gravity);
  double bounce = first;
  for (int k = 1; k <= 7; ++k) bounce += 2 * first * std::pow(restitution, k);
  show.at_most("time of the eighth bounce", std::abs(last_time(all.ball, "y = 0 falling") - bounce), 1e-8,
               "closed form: flight k takes 2 0.8^k times the first fall");
  const double remaining = std::exp(-12 * rate);
  const double dose = 5 * remaining * (1 - std::pow(remaining, 6)) / (1 - remaining);
  show.at_most("amount at the end", std::abs(all.dose.x.back() - dose), 1e-7,
               "closed form: a geometric series");
}

/// The load of a crane: two columns of a file.
const program::Table& crane_load() {
  static const program::Table table{.times = {0, 2, 5, 6, 9, 10, 20}, .values = {0, 4, 4, -2, -2, 0, 0}};
  return table;
}

Printed loaded_run() {
  const program::SourceText text("load.ode",
                                 R"(x'' + 0.4 x' + 4 x = table("load.csv"); x(0) = 0; x'(0) = 0)");
  return printed(
      comparison::typed_problem(text, {}, "the equation", [](const std::string&) { return crane_load(); }),
      "20", "0.05");
}

/// x(t) of x'' + 0.4 x' + 4 x = s, x(0) = x'(0) = 0, for s = t where t > 0, else 0.
double after_ramp(double t) {
  constexpr double w = 2, damping = 0.1;  // frequency; ratio to critical damping
  if (t <= 0) return 0;
  const double decay = std::exp(-damping * w * t), turn = std::sqrt(1 - damping * damping) * w;
  return t / (w * w) - 2 * damping / (w * w * w) +
         decay * (2 * damping / (w * w * w) * std::cos(turn * t) +
                  (2 * damping * damping - 1) / (w * w * turn) * std::sin(turn * t));
}

void put_load(const Printed& run, scene::Show& show) {
  const program::Table& load = crane_load();
  scene::Plot& plot = show.plots("A table as load: an oscillator swings after each row");
  plot.stacked({0.35, 0.65}).size(900, 500);
  plot.panel("time (s)", "load (N)").y_range(-3, 5).set("ytics 2").curve("", load.times, load.values);
  plot.panel("time (s)", "displacement (m)").curve("", run.t, run.x);

  double worst = 0;
  for (std::size_t k = 0; k < run.t.size(); ++k) {
    double x = 0, before = 0;  // a sum of ramps, one for each change of the slope
    for (std::size_t i = 0; i < load.times.size(); ++i) {
      const double slope = i + 1 < load.times.size() ? load.slope(i) : 0;
      x += (slope - before) * after_ramp(run.t[k] - load.times[i]);
      before = slope;
    }
    worst = std::max(worst, std::abs(run.x[k] - x));
  }
  show.at_most("largest error of the displacement", worst, 1e-7, "closed form: a sum of responses to ramps");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result("events", "typed equations with events and switches, tolerance 1e-9",
                             [](bool) { return runs(); });
  const scene::Result loaded("table-load", "a typed equation with a table as load, tolerance 1e-9",
                             [](bool) { return loaded_run(); });
  return {
      {.name = "events",
       .title = "Events that change the state, and switches of time",
       .content = scene::Content(put, result)},
      {.name = "tabulated-load", .title = "A table as load", .content = scene::Content(put_load, loaded)}};
}

}  // namespace nlmech::chapters::integrators::everyday

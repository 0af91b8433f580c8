#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::integrators::cost_growth {
namespace {

constexpr double tolerance = 1e-9, enough = 0.1;  // s, after which a curve ends
constexpr std::array methods = {
    "series",    "adaptive-collocation",  "dop853",           "rkn1210", "ode45", "cvode-adams",
    "gsl-rk8pd", "odeint-bulirsch-stoer", "odeint-fehlberg78"};

/// What a run cost.
struct Point {
  double size;     ///< end of the interval, or number of masses
  double seconds;  ///< median
  double energy;   ///< its relative drift
};

/// A method's runs.
struct Growth {
  std::string method;
  std::vector<Point> over_time, over_masses;
};

/// duffing-chain.ode with so many masses.
std::string chain_of(int masses) {
  std::string text, energy;
  for (int i = 1; i <= masses; ++i) {
    const std::string left = i > 1 ? fmt::format("x{} - ", i - 1) : "-", right = fmt::format(" + x{}", i + 1);
    text += fmt::format("x{0}'' = -x{0} - x{0}^3 + ({1}2 x{0}{2}); x{0}(0) = sin({0} pi/{3}); x{0}'(0) = 0\n",
                        i, i > 1 ? left : "-", i < masses ? right : "", masses + 1);
    energy += fmt::format("(x{0}'^2 + x{0}^2)/2 + x{0}^4/4 + ({1}x{0})^2/2 + ", i, left);
  }
  return text + fmt::format("conserved {}x{}^2/2", energy, masses);
}

double energy(const ivp::System& system, const ivp::State& x) {
  Eigen::VectorXd values(1);
  static_cast<void>(system.invariants(0, x, values));
  return values[0];
}

bool add(const std::string& method, const ivp::System& system, const ivp::State& x0, double end, double size,
         std::vector<Point>& points) {
  const auto run = comparison::any_method(method).with({.tolerance = tolerance});
  const Stopwatch watch;
  const auto solution = run(system, x0, 0, end, {}, {.seconds = 1});
  const double first = watch.seconds();
  if (!solution.status.ok()) return false;
  const Timing time =
      repeated_timing([&] { static_cast<void>(run(system, x0, 0, end, {}, {})); }, first, false);
  const double before = energy(system, x0);
  points.push_back({size, time.median, std::abs(energy(system, solution.x) - before) / before});
  return time.median < enough;
}

std::vector<Growth> measure(bool quick) {
  const auto built = comparison::built_method_names();
  std::vector<Growth> all;
  for (const char* name : methods) {
    if (std::ranges::find(built, name) == built.end()) continue;
    Growth& g = all.emplace_back();
    g.method = name;
    for (const double end : {10., 100., 1e3, 1e4, 1e5}) {
      if (quick && end > 1e3) break;
      if (!add(name, ivp::System(problems::TextProblem("duffing")), {1, 0}, end, end, g.over_time)) break;
    }
    for (const int count : {1, 3, 10, 30, 100, 300, 1000}) {
      if (quick && count > 30) break;
      program::Equations chain({"chain", chain_of(count)});
      const std::vector<double> x0 = chain.initial_state("chain", "");
      const ivp::State start = Eigen::Map<const Eigen::VectorXd>(x0.data(), chain.size());
      if (!add(name, ivp::System(program::Problem(chain)), start, 10, count, g.over_masses)) break;
    }
  }
  return all;
}

/// Exponent of the growth between the last two points.
double slope(const std::vector<Point>& p) {
  if (p.size() < 2) return 0;
  const Point &a = p[p.size() - 2], &b = p.back();
  return std::log(b.seconds / a.seconds) / std::log(b.size / a.size);
}

void put(const std::vector<Growth>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Tolerance 1e-9: time is in proportion to the interval");
  scene::Panel& time = plot.panel("end of the interval, free Duffing oscillator", "median run time (s)");
  scene::Panel& masses = plot.panel("masses of a Duffing chain, to {/:Italic t} = 10", "");
  // Two decades below the curves for the key.
  time.log_x().log_y(1e-8, 1).key("bottom right samplen 2 spacing 0.75 font ',11'");
  masses.log_x().log_y().key("off");
  plot.size(980, 520).columns({"panel", "curve", "size", "time_s"});
  for (const Growth& g : all) {
    time.curve(g.method, g.over_time, &Point::size, &Point::seconds, scene::linespoints());
    masses.curve("", g.over_masses, &Point::size, &Point::seconds, scene::linespoints());
  }
  show.table(all, {{"method", &Growth::method},
                   {"longest interval", [](const Growth& g) { return g.over_time.back().size; }},
                   {"its time, ms", [](const Growth& g) { return 1e3 * g.over_time.back().seconds; }},
                   {"power of the interval", [](const Growth& g) { return slope(g.over_time); }, 2},
                   {"most masses", [](const Growth& g) { return g.over_masses.back().size; }},
                   {"their time, ms", [](const Growth& g) { return 1e3 * g.over_masses.back().seconds; }},
                   {"power of the masses", [](const Growth& g) { return slope(g.over_masses); }, 2},
                   {"drift of the energy", [](const Growth& g) { return g.over_masses.back().energy; }, 1}});
  for (const Growth& g : all) {
    double drift = 0;
    for (const auto* points : {&g.over_time, &g.over_masses}) {
      for (const Point& p : *points) drift = std::max(drift, p.energy / std::max(1., p.size));
    }
    show.at_most("drift of the energy a unit of the abscissa, " + g.method, drift, 100 * tolerance,
                 "errors of the tolerance add up over some hundred steps");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result growth(
      "growth",
      "one tolerance of 1e-9; a curve ends with its first run of more than 0.1 s; one thread, median",
      measure);
  return {{.name = "cost-growth",
           .title = "Time against the length of the interval, and against the number of masses",
           .content = scene::Content(put, growth)}};
}

}  // namespace nlmech::chapters::integrators::cost_growth

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/curves.hpp"
#include "chapters/rbf_inverse/scenes.hpp"
#include "chapters/rbf_inverse/transfer_runs.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

using orbit::TransferEquations;
using scene::Workshop;

/// What one setting costs and how far it misses.
struct Point {
  int method;
  double seconds, miss;
};
constexpr const char* methods[] = {"Izzo", "collocation, positions", "collocation, 6N equations"};

/// Median of so many calls, each of @p inner solves.
double time_of(int calls, int inner, const std::function<double()>& solve) {
  std::vector<double> all;
  for (int k = 0; k <= calls; ++k) {
    const Stopwatch watch;
    double sum = 0;
    for (int i = 0; i < inner; ++i) sum += solve();
    if (k > 0 && sum != 0) all.push_back(watch.seconds() / inner);  // the first warms up
  }
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

std::vector<Point> measure(Workshop& w) {
  std::vector<Point> points;
  const orbit::TransferProblem p = printed_transfer();
  const orbit::LambertProblem lambert{p.from, p.to, p.time, p.gravity.mu};
  const int calls = w.quick() ? 3 : 9;
  points.push_back({0, time_of(calls, 10'000, [&] { return orbit::solve_lambert(lambert).v1[0]; }),
                    orbit::miss_of(p, orbit::solve_lambert(lambert).v1)});
  for (const TransferEquations equations :
       {TransferEquations::positions, TransferEquations::positions_and_velocities}) {
    for (const int n : {21, 31, 41, 47, 61}) {
      const orbit::TransferCollocation method{.nodes = n, .equations = equations, .largest_miss = 0.01};
      const auto t = orbit::collocate(p, method);
      if (!t.status.ok()) continue;
      points.push_back({equations == TransferEquations::positions ? 1 : 2,
                        time_of(calls, 1, [&] { return orbit::collocate(p, method).v1[0]; }), t.miss});
    }
  }
  return points;
}

scene::Showing show(const scene::Run<std::vector<Point>>& run, Workshop& w) {
  const std::vector<Point>& points = w.result(run);
  ControlCurves curves("Izzo's method: more digits in a thousandth of the time", "time_s");
  curves.panel("time of a solve (s)", "miss (m)");
  for (int m = 0; m < 3; ++m) {
    curves.begin(methods[m], m == 0 ? "o1" : m == 1 ? "b2" : "b3");
    for (const Point& p : points) {
      if (p.method == m) curves.add(p.seconds, std::max(p.miss, 1e-10));
    }
  }
  curves.with("logx", "1").with("logy", "1").with("key", "bottom right").with("yrange", "[1e-12:1e3]");
  double best = HUGE_VAL;
  for (const Point& p : points) {
    if (p.method > 0) best = std::min(best, p.miss);
  }
  scene::Showing showing;
  showing.figure = curves.take();
  showing.quantities = {scene::at_most("miss of Izzo's arc", "m", points.front().miss, 1e-6,
                                       "2e-9 to 7e-8 m; recorded; kappa eps |r_F| is 1e-7 m"),
                        scene::at_most("least miss of collocation", "m", best, 1e-4,
                                       "6e-7 m; recorded with 61 nodes; rounding")};
  return showing;
}

}  // namespace

void add_error_vs_time_lambert(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Point>>(
      "lambert-times", "the printed transfer; polynomials, starts from an arc; medians of single threads", {},
      measure);
  chapter.add({.name = "error-vs-time-lambert",
               .title = "Miss against time of a solve",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(run, w); }});
}

}  // namespace nlmech::chapters

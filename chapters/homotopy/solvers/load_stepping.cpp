#include "chapters/homotopy/solvers/load_stepping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nlmech::chapters::homotopy {
namespace {

/// The branches of a load-deflection curve between its limit points.
class Branches {
 public:
  explicit Branches(const Stepping& how)
      : curve_(how.model == Model::williams || how.model == Model::williams_frozen
                   ? williams_curve(how.height)
                   : element_curve(how.height)),
        limits_(limit_points(*curve_)) {}

  [[nodiscard]] Branch of(double deflection) const {
    if (!limits_ || deflection < limits_->maximum.deflection) return Branch::first;
    return deflection < limits_->minimum.deflection ? Branch::falling : Branch::far;
  }

  [[nodiscard]] double distance(double deflection, double load) const {
    constexpr double end = 0.9;
    const double maximum = limits_ ? limits_->maximum.deflection : end,
                 minimum = limits_ ? limits_->minimum.deflection : end;
    const Branch branch = of(deflection);
    const double low = branch == Branch::first     ? 0
                       : branch == Branch::falling ? maximum
                                                   : minimum,
                 high = branch == Branch::first     ? maximum
                        : branch == Branch::falling ? minimum
                                                    : end;
    return std::abs(deflection - deflection_between(*curve_, load, low, high));
  }

 private:
  std::unique_ptr<LoadCurve> curve_;
  std::optional<LimitPoints> limits_;
};

LoadPoint solve(const Stepping& how, const Branches& branches, double load, double start) {
  LoadedToggle toggle(how.model, how.height, load);
  Iteration iteration = how.iteration;
  iteration.start = start;
  std::vector<IterationRecord> trace;
  const Count count = iterate(toggle, iteration, &trace);
  const double end = trace.back().deflection;
  return {load, count.converged, end, branches.distance(end, load), branches.of(end)};
}

/// Each found point of loading or unloading with the previous one; for the first, the state at rest.
std::vector<Jump> pairs(const Stepped& steps, bool up) {
  std::vector<Jump> all;
  LoadPoint before{0, true, 0, 0, Branch::first};
  for (const auto* way : {&steps.up, &steps.down}) {
    for (const LoadPoint& p : *way) {
      if (!p.found) continue;
      if (way == &(up ? steps.up : steps.down)) all.push_back({before, p});
      before = p;
    }
  }
  return all;
}

/// Small triangles: up for loading, down for unloading.
scene::CurveStyle triangles(bool up, int style) {
  return {up ? "points pointtype 8 pointsize 0.7" : "points pointtype 10 pointsize 0.7", style};
}

const char* to_string(bool up) { return up ? "loading" : "unloading"; }

}  // namespace

int found_from_the_falling_branch(Model model) {
  const Stepping how{.model = model, .height = 0.44};
  const Branches branches(how);
  int found = 0;
  for (const double load : {34, 36, 38, 41}) {
    for (const double start : {0.25, 0.3, 0.35, 0.4, 0.45}) {
      const LoadPoint end = solve(how, branches, load, start);
      found += end.found && end.branch == Branch::falling;
    }
  }
  return found;
}

bool is_williams(const Stepped& steps) { return steps.how.model == Model::williams; }

Stepped step_loads(const Stepping& how) {
  const Branches branches(how);
  const auto count = static_cast<int>(std::lround(stepping_top / how.step));
  Stepped steps{how, {}, {}};
  double start = 0;
  const auto go = [&](int k, std::vector<LoadPoint>& way) {
    way.push_back(solve(how, branches, how.step * k, start));
    if (way.back().found) start = way.back().deflection;
  };
  for (int k = 1; k <= count; ++k) go(k, steps.up);
  for (int k = count - 1; k >= 1; --k) go(k, steps.down);
  return steps;
}

std::vector<Jump> jumps(const Stepped& steps, bool up) {
  std::vector<Jump> all;
  for (const auto& [before, after] : pairs(steps, up))
    if (before.branch != after.branch) all.push_back({before, after});
  return all;
}

int unsolved(const std::vector<LoadPoint>& way) {
  return static_cast<int>(std::count_if(way.begin(), way.end(), [](const LoadPoint& p) { return !p.found; }));
}

int points_on(const std::vector<LoadPoint>& way, Branch branch) {
  return static_cast<int>(std::count_if(way.begin(), way.end(),
                                        [&](const LoadPoint& p) { return p.found && p.branch == branch; }));
}

double greatest_distance(const Stepped& steps) {
  double greatest = 0;
  for (const auto* way : {&steps.up, &steps.down})
    for (const LoadPoint& p : *way)
      if (p.found && !(p.distance <= greatest)) greatest = p.distance;
  return greatest;
}

void draw_steps(scene::Panel& panel, const Stepped& steps) {
  const bool williams = is_williams(steps);
  for (const bool up : {true, false}) {
    std::vector<LoadPoint> found;
    std::ranges::copy_if(up ? steps.up : steps.down, std::back_inserter(found), &LoadPoint::found);
    panel.curve("", found, &LoadPoint::deflection, &LoadPoint::load, triangles(up, williams ? 1 : 5));
    // One grey legend entry per symbol; its colour is that of the line.
    if (williams)
      panel.also(fmt::format("keyentry with {} linecolor rgb soft_ink title 'found, {}'",
                             triangles(up, 0).with, to_string(up)));
  }
  for (const bool up : {true, false}) {
    for (const auto& [before, after] : jumps(steps, up))
      panel.curve("", {before.deflection, after.deflection}, {before.load, after.load}, scene::lines(11));
  }
}

double past_limit(const Stepped& steps, bool up) {
  const auto limits = known_limits_of(steps.how.height, is_williams(steps));
  const auto found = jumps(steps, up);
  if (!limits || found.size() != 1) return std::nan("");
  return up ? found[0].after.load - limits->maximum.load : limits->minimum.load - found[0].after.load;
}

void check_steps(const Stepped& steps, const std::string& which, scene::Show& show) {
  const bool has_limits = known_limits_of(steps.how.height, is_williams(steps)).has_value();
  show.at_most("greatest distance of a found point from the path, " + which, {greatest_distance(steps), "in"},
               2e-7, "the tolerance of 1e-6 lb on F over its slope, no less than 5 lb/in under these loads");
  show.at_most(
      "loads without a solution, " + which, unsolved(steps.up) + unsolved(steps.down), has_limits ? 2 : 0,
      has_limits
          ? "on a branch none; each of the two jumps, chaotic as it is, may take more than 1000 iterations"
          : "the damped iteration stays on the side of the root where it starts, or is near");
  if (!has_limits) return;
  show.at_most("found points on the falling branch, " + which,
               points_on(steps.up, Branch::falling) + points_on(steps.down, Branch::falling), 0,
               "the load is concave up to the maximum and convex behind the minimum, so that no step goes "
               "past a root on the branch; past the limit load there is one root");
  for (const bool up : {true, false})
    show.between(
        fmt::format("load of the jump past the limit load, {}, {}", to_string(up), which),
        {past_limit(steps, up), "lb"}, 0, steps.how.step * (1 + unsolved(up ? steps.up : steps.down)),
        "the limit load of tools/oracles/homotopy_williams.py and homotopy_frames.py; the first load "
        "past it that is solved");
}

}  // namespace nlmech::chapters::homotopy

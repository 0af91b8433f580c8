/// @file
/// Error against cost: each setting of each method run on an example, as a figure and a table.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/comparison/cost/contenders.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

/// One setting, ready to run. No clock calls it off, but 20 million steps do: it is to come out the same
/// twice.
[[nodiscard]] inline Cost cost_of(const Example& c, const std::string& setting,
                                  const ivp::NamedIntegrator& run, bool quick) {
  const ivp::Limits limits{.steps = 20'000'000};
  const Accuracy seen = accuracy_of(c, run, limits);
  const auto again = [&] { static_cast<void>(run(c.system, c.x0, c.t0, c.t1, {}, limits)); };
  return {setting, std::string(to_string(seen.status.outcome())), seen.error, seen.work,
          repeated_timing(again, seen.work.seconds, quick)};
}

/// No curve goes on after a run of more right-hand sides: those after it took most of the time of a
/// comparison.
inline constexpr std::int64_t enough_right_hand_sides = 300'000;
/// The same of a quick look.
inline constexpr std::int64_t enough_for_a_look = 50'000;

/// Fewer runs show no slope, so that a full comparison has them whatever they take.
inline constexpr std::size_t least_runs = 3;

/// Every setting of every method, in the order given (coarse first), to enough_right_hand_sides.
/// @param quick to enough_for_a_look, even without least_runs
[[nodiscard]] inline std::vector<Curve> cost_curves(const Example& c,
                                                    const std::vector<Contender>& contenders, bool quick) {
  std::vector<Curve> curves;
  for (const Contender& contender : contenders) {
    Curve curve{contender.label(), contender.kind, {}};
    for (const Setting& setting : contender.settings) {
      curve.costs.push_back(cost_of(c, setting.text, integrator(contender, setting), quick));
      const std::int64_t right_hand_sides = curve.costs.back().work.right_hand_sides;
      if (quick ? right_hand_sides > enough_for_a_look
                : right_hand_sides > enough_right_hand_sides && curve.costs.size() >= least_runs)
        break;
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// The condition of an example: greatest change of the end, in amplitudes, for a change of the begin by one.
/// By differences of runs whose error is far below them.
/// @param change of each component of the begin, in amplitudes; small enough for a linear answer
/// @throws Failure if a run fails
[[nodiscard]] inline double condition_of(const Example& c, const ivp::NamedIntegrator& run,
                                         double change = 1e-6) {
  const auto end = [&](const ivp::State& x0) {
    const auto solution = run(c.system, x0, c.t0, c.t1, {}, {});
    if (!solution.status.ok()) throw Failure(solution.status);
    return solution.x;
  };
  const ivp::State plain = end(c.x0);
  double greatest = 0;
  for (Eigen::Index i = 0; i < plain.size(); ++i) {
    ivp::State x0 = c.x0;
    x0[i] += change * c.amplitude[i];
    const ivp::State moved = (end(x0) - plain).cwiseQuotient(c.amplitude) / change;
    greatest = std::max(greatest, moved.cwiseAbs().maxCoeff());
  }
  return greatest;
}

/// The setting of a curve with the smallest error; nothing if all failed.
[[nodiscard]] const Cost* best_of(const Curve& curve);

/// The smallest error of a method; NaN if all its runs failed. @throws std::out_of_range naming the method,
/// if there is no curve of it
[[nodiscard]] double least_error(const std::vector<Curve>& curves, const std::string& name);

/// The curve of a method. @throws std::out_of_range naming the method, if there is none
[[nodiscard]] const Curve& curve_of(const std::vector<Curve>& curves, const std::string& name);

/// As work-precision diagrams show them, with right-hand sides, steps and rejected steps.
[[nodiscard]] std::vector<scene::MethodLine> method_lines(const std::vector<Curve>& curves);

/// What MethodLine::group numbers, in the order of Kind. @param own, source what methods of these kinds are
[[nodiscard]] std::vector<scene::MethodGroup> method_groups(
    const std::string& own = "adaptive collocation", const std::string& source = "the source's method");

}  // namespace nlmech::comparison

/// @file
/// Error against cost: each setting of each method run on an example, as a figure and a table.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/comparison/cost/method_sweep.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

/// The line of a method or peer, without runs: its group is its kind, which method_groups() names.
/// @param name of what is no method, too; it may go on: "rbf-coll, N = 35"
[[nodiscard]] scene::MethodLine line_of(std::string name, Kind kind);

/// Further columns of all attempts here.
[[nodiscard]] inline std::vector<std::string> work_columns() {
  return {"right-hand sides", "steps", "rejected"};
}

/// A run with these columns. @param error nothing if it failed
[[nodiscard]] scene::Attempt attempt_of(std::string setting, std::string status, std::optional<double> error,
                                        const Statistics& work, const Timing& time);

/// Steps of such an attempt.
[[nodiscard]] inline std::int64_t steps_of(const scene::Attempt& a) {
  return std::get<std::int64_t>(a.work.at(1));
}

/// One setting, ready to run. No clock calls it off, but 20 million steps do: it is to come out the same
/// twice.
[[nodiscard]] inline scene::Attempt cost_of(const Example& c, const std::string& setting,
                                            const ivp::NamedIntegrator& run, bool quick) {
  const ivp::Limits limits{.steps = 20'000'000};
  const Accuracy seen = accuracy_of(c, run, limits);
  const auto again = [&] { static_cast<void>(run(c.system, c.x0, c.t0, c.t1, {}, limits)); };
  return attempt_of(setting, std::string(to_string(seen.status.outcome())), seen.error, seen.work,
                    repeated_timing(again, seen.work.seconds, quick));
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
[[nodiscard]] inline std::vector<scene::MethodLine> cost_curves(const Example& c,
                                                                const std::vector<MethodSweep>& sweeps,
                                                                bool quick) {
  std::vector<scene::MethodLine> curves;
  for (const MethodSweep& sweep : sweeps) {
    scene::MethodLine curve = line_of(sweep.label(), sweep.kind);
    for (const Setting& setting : sweep.settings) {
      curve.attempts.push_back(cost_of(c, setting.text, integrator(sweep, setting), quick));
      const auto right_hand_sides = std::get<std::int64_t>(curve.attempts.back().work.front());
      if (quick ? right_hand_sides > enough_for_a_look
                : right_hand_sides > enough_right_hand_sides && curve.attempts.size() >= least_runs)
        break;
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// The condition of an example: greatest change of the end, in amplitudes, for a change of the start by one.
/// By differences of runs whose error is far below them.
/// @param change of each component of the start, in amplitudes; small enough for a linear answer
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

/// What MethodLine::group numbers, in the order of Kind. @param own, source what methods of these kinds are
[[nodiscard]] std::vector<scene::MethodGroup> method_groups(
    const std::string& own = "adaptive collocation", const std::string& source = "the source's method");

}  // namespace nlmech::comparison

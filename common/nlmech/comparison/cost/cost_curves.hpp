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

/// Line of a method or peer without runs. Its group is the index of its kind in method_groups().
/// @param name any label, also with settings or of no method: "rbf-coll, N = 35"
[[nodiscard]] scene::MethodLine line_of(std::string name, Kind kind);

/// Names of the cost columns of attempt_of().
[[nodiscard]] inline std::vector<std::string> work_columns() {
  return {"right-hand sides", "steps", "rejected"};
}

/// A run with the columns of work_columns(). @param error nothing if the run failed
[[nodiscard]] scene::Attempt attempt_of(std::string setting, std::string status, std::optional<double> error,
                                        const Statistics& work, const Timing& time);

/// Number of steps of a result of attempt_of().
[[nodiscard]] inline std::int64_t steps_of(const scene::Attempt& a) {
  return std::get<std::int64_t>(a.work.at(1));
}

/// Error and time of one setting. The limit is 20 million steps and no time, so that the result is
/// reproducible.
[[nodiscard]] inline scene::Attempt cost_of(const Example& c, const std::string& setting,
                                            const ivp::NamedIntegrator& run, bool quick) {
  const ivp::Limits limits{.steps = 20'000'000};
  const Accuracy seen = accuracy_of(c, run, limits);
  const auto again = [&] { static_cast<void>(run(c.system, c.x0, c.t0, c.t1, {}, limits)); };
  return attempt_of(setting, std::string(to_string(seen.status.outcome())), seen.error, seen.work,
                    repeated_timing(again, seen.work.seconds, quick));
}

/// A curve ends with its first run of more right-hand sides, to limit the time of a comparison.
inline constexpr std::int64_t most_right_hand_sides = 300'000;
/// most_right_hand_sides of a quick comparison.
inline constexpr std::int64_t most_right_hand_sides_quick = 50'000;

/// Least number of runs of a curve in a full comparison whatever their cost: fewer show no slope.
inline constexpr std::size_t least_runs = 3;

/// Runs every setting of every method in the given order (coarse first) up to most_right_hand_sides.
/// @param quick up to most_right_hand_sides_quick, even with fewer than least_runs
[[nodiscard]] inline std::vector<scene::MethodLine> cost_curves(const Example& c,
                                                                const std::vector<MethodSweep>& sweeps,
                                                                bool quick) {
  std::vector<scene::MethodLine> curves;
  for (const MethodSweep& sweep : sweeps) {
    scene::MethodLine curve = line_of(sweep.label(), sweep.kind);
    for (const Setting& setting : sweep.settings) {
      curve.attempts.push_back(cost_of(c, setting.text, integrator(sweep, setting), quick));
      const auto right_hand_sides = std::get<std::int64_t>(curve.attempts.back().work.front());
      if (quick ? right_hand_sides > most_right_hand_sides_quick
                : right_hand_sides > most_right_hand_sides && curve.attempts.size() >= least_runs)
        break;
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// Condition number of an example: greatest change of the final state over the change of one component of the
/// initial state, both in amplitudes; by one-sided differences of runs.
/// @param run method with errors far below @p change
/// @param change of each component of the initial state, in amplitudes; small enough for a linear response
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

/// Groups of methods in the order of Kind, indexed by MethodLine::group. @param own, source names of these
/// kinds
[[nodiscard]] std::vector<scene::MethodGroup> method_groups(
    const std::string& own = "adaptive collocation", const std::string& source = "the source's method");

}  // namespace nlmech::comparison

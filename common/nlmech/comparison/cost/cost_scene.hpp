/// @file
/// A scene of digits against cost of integrators: one result, its work-precision diagram, its checks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "nlmech/comparison/cost/cost_curves.hpp"

namespace nlmech::comparison {

/// What methods came to on an example, and how well it can be solved at all.
struct Costs {
  std::vector<Curve> curves;  ///< a method each
  double condition = 0;       ///< of the example, see condition_of(); 0: not known
  double again = 0;           ///< the same for a hundred times the change; 0: not known
};

/// Every setting of every method, and both conditions by a series at 1e-16. @param change see condition_of()
[[nodiscard]] inline Costs costs_of(const Example& c, const std::vector<Contender>& contenders, double change,
                                    bool quick) {
  const auto accurate = ivp::named_integrator("series", {.tolerance = 1e-16});
  return {cost_curves(c, contenders, quick), condition_of(c, accurate, change),
          condition_of(c, accurate, 100 * change)};
}

/// Checks that the condition is one: the answer to a change of the begin is linear to 5 %.
void check_condition(const Costs& costs, scene::Show& show);

/// The tightest tolerance that by_tolerances() gives, in full or quick.
[[nodiscard]] constexpr double tightest_tolerance(bool quick) { return quick ? 1e-8 : 1e-13; }

/// What a scene of digits against cost is about.
struct CostScene {
  std::string name;     ///< "duffing": scene `error-vs-time-duffing`, run `times-duffing`; may be empty
  std::string problem;  ///< "Driven Duffing oscillator to t = 50"; the heading adds who is fastest
  std::string reading;  ///< of the run: settings, and what else is particular
  std::function<Costs(bool quick)> measure = {};               ///< called at most once a process
  std::function<void(const Costs&, scene::Show&)> check = {};  ///< of the scene
};

/// The scene. All of them judge by the median error over LastEnds, on one thread.
[[nodiscard]] scene::Scene cost_scene(CostScene what);

}  // namespace nlmech::comparison

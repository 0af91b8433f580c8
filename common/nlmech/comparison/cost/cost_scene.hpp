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
  scene::ProblemLines lines;  ///< a method each
  double condition = 0;       ///< of the example, see condition_of(); 0: not known
  double again = 0;           ///< the same for a hundred times the change; 0: not known
};

/// The tightest tolerance that by_tolerances() gives, in full or quick.
[[nodiscard]] constexpr double tightest_tolerance(bool quick) { return quick ? 1e-8 : 1e-13; }

/// Checks the error of a method at its tightest tolerance: that tolerance in each step, all of one sign,
/// times the condition.
void check_tightest(const Costs& costs, const std::string& method, scene::Show& show);

/// Methods and peers on one problem, each over its sweep of tolerances or steps.
struct WorkPrecisionStudy {
  std::string name;     ///< "duffing": scene `error-vs-time-duffing`, run `times-duffing`; may be empty
  std::string problem;  ///< "Driven Duffing oscillator to t = 50"; the heading adds who is fastest
  std::string reading;  ///< of the run: settings, and what else is particular
  std::function<Example()> example = {};                             ///< the problem
  std::function<std::vector<MethodSweep>(bool quick)> methods = {};  ///< in the picture; all peers follow
  double change = 0;  ///< of the start, by which condition_of() finds the condition and that the answer to it
                      ///< is linear; 0: the condition is not asked for
  std::function<Costs(bool quick)> measure = {};               ///< instead of example, methods and change
  std::function<void(const Costs&, scene::Show&)> check = {};  ///< of the scene
};

/// The scene. All of them judge by the median error over LastEnds, on one thread.
[[nodiscard]] scene::Scene work_precision_scene(WorkPrecisionStudy study);

}  // namespace nlmech::comparison

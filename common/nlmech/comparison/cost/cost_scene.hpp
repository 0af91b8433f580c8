/// @file
/// A scene with the work-precision diagram of integrators on one problem.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "nlmech/comparison/cost/cost_curves.hpp"

namespace nlmech::comparison {

/// Runs of methods on an example and its condition number.
struct Costs {
  scene::ProblemLines lines;  ///< one line per method
  double condition = 0;       ///< condition number of the example, see condition_of(); 0: unknown
  double again = 0;           ///< condition number found with a hundred times the change; 0: unknown
};

/// The tightest tolerance of by_tolerances().
[[nodiscard]] constexpr double tightest_tolerance(bool quick) { return quick ? 1e-8 : 1e-13; }

/// Checks the error of a method at its tightest tolerance against a bound: that tolerance in each step, all
/// errors of one sign, times the condition number.
void check_tightest(const Costs& costs, const std::string& method, scene::Show& show);

/// Methods and peers on one problem, each over its sweep of tolerances or steps.
struct WorkPrecisionStudy {
  std::string name;     ///< "duffing": scene `error-vs-time-duffing`, run `times-duffing`; may be empty
  std::string problem;  ///< "Driven Duffing oscillator to t = 50"; the heading adds the fastest methods
  std::string reading;  ///< text about the run: settings and particulars
  std::function<Example()> example = {};                             ///< makes the problem
  std::function<std::vector<MethodSweep>(bool quick)> methods = {};  ///< methods; all peers are appended
  double change = 0;  ///< change of the initial state for condition_of(); a hundred times this change checks
                      ///< that the response is linear; 0: no condition number
  std::function<Costs(bool quick)> measure = {};               ///< instead of example, methods and change
  std::function<void(const Costs&, scene::Show&)> check = {};  ///< checks of the scene
};

/// Scene of a study: median error over LastEnds against cost, on one thread.
[[nodiscard]] scene::Scene work_precision_scene(WorkPrecisionStudy study);

}  // namespace nlmech::comparison

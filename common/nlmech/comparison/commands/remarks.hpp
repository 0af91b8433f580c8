/// @file
/// Remarks on typed equations before their integration.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/commands/run_options.hpp"
#include "nlmech/comparison/commands/user_problem.hpp"

namespace nlmech::comparison {

/// Remarks for standard error: a start with several solutions, functions of time that change for a short time
/// after a rest, and known times at which the equations change.
[[nodiscard]] std::vector<std::string> remarks_on(const UserProblem& problem, const RunOptions& options);

/// The fastest sin(w t + c) or cos(w t + c) in the equations.
struct Wave {
  double frequency = 0;  ///< w, rad/time; 0 if there is none
  double turns = 0;      ///< number of its periods between two times

  /// "a force of the frequency 10 turns 1.6e+05 times"
  [[nodiscard]] std::string text() const;
};
/// The wave of the greatest frequency in the equations, with its periods from @p t0 to @p t1.
[[nodiscard]] Wave fastest_wave(const UserProblem& problem, double t0, double t1);

}  // namespace nlmech::comparison

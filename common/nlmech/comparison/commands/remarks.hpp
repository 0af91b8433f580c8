/// @file
/// What is worth saying of typed equations before they are integrated.
#pragma once

#include <string>
#include <vector>

#include "nlmech/comparison/commands/run_options.hpp"
#include "nlmech/comparison/commands/user_problem.hpp"

namespace nlmech::comparison {

/// Sentences for standard error: functions of the time that change within a short time after a rest, known
/// times at which the equations jump, and a start from which several solutions lead.
[[nodiscard]] std::vector<std::string> remarks_on(const UserProblem& problem, const RunOptions& options);

/// The fastest sin(w t + c) or cos(w t + c) in the equations.
struct Wave {
  double frequency = 0;  ///< w, rad/time; 0 if there is none
  double turns = 0;      ///< how many of its periods fit between two times

  /// "a force of the frequency 10 turns 1.6e+05 times"
  [[nodiscard]] std::string text() const;
};
[[nodiscard]] Wave fastest_wave(const UserProblem& problem, double t0, double t1);

}  // namespace nlmech::comparison

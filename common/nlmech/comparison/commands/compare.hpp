/// @file
/// `compare`: methods side by side on one problem.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nlmech/comparison/commands/run_options.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/scene/cost/lines.hpp"

namespace nlmech::comparison {

/// A method with those of the settings that it has.
struct Choice {
  const ivp::MethodInfo* method;  ///< which
  ivp::Settings settings;         ///< how

  /// "step 0.5 nodes 7"
  [[nodiscard]] std::string setting() const;
};

/// The methods that were typed, or those that suit the problem: of ours, and of each kind of peers the best
/// that this build has; with a step, those of ours that take one. Each with those of the settings that it
/// has, and at each of the tolerances of a sweep.
/// @throws InputError naming the option for a method that there is not, or twice, a tolerance that is none,
/// and a setting that none of the methods has
[[nodiscard]] std::vector<Choice> choices(const TypedOptions& typed, const UserProblem& problem,
                                          const RunOptions& options);

/// Methods side by side.
struct Comparison {
  std::string rows;                      ///< CSV
  std::vector<scene::MethodLine> lines;  ///< the same by method, for a picture
};

/// Rows `method,setting,status,digits,seconds,right_hand_sides,note`. Methods that fail, and those that are
/// not for the problem or the settings, keep their row and say why, also on standard error after the name of
/// the @p program. The digits are those of the end state, but no more than the reference knows. `note` is the
/// sentence of a failure, or says of a run by a tolerance that its end is off by more than most_tolerances.
/// Wall time is shared: each method gets its part of what those before it have left.
/// @throws InputError naming `--methods` if none of the methods is for the problem and the settings
[[nodiscard]] Comparison comparison(const UserProblem& problem, const RunOptions& options,
                                    const std::vector<Choice>& methods, std::string_view program);

}  // namespace nlmech::comparison

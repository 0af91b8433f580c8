/// @file
/// `compare`: several methods on one problem.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "nlmech/comparison/commands/run_options.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/scene/cost/lines.hpp"

namespace nlmech::comparison {

/// A method with the settings that apply to it.
struct Choice {
  const ivp::MethodInfo* method;  ///< method
  ivp::Settings settings;         ///< settings that apply to the method

  /// "step 0.5 nodes 7"
  [[nodiscard]] std::string setting() const;
};

/// The methods of `--methods` or, without it, those that suit the problem: nlmech methods and the best peer
/// of each kind in this build; with a step, nlmech methods with fixed steps. Each has the settings that apply
/// to it, and occurs once for each tolerance of a sweep.
/// @throws InputError naming the option for an unknown or repeated method, an invalid tolerance, or a setting
/// that applies to none of the methods
[[nodiscard]] std::vector<Choice> choices(const TypedOptions& typed, const UserProblem& problem,
                                          const RunOptions& options);

/// Results of several methods.
struct Comparison {
  std::string rows;                      ///< CSV
  std::vector<scene::MethodLine> lines;  ///< the same results by method, for a figure
};

/// Runs each method; rows are `method,setting,status,digits,seconds,right_hand_sides,note`. A method that
/// fails or does not apply to the problem or the settings keeps its row; its reason is in `note` and passed
/// to
/// @p say, which also receives what the reference is. `digits` are those of the final state, at most those of
/// the reference. `note` also reports a run at a tolerance whose error exceeds most_tolerances. Each method
/// gets an equal share of the wall time that the methods before it have left.
/// @throws InputError naming `--methods` if none of the methods applies to the problem and the settings
[[nodiscard]] Comparison comparison(const UserProblem& problem, const RunOptions& options,
                                    const std::vector<Choice>& methods,
                                    const std::function<void(const std::string&)>& say);

}  // namespace nlmech::comparison

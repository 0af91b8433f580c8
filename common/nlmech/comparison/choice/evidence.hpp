/// @file
/// What is known of methods from problems that were solved: how many digits, at which tolerance, for how
/// much.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/comparison/choice/features.hpp"

namespace nlmech::comparison {

/// A run that was measured, or what lies between two of them.
struct Measured {
  double tolerance;         ///< relative
  double digits;            ///< delivered
  double steps;             ///< accepted and rejected
  double right_hand_sides;  ///< counted
  double cost;  ///< time, in units of one right-hand side of the free Duffing oscillator on the same machine
};

/// A problem of the evidence.
struct SolvedProblem {
  std::string name;      ///< "kepler-0.99"
  Features features;     ///< what a look shows of it
  double condition = 1;  ///< greatest factor from errors of one tolerance on the way to the error at the end
  std::map<std::string, std::vector<Measured>> runs = {};  ///< by method; loose first, successes alone

  /// What @p digits cost with a method: the cheapest of its runs that deliver them, or what lies between one
  /// that delivers less and the next, straight in the logarithms; nothing if it does not deliver.
  [[nodiscard]] std::optional<Measured> measured(const std::string& method, double digits) const;
};

/// All of it.
struct Evidence {
  std::vector<SolvedProblem> problems;  ///< in the order of the tables

  /// Without the problem of that name, and those that are the same on another way: what judges a choice.
  [[nodiscard]] Evidence without(const std::string& name) const;
  /// The methods of which there is any.
  [[nodiscard]] std::vector<std::string> methods() const;
};

/// What tables/reference/method_costs.csv and method_problems.csv say.
/// @throws Failure naming the file, if one is not there or does not fit
[[nodiscard]] Evidence read_evidence();

}  // namespace nlmech::comparison

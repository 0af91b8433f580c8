/// @file
/// What `compare` prints: a row a method, and on standard error what the digits are measured by and why a row
/// has none.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "nlmech/comparison/commands/own_problem.hpp"
#include "nlmech/comparison/reference/reference.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

/// Rows `method,setting,status,digits,seconds,right_hand_sides,note`.
///
/// The digits are those of the end state, but no more than the reference knows. `note` is the
/// sentence of a failure, or says of a run by a tolerance that its end is off by more than most_tolerances.
class ComparisonTable {
 public:
  /// @param program begins what is said on standard error
  /// @param truth the reference, its last time the end; without one there are no digits, which is said
  /// @param x0 initial state
  ComparisonTable(std::string_view program, const Reference& truth, const Eigen::VectorXd& x0);

  /// A run that ended with @p status at the state @p x.
  void add(const Choice& choice, const Status& status, const Statistics& statistics, const Eigen::VectorXd& x,
           const Timing& time);
  /// A method that is not for this problem or these settings: the status is `unsuitable`.
  void add_unsuitable(const Choice& choice, const std::string& why);

  /// All of it. @throws InputError naming `--methods` if there are unsuitable ones alone
  [[nodiscard]] Comparison take();

 private:
  void say(const Choice& choice, std::string_view sentence) const;
  [[nodiscard]] double error_of(const Eigen::VectorXd& x) const;
  [[nodiscard]] std::string note(const Choice& choice, const Eigen::VectorXd& x) const;

  std::string_view program_;
  const Reference& truth_;
  Eigen::VectorXd size_;
  bool some_ = false;
  std::string unsuitable_;
  std::vector<Curve> curves_;
  std::string text_ = "method,setting,status,digits,seconds,right_hand_sides,note\n";
};

}  // namespace nlmech::comparison

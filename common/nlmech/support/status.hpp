/// @file
/// Outcome of a computation: one enumeration for the whole library, and a message with place and remedy.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nlmech {

/// Outcomes of all computations of this library. Cheap to copy: kernels return one per point.
enum class Outcome : std::uint8_t {
  success,           ///< completed as requested
  step_limit,        ///< the allowed number of steps or iterations was used up
  time_limit,        ///< the allowed wall time was used up
  step_underflow,    ///< the step became too small to move the independent variable
  non_finite,        ///< an input or intermediate value is NaN or infinite
  newton_diverged,   ///< Newton's iteration left its region of convergence
  singular_matrix,   ///< a matrix that must be inverted is singular to working precision
  not_converged,     ///< an iteration stalled above its tolerance
  spurious_root,     ///< a root of the discrete equations that is no solution of the problem
  wrong_branch,      ///< a solution of the problem on another branch than the requested one
  at_pole,           ///< the argument lies on a pole of the function
  collision,         ///< two bodies met, or a trajectory reached a singular centre
  outside_validity,  ///< outside the range of validity of the method
  infeasible,        ///< the constraints contradict each other
  interrupted        ///< stopped by the caller
};

/// Name of the enumerator, as in tables and on standard error: "step_limit".
[[nodiscard]] std::string_view to_string(Outcome outcome) noexcept;

/// An outcome with its message. Every failure has a message.
class [[nodiscard]] Status {
 public:
  /// Success; carries no text and allocates nothing.
  Status() noexcept = default;

  /// A failure. @p sentence names the method, the place (time, step, row) and what to change.
  /// @throws std::invalid_argument if @p outcome is success or @p sentence is empty.
  static Status failure(Outcome outcome, std::string sentence);

  /// Is it a success?
  [[nodiscard]] bool ok() const noexcept { return outcome_ == Outcome::success; }
  /// The outcome.
  [[nodiscard]] Outcome outcome() const noexcept { return outcome_; }
  /// The message; empty for success.
  [[nodiscard]] const std::string& sentence() const noexcept { return sentence_; }
  /// "outside_validity: series of order 4, ..." or "success".
  [[nodiscard]] std::string text() const;

 private:
  Outcome outcome_ = Outcome::success;
  std::string sentence_;
};

}  // namespace nlmech

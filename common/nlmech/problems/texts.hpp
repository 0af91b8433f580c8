/// @file
/// Problems that are texts: `kepler.ode` beside this file is the problem "kepler".
#pragma once

#include <span>
#include <string_view>

#include "nlmech/ivp/system.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::problems {

/// A problem as one types it.
struct ProblemText {
  std::string_view name;  ///< of the file, without .ode
  std::string_view text;  ///< all of it
};

/// All of them, in the order of their names.
[[nodiscard]] std::span<const ProblemText> problem_texts();

/// A problem that is a text, with the data that stand in it: a right-hand side for every type of number.
class TextProblem : public program::Problem {
 public:
  /// @param name of one of problem_texts()
  /// @param settings of its definitions
  /// @throws std::invalid_argument listing all names, if there is none of that name; for a text without
  /// initial values or end
  /// @throws InputError for a setting that the text does not name, or that breaks a condition
  explicit TextProblem(std::string_view name, const program::Settings& settings = {});

  double initial_time;  ///< where it begins
  double final_time;    ///< where it ends

  /// The state there.
  [[nodiscard]] const ivp::State& initial_state() const { return x0_; }
  /// What methods run on.
  [[nodiscard]] ivp::System system() const { return ivp::System(static_cast<const Problem&>(*this)); }

 private:
  explicit TextProblem(program::Equations equations);

  ivp::State x0_;
};

}  // namespace nlmech::problems

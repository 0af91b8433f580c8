/// @file
/// Problems that are texts: `kepler.ode` beside this file is the problem "kepler".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/ivp/state.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::problems {

/// A problem as one types it.
struct ProblemText {
  std::string_view name;  ///< of the file, without .ode
  std::string_view text;  ///< all of it
};

/// All of them, in the order of their names.
[[nodiscard]] std::span<const ProblemText> problem_texts();

/// A problem that is a text, with the data that stand in it: a right-hand side for every type of number, and
/// what ivp::System takes. Its numbers are doubles in every precision: 0.1 in a text is the double next to
/// it, so that a reference in more digits is of the problem that methods solve.
class TextProblem : public program::Problem {
 public:
  /// @param of_text name of one of problem_texts()
  /// @param settings of its definitions
  /// @throws std::invalid_argument listing all names, if there is none of that name; for a text without
  /// initial values or end
  /// @throws InputError for a setting that the text does not name, or that breaks a condition
  explicit TextProblem(std::string_view of_text, const program::Settings& settings = {});

  std::string name;     ///< as on command lines
  double initial_time;  ///< where it begins
  double final_time;    ///< where it ends

  /// The state there.
  [[nodiscard]] const ivp::State& initial_state() const { return x0_; }
  /// The definitions that are numbers, as the text names them.
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& parameters() const { return parameters_; }
  /// The value of one of them. @throws std::invalid_argument if there is none of that name
  [[nodiscard]] double parameter(std::string_view definition) const;

 private:
  TextProblem(program::Equations equations, std::string_view of_text);

  ivp::State x0_;
  std::vector<std::pair<std::string, double>> parameters_;
};

}  // namespace nlmech::problems

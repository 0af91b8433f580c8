/// @file
/// Library problems as texts: `kepler.ode` in this folder is the problem "kepler".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/ivp/state.hpp"
#include "nlmech/program/problem.hpp"

namespace nlmech::problems {

/// Text of a library problem.
struct ProblemText {
  std::string_view name;  ///< name of the file without .ode
  std::string_view text;  ///< content of the file
};

/// All library problems in alphabetical order.
[[nodiscard]] std::span<const ProblemText> problem_texts();

/// The boundary value problems of Mazzia and Cash's test set, `bvpT1` to `bvpT35`: equations, a parameter and
/// conditions, for bvp::read_problem(). `tables/reference/bvp_test_set.csv` has values of their solutions.
[[nodiscard]] std::span<const ProblemText> boundary_texts();

/// Problem from a text with its initial state, times and parameters, for every type of number and for
/// ivp::System. Numbers of the text are doubles in every precision: 0.1 is the nearest double, so that a
/// reference in extended precision solves the same problem as methods in double precision.
class TextProblem : public program::Problem {
 public:
  /// @param of_text name of one of problem_texts()
  /// @param settings values of its parameters
  /// @throws std::invalid_argument listing all names, for an unknown name; for a text without initial values
  /// or end
  /// @throws InputError for an unknown parameter or a value that violates a condition
  explicit TextProblem(std::string_view of_text, const program::Settings& settings = {});

  std::string name;     ///< name on command lines
  double initial_time;  ///< initial time of the text
  double final_time;    ///< end time of the text

  /// The state at the initial time.
  [[nodiscard]] const ivp::State& initial_state() const { return x0_; }
  /// Names and values of the parameters, the numeric definitions of the text.
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& parameters() const { return parameters_; }
  /// The value of a parameter. @throws std::invalid_argument for an unknown name
  [[nodiscard]] double parameter(std::string_view definition) const;

 private:
  TextProblem(program::Equations equations, std::string_view of_text);

  ivp::State x0_;
  std::vector<std::pair<std::string, double>> parameters_;
};

}  // namespace nlmech::problems

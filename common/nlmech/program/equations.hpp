/// @file
/// Equations as they are typed, solved for the highest derivative of each unknown.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/meaning.hpp"
#include "nlmech/program/source_text.hpp"
#include "nlmech/program/syntax.hpp"

namespace nlmech::program {

/// A value given from outside: `--set a=4`.
using Settings = std::map<std::string, double>;

/// How high derivatives may be.
inline constexpr int highest_order = 4;
/// How many unknowns there may be.
inline constexpr int most_unknowns = 2000;

/// A system of equations. Every method of initial value problems runs on it, through Problem (problem.hpp).
///
/// The state holds all unknowns in the order in which the text names them, then their first derivatives, and
/// so on, without the highest ones. So a system of second order has positions and then velocities.
class Equations {
 public:
  /// Reads equations, definitions (`a = 3`, `r = sqrt(x^2 + y^2)`), initial values (``x'(0) = 1``),
  /// conditions
  /// (`t <= 10` is the end, `x >= 0` holds along every solution that begins so, `a > 0` is asked of a
  /// definition) and what is conserved (``conserved x'^2 + x^2``).
  /// @param settings replace definitions by numbers, and give those that the text leaves out
  /// @throws InputError that points at the mistake and says what was expected; for a setting that is not
  /// finite, that the text does not name, or that breaks a condition
  /// @param read_table for table("load.csv"); none: tables are refused
  explicit Equations(SourceText source, const Settings& settings = {}, TableReader read_table = {});

  /// Components of the state.
  [[nodiscard]] int size() const { return graph_.size(); }
  /// Is every unknown of second order, so that the state is positions and then velocities?
  [[nodiscard]] bool second_order() const;
  /// "x", "y", "x'", "y'"
  [[nodiscard]] const std::vector<std::string>& state_names() const { return state_names_; }
  /// The unknowns, as the text first names them.
  [[nodiscard]] const std::vector<Unknown>& unknowns() const { return names_.unknowns; }
  /// The definitions that are numbers, as the text names them.
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& parameters() const { return parameters_; }
  /// The derivative of each component of the state, in graph().
  [[nodiscard]] const std::vector<NodeId>& slopes() const { return slopes_; }
  /// What stays constant along every solution, in graph().
  [[nodiscard]] const std::vector<NodeId>& conserved() const { return conserved_; }
  /// What each component cannot fall below at later times, if it is above now; empty: no component has a
  /// bound.
  [[nodiscard]] const std::vector<double>& lower_bounds() const { return lower_; }
  /// What each cannot exceed.
  [[nodiscard]] const std::vector<double>& upper_bounds() const { return upper_; }
  /// All expressions.
  [[nodiscard]] const Graph& graph() const { return graph_; }
  /// The text.
  [[nodiscard]] const SourceText& source() const { return source_; }

  /// Where a solution begins, if the text says so.
  [[nodiscard]] std::optional<double> initial_time() const { return initial_time_; }
  /// Where it ends, if the text says so.
  [[nodiscard]] std::optional<double> final_time() const { return final_time_; }
  /// The times between which all tables have values; infinite without tables.
  [[nodiscard]] std::pair<double, double> times_of_tables() const { return {names_.earliest, names_.latest}; }
  /// The equations and the definitions that are no numbers, in one line.
  [[nodiscard]] const std::string& summary() const { return summary_; }
  /// The initial state, of what the text gives and @p text, which has the precedence: "x=1, x'=0". Its values
  /// are expressions of the definitions.
  /// @param name of @p text in messages: "--initial"
  /// @throws InputError for a value that is missing, given twice, not finite, or of no component
  [[nodiscard]] std::vector<double> initial_state(const std::string& name, const std::string& text);

  /// The components in the order in which @p text of initial_state() names them, if it names all; else in
  /// that of the state.
  [[nodiscard]] std::vector<int> initial_order(const std::string& text) const;

  /// A quantity beside the state.
  struct Column {
    std::string name;  ///< "E", "x''"
    NodeId node;       ///< in graph()
  };
  /// Adds quantities of @p text, definitions or their names and highest derivatives: "E = x'^2/2 + x^2/2; r;
  /// x''".
  /// @throws InputError that points at the mistake, and for a name that a component or an earlier one has
  void read_columns(const std::string& name, const std::string& text, std::vector<Column>& columns);

  /// The value of an expression of numbers and of definitions that are.
  /// @throws InputError that points at the mistake
  [[nodiscard]] double number(const std::string& name, const std::string& text);

  /// An expression of time, state and definitions, "x = 0" being x - 0.
  /// @throws InputError that points at the mistake
  [[nodiscard]] NodeId expression(const std::string& name, const std::string& text);

 private:
  friend class EquationReader;
  [[nodiscard]] NodeId with_highest_derivatives(const LinearForm& form);

  SourceText source_;
  SyntaxTree tree_;
  Graph graph_{0};
  Names names_;
  std::vector<std::string> state_names_;
  std::vector<std::pair<std::string, double>> parameters_;
  std::vector<NodeId> slopes_, conserved_;
  std::vector<double> lower_, upper_;
  std::vector<std::optional<double>> initial_;
  std::optional<double> initial_time_, final_time_;
  std::string summary_;
};

}  // namespace nlmech::program

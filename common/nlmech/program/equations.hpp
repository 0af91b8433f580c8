/// @file
/// Typed equations, solved for the highest derivative of each unknown.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/program/graph.hpp"
#include "nlmech/program/meaning.hpp"
#include "nlmech/program/program.hpp"
#include "nlmech/program/source_text.hpp"
#include "nlmech/program/syntax.hpp"
#include "nlmech/program/variational.hpp"

namespace nlmech::program {

/// Values of definitions from outside the text: `--set a=4`.
using Settings = std::map<std::string, double>;

/// Highest order of a derivative.
inline constexpr int highest_order = 4;
/// Largest number of unknowns.
inline constexpr int most_unknowns = 2000;

/// A system of equations. All methods for initial value problems integrate it through Problem (problem.hpp).
///
/// The state holds all unknowns in the order in which the text names them, then their first derivatives, and
/// so on, without the highest ones. The state of a second-order system is positions, then velocities.
class Equations {
 public:
  /// Reads equations, definitions (`a = 3`, `r = sqrt(x^2 + y^2)`), initial values (``x'(0) = 1``),
  /// conditions (`t <= 10` sets the final time, `x >= 0` holds along every solution that starts with it, `a >
  /// 0` restricts a definition) and conserved quantities (``conserved x'^2 + x^2``).
  /// @param settings replace definitions by numbers, and add definitions that the text omits
  /// @throws InputError with the position of the mistake and what is expected; for a setting that is not
  /// finite, that the text does not name, or that violates a condition
  /// @param read_table reads table("load.csv"); empty: tables are not allowed
  explicit Equations(SourceText source, const Settings& settings = {}, TableReader read_table = {});

  /// Components of the state.
  [[nodiscard]] int size() const { return graph_.size(); }
  /// Is every unknown of second order, so that the state is positions and then velocities?
  [[nodiscard]] bool second_order() const;
  /// "x", "y", "x'", "y'"
  [[nodiscard]] const std::vector<std::string>& state_names() const { return state_names_; }
  /// The unknowns, in the order of the text.
  [[nodiscard]] const std::vector<Unknown>& unknowns() const { return names_.unknowns; }
  /// The definitions that are numbers, with their names.
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& parameters() const { return parameters_; }
  /// The derivative of each component of the state, in graph().
  [[nodiscard]] const std::vector<NodeId>& slopes() const { return slopes_; }
  /// The conserved quantities, in graph().
  [[nodiscard]] const std::vector<NodeId>& conserved() const { return conserved_; }
  /// Lower bound of each component at later times, valid if it is satisfied now; empty: no component has a
  /// bound.
  [[nodiscard]] const std::vector<double>& lower_bounds() const { return lower_; }
  /// Upper bound of each component, likewise.
  [[nodiscard]] const std::vector<double>& upper_bounds() const { return upper_; }
  /// All expressions.
  [[nodiscard]] const Graph& graph() const { return graph_; }
  /// The text.
  [[nodiscard]] const SourceText& source() const { return source_; }

  /// Initial time, if the text gives it.
  [[nodiscard]] std::optional<double> initial_time() const { return initial_time_; }
  /// Final time, if the text gives it.
  [[nodiscard]] std::optional<double> final_time() const { return final_time_; }
  /// The times between which all tables have values; infinite without tables.
  [[nodiscard]] std::pair<double, double> times_of_tables() const { return {names_.earliest, names_.latest}; }
  /// The equations, and the definitions that are not numbers, in one line.
  [[nodiscard]] const std::string& summary() const { return summary_; }
  /// The initial state from the equations and from @p text, which takes precedence: "x=1, x'=0". Values are
  /// expressions of the definitions.
  /// @param name of @p text in messages: "--initial"
  /// @throws InputError for a value that is missing, given twice, not finite, or for an unknown component
  [[nodiscard]] std::vector<double> initial_state(const std::string& name, const std::string& text);

  /// These equations with the derivatives of their solution by some initial values and parameters as further
  /// components, at fixed times and exact to rounding: the variational equations. initial_state() and
  /// initial_order() have these components too. Component x's derivative by a is named dx/da; for an initial
  /// value a is the component's name. Initial values that the text gives as expressions of a parameter
  /// depend on it; a parameter is independent of those it is defined by.
  /// @param name of the option in messages
  /// @param of names of components and of parameters()
  /// @param scale factor on all derivatives
  /// @throws InputError for an unknown name, for one given twice, and for a parameter on which a switching
  /// function, a rounded expression or the initial time depends
  [[nodiscard]] Equations with_sensitivities(const std::string& name, const std::vector<std::string>& of,
                                             double scale = 1) const;
  /// Places of the unknowns and of their sensitivities in the state.
  [[nodiscard]] const VariationalLayout& layout() const { return layout_; }
  /// The state without sensitivities: "x", "x'".
  [[nodiscard]] std::vector<std::string> component_names() const;
  /// The state with its sensitivities from the values @p x of the components alone, which depend on no
  /// parameter.
  [[nodiscard]] std::vector<double> with_initial_sensitivities(const std::vector<double>& x) const;
  /// The state after a change x+ = h(t, x) by an event, at a zero of g: in addition to h, the sensitivities
  /// S+ = h_x S + h_p + (f(x+) - h_t - h_x f) (g_x S + g_p)/(g_t + g_x f). The last term, without which S
  /// would be that at the moving time of the event, is the saltation (M. di Bernardo et al., Piecewise-smooth
  /// Dynamical Systems, 2008, sec. 2.5).
  /// @param name of the option in messages @param event the text of g
  /// @param changes components by their places in the state, with the texts of their new values
  /// @throws InputError that points at the mistake
  [[nodiscard]] Program change_at(const std::string& name, const std::string& event,
                                  const std::vector<std::pair<int, std::string>>& changes) const;

  /// The components in the order of @p text of initial_state() if it names all of them; otherwise in the
  /// order of the state.
  [[nodiscard]] std::vector<int> initial_order(const std::string& text) const;

  /// An output quantity in addition to the state.
  struct Column {
    std::string name;  ///< "E", "x''"
    NodeId node;       ///< in graph()
  };
  /// Adds the quantities of @p text (definitions, names of definitions, highest derivatives): "E = x'^2/2 +
  /// x^2/2; r; x''".
  /// @throws InputError with the position of the mistake, and for a name that is already used
  void read_columns(const std::string& name, const std::string& text, std::vector<Column>& columns);

  /// The value of an expression of numbers and of definitions that are numbers.
  /// @throws InputError that points at the mistake
  [[nodiscard]] double number(const std::string& name, const std::string& text);

  /// An expression of time, state and definitions; "x = 0" is x - 0.
  /// @throws InputError that points at the mistake
  [[nodiscard]] NodeId expression(const std::string& name, const std::string& text);

 private:
  friend class EquationReader;
  /// Columns of with_sensitivities().
  struct Sensitivities;
  /// Value of a component of the initial state, if it is given.
  using InitialNodes = std::vector<std::optional<NodeId>>;

  // Reads the text of `from` again, with parameters as variables of the graph that follow the state.
  Equations(const Equations& from, const std::vector<std::string>& variables);
  [[nodiscard]] InitialNodes initial_nodes(const std::string& name, const std::string& text);
  [[nodiscard]] std::vector<double> with_sensitivities_of(const std::vector<double>& x,
                                                          const std::string& name,
                                                          const std::string& text) const;
  [[nodiscard]] NodeId with_highest_derivatives(const LinearForm& form);

  SourceText source_;
  SyntaxTree tree_;
  Graph graph_{0};
  Names names_;
  std::vector<std::string> state_names_;
  std::vector<std::pair<std::string, double>> parameters_;
  std::vector<NodeId> slopes_, conserved_;
  std::vector<double> lower_, upper_;
  InitialNodes initial_;
  std::optional<double> initial_time_, final_time_;
  std::string summary_;
  Settings settings_;
  std::vector<std::string> variables_;  // parameters that are variables of the graph
  VariationalLayout layout_{0};
  std::shared_ptr<const Sensitivities> sensitivities_;
};

}  // namespace nlmech::program

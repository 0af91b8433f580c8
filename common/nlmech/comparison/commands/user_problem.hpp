/// @file
/// Problems of the commands: library problems by name and equations typed by a user.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/comparison/reference/reference_of.hpp"
#include "nlmech/ivp/domain.hpp"
#include "nlmech/ivp/events.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"
#include "nlmech/program/switches.hpp"

namespace nlmech::comparison {

/// A function of time and state.
using StateFunction = std::function<double(double t, const ivp::State& x)>;

/// A line of a text of equations with an event and its changes of the state.
struct EventLine {
  std::string event;    ///< "x = 0 falling"
  std::string changes;  ///< "x' = -0.8 x'; n = n + 1"; may be empty
};

/// Quantities that are printed after the state.
struct Columns {
  std::vector<std::string> names;  ///< "E", "x''"
  program::Program values;         ///< their values, in this order, as functions of time and state
  /// The switches of equations that switch, with the columns as further expressions; else null.
  std::shared_ptr<const program::Switches> switches = {};
};

/// Equations with the values of their parameters.
struct UserProblem {
  std::string name;                                        ///< "three-dof"; "the equation" of a user
  std::string equation;                                    ///< summary of the equations as text
  std::vector<std::pair<std::string, double>> parameters;  ///< names and values of the parameters
  /// Names of the components, also of their columns: "x1", "x1'", "dx1/da".
  std::vector<std::string> state_names;
  double t0 = 0;             ///< initial time of the text; 0 if the text has none
  std::optional<double> t1;  ///< end time of the text, if it has one
  ivp::System system;        ///< equations for the integrators
  /// Computations in extended precision for references; may be none.
  std::function<std::vector<Candidate>(const WorkLimit&)> extended;
  std::shared_ptr<const ivp::Domain> domain = {};  ///< domain of the equations
  program::Equations text;                         ///< parsed equations
  std::vector<EventLine> event_lines = {};         ///< event lines of the text
  /// With sensitivities that the tolerances do not control: the equations for controlled_by_solution().
  std::optional<ivp::System> scaled = {};

  /// Initial state from numbers in the order of the state, or from expressions for some components, "x=1,
  /// x'=pi/2"; other components have their values of the text.
  /// @throws InputError naming `--initial` that points at the mistake or says how many numbers are required
  [[nodiscard]] ivp::State initial_state(const std::string& typed) const;
  /// Indices of the components in the order of printing: the order of the typed initial state if it names all
  /// components, else that of the state.
  [[nodiscard]] std::vector<int> printed_order(const std::string& typed) const {
    return text.initial_order(typed);
  }
  /// Parses columns: "E = x'^2/2 + x^2/2; r; x''". @throws InputError naming `--columns` that points at the
  /// mistake
  [[nodiscard]] Columns columns(const std::vector<std::string>& typed) const;
  /// Value of a number or of an expression of numbers and constant definitions.
  /// @param option option named in messages @throws InputError for anything else
  [[nodiscard]] double number(const std::string& option, const std::string& typed) const;
  /// Function of an expression of time and components; "x = 0" is x - 0.
  /// @param option option named in messages @throws InputError that points at the mistake
  [[nodiscard]] StateFunction expression(const std::string& option, const std::string& typed) const;
  /// Event, with bounds, at the zeros of an expression in both directions, without changes of the state.
  [[nodiscard]] ivp::Event event(const std::string& option, const std::string& typed) const;
};

/// Makes a problem with the given parameters; the others have their values of the text.
/// @throws std::invalid_argument or InputError naming the parameter that is unknown or out of range
using MakeProblem = std::function<UserProblem(const program::Settings&)>;

/// Problem of a text of equations. @param name name of the problem
/// @throws InputError that points at a mistake in the text
/// @param read_table reader of the tables that the text names
[[nodiscard]] UserProblem typed_problem(const program::SourceText& source, const program::Settings& settings,
                                        std::string_view name = "the equation",
                                        const program::TableReader& read_table = {});

/// The problem with sensitivities as further components.
/// @param typed names of initial values and parameters, separated by commas; all: all initial values
/// @param controlled do the tolerances control the errors of the sensitivities?
/// @throws InputError naming `--sensitivities` and the name
[[nodiscard]] UserProblem with_sensitivities(const UserProblem& problem, const std::string& typed,
                                             bool controlled);

/// Reader of tables in files of @p folder: two columns, time and value, with or without a header. It reads
/// each file once.
[[nodiscard]] program::TableReader table_reader(const std::filesystem::path& folder);

/// Text of a file of equations; - is standard input.
/// @throws InputError naming `--file` for a device, an unreadable file, or one of more than
/// program::most_bytes
[[nodiscard]] std::string read_equations(const std::string& name);

/// Parses texts "name=value". @throws InputError naming `--set` and the text, or both texts of a name that is
/// set twice
[[nodiscard]] program::Settings settings_of(const std::vector<std::string>& assignments);

/// The library problem of that name. @throws InputError naming `--problem`, the name, and the known ones
[[nodiscard]] MakeProblem library_problem(const std::string& name);

/// Help text of the library problems: equation, parameters with their values, and components of each.
[[nodiscard]] std::string describe_problems();

}  // namespace nlmech::comparison

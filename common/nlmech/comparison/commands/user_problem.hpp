/// @file
/// A problem as commands see it: one of the library by name, or equations that a user types.
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

namespace nlmech::comparison {

/// A function of time and state.
using StateFunction = std::function<double(double t, const ivp::State& x)>;

/// A line of a text that says what happens at an event.
struct EventLine {
  std::string event;    ///< "x = 0 falling"
  std::string changes;  ///< "x' = -0.8 x'; n = n + 1"; may be empty
};

/// Quantities that are printed beside the state.
struct Columns {
  std::vector<std::string> names;  ///< "E", "x''"
  program::Program values;         ///< in this order, of time and state
};

/// Equations with the values of their parameters, and what commands ask of them.
struct UserProblem {
  std::string name;                                        ///< "three-dof"; "the equation" of a user
  std::string equation;                                    ///< as text, and which letter is which parameter
  std::vector<std::pair<std::string, double>> parameters;  ///< their names and values
  std::vector<std::string> state_names;  ///< columns: "x1", ..., "v1", ..., or the problem's own
  double t0 = 0;                         ///< where the publication or the text begins
  std::optional<double> t1;              ///< where the text ends, if it says so
  ivp::System system;                    ///< what methods run on
  /// Computations in extended precision, for references; may be none.
  std::function<std::vector<Candidate>(const WorkLimit&)> extended;
  std::shared_ptr<const ivp::Domain> domain = {};  ///< where the equations hold
  program::Equations text;                         ///< as they were read
  std::vector<EventLine> event_lines = {};         ///< of the text

  /// The initial state as typed: numbers in the order of the state, or "x1=1, v1=pi/2" for some of them, by
  /// expressions; what the publication or the text says for what is not given.
  /// @throws InputError naming `--initial` that points at the mistake, or says how many numbers there must be
  [[nodiscard]] ivp::State initial_state(const std::string& typed) const;
  /// Components in the order in which they are printed: that in which the initial state as typed names them,
  /// if it names all, else that of the state.
  [[nodiscard]] std::vector<int> printed_order(const std::string& typed) const {
    return text.initial_order(typed);
  }
  /// Columns as typed: "E = x'^2/2 + x^2/2; r; x''". @throws InputError naming `--columns` that points at the
  /// mistake
  [[nodiscard]] Columns columns(const std::vector<std::string>& typed) const;
  /// A number as typed, or an expression of numbers and of definitions that are.
  /// @param option named by messages @throws InputError for anything else
  [[nodiscard]] double number(const std::string& option, const std::string& typed) const;
  /// An expression of time and components, "x = 0" being x - 0.
  /// @param option named by messages @throws InputError that points at the mistake
  [[nodiscard]] StateFunction expression(const std::string& option, const std::string& typed) const;
  /// The same as an event, with bounds on it: every zero counts, and nothing changes there.
  [[nodiscard]] ivp::Event event(const std::string& option, const std::string& typed) const;
};

/// Makes a problem with these parameters, all others as they are in the publication or the text.
/// @throws std::invalid_argument or InputError naming the parameter that is unknown or out of range
using MakeProblem = std::function<UserProblem(const program::Settings&)>;

/// Equations that are a text. @param name in lists of problems
/// @throws InputError that points at a mistake in the text
/// @param read_table for tables in the text
[[nodiscard]] UserProblem typed_problem(const program::SourceText& source, const program::Settings& settings,
                                        std::string_view name = "the equation",
                                        const program::TableReader& read_table = {});

/// Reads tables of files in @p folder, each once: two columns, time and value, with or without a header.
[[nodiscard]] program::TableReader table_reader(const std::filesystem::path& folder);

/// The text of a file of equations; - is standard input.
/// @throws InputError naming `--file` for a device, a file that cannot be read, or one that nobody has typed
[[nodiscard]] std::string read_equations(const std::string& name);

/// Texts "name=value" as values by name. @throws InputError naming `--set` and the text; for a name that is
/// set twice, both texts
[[nodiscard]] program::Settings settings_of(const std::vector<std::string>& assignments);

/// The problem of the library of that name. @throws InputError naming `--problem`, the name, and the known
/// ones
[[nodiscard]] MakeProblem library_problem(const std::string& name);

/// For the help: each problem of the library with its equation, its parameters and their values.
[[nodiscard]] std::string describe_problems();

}  // namespace nlmech::comparison

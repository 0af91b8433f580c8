/// @file
/// Options of a run: as typed, and checked.
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/commands/typed_events.hpp"
#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::comparison {

/// Options of `integrate`, `compare` and `choose` as typed.
struct TypedOptions {
  std::string problem;                 ///< `--problem`
  std::string equation;                ///< `--equation`
  std::string file;                    ///< `--file`
  std::string initial;                 ///< `--initial`
  std::string method;                  ///< `--method`, `--methods`
  std::string tolerances;              ///< `--tolerances`
  std::string plot;                    ///< `--plot`
  std::string until;                   ///< `--until`
  std::string from;                    ///< `--from`
  std::string every;                   ///< `--every`
  std::string at;                      ///< `--at`
  std::string step;                    ///< `--step`
  ivp::Settings settings;              ///< `--tolerance` and the other settings of methods, without `--step`
  std::optional<double> limit;         ///< `--limit`, s
  std::optional<double> largest_step;  ///< `--largest-step`
  std::vector<std::string> set;        ///< `--set`, each
  std::vector<std::string> events;     ///< `--event`, each
  std::vector<std::string> changes;    ///< `--set-at`, each
  std::string section;                 ///< `--section`
  std::vector<std::string> columns;    ///< `--columns`, each
  std::string sensitivities;           ///< `--sensitivities`
  bool control_sensitivities = false;  ///< `--control-sensitivities`
  std::string states;                  ///< `--states`, a file
  std::optional<int> threads;          ///< `--threads`
  bool no_verify = false;              ///< `--no-verify`
  int digits = 9;                      ///< `--digits`
};

/// Checked options of a run. run_options() makes them; other functions do not check them again.
struct RunOptions {
  ivp::State x0;                     ///< initial state
  double t0 = 0;                     ///< start
  double t1 = 0;                     ///< end
  ivp::Settings settings;            ///< settings of the method
  std::optional<double> every = {};  ///< time between rows; nothing: only first and last row
  std::vector<double> at = {};       ///< times of further rows, ascending
  std::pair<double, double> tables = {-std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};  ///< time span of the tables
  std::vector<int> order = {};           ///< components in the order of printing
  Columns columns = {};                  ///< columns after the components
  ivp::Limits limits;                    ///< limits of the run with its verification
  std::vector<WantedEvent> events = {};  ///< events; each occurrence makes a row
  bool section = false;                  ///< print only the rows of events
  bool verify = false;                   ///< compare the run with a reference: for runs by a tolerance
  bool draw = false;                     ///< keep samples for a figure
  /// Called with the time after each step, by the thread of the run, and with the end (a comparison: with the
  /// start) during the computation of a reference; false ends both: interrupted. May be empty.
  std::function<bool(double t)> reached = {};
  /// Common deadline of many runs and their verifications.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();

  /// Checks the times of the rows. @throws InputError naming `--every` for more than ten million rows, `--at`
  /// for a time outside the run, and `--until` for a run beyond the tables of the equations
  void check_rows() const;

  /// Applies changes of the state by events at the start to x0. @throws InputError naming `--until` for a run
  /// backwards with events that change the state
  void start_with_changes();
};

/// Result of @p work. @throws InputError with the name of the option instead of a std::invalid_argument
template <class Work>
decltype(auto) about(const char* option, Work work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw InputError(std::string(option) + ": " + error.what());
  }
}

/// The library problem or the equations of `--equation` or of a file, which is read once. Parameters that the
/// caller does not give have their values of `--set`.
/// @throws InputError naming the option
[[nodiscard]] MakeProblem problem_of(const TypedOptions& typed);

/// Checks the typed options. @param x0 initial state @throws InputError naming the invalid option
[[nodiscard]] RunOptions run_options(const TypedOptions& typed, const UserProblem& problem, ivp::State x0);

/// The method of one run or of many with the same settings: that of `--method`, else default_method().
/// @throws InputError naming the invalid option
[[nodiscard]] const ivp::MethodInfo& method_of(const TypedOptions& typed, const UserProblem& problem,
                                               const RunOptions& options);

}  // namespace nlmech::comparison

/// @file
/// What a user asks of runs: as typed, and as runs take it.
#pragma once

#include <chrono>
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

/// What was typed after `integrate`, `compare` or `choose`.
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
  ivp::Settings settings;              ///< `--tolerance` and what else methods have, without `--step`
  std::optional<double> limit;         ///< `--limit`, s
  std::optional<double> largest_step;  ///< `--largest-step`
  std::vector<std::string> set;        ///< `--set`, each
  std::vector<std::string> events;     ///< `--event`, each
  std::vector<std::string> changes;    ///< `--set-at`, each
  std::string section;                 ///< `--section`
  std::vector<std::string> columns;    ///< `--columns`, each
  std::string states;                  ///< `--states`, a file
  std::optional<int> threads;          ///< `--threads`
  bool no_verify = false;              ///< `--no-verify`
  int digits = 9;                      ///< `--digits`
};

/// A run of a problem. Made and checked once, of what was typed: what is behind it takes it as right.
struct RunOptions {
  ivp::State x0;                     ///< initial state
  double t0 = 0;                     ///< start
  double t1 = 0;                     ///< end
  ivp::Settings settings;            ///< of the method
  std::optional<double> every = {};  ///< distance of the rows in time; nothing: first and last alone
  std::vector<double> at = {};       ///< times of further rows, ascending
  std::pair<double, double> tables = {-std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};  ///< times that they have
  std::vector<int> order = {};           ///< components as they are printed
  Columns columns = {};                  ///< behind them
  ivp::Limits limits;                    ///< when to give up, all in all
  std::vector<WantedEvent> events = {};  ///< a row each time one takes place
  bool section = false;                  ///< rows of events alone
  bool verify = false;                   ///< compare the run with a reference: for runs by a tolerance
  bool draw = false;                     ///< keep what a picture shows
  /// Of many runs: when all of them are to be over, their verifications too.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();

  /// @throws InputError naming `--every` for more rows than anybody reads: ten million; naming `--at` for a
  /// time that is not within the run
  void check_rows() const;
};

/// Complaints about a method, under the name of the option that named it.
template <class Work>
decltype(auto) about(const char* option, Work work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw InputError(std::string(option) + ": " + error.what());
  }
}

/// The problem by name, or the equations that were typed or stand in a file, which is read once; with the
/// parameters of `--set` for those that are not given.
/// @throws InputError naming the option
[[nodiscard]] MakeProblem problem_of(const TypedOptions& typed);

/// @param x0 initial state @throws InputError naming the option that cannot be meant
[[nodiscard]] RunOptions run_options(const TypedOptions& typed, const UserProblem& problem, ivp::State x0);

/// The method of one run, or of many with the same settings: the one that was typed, or else the usual one.
/// @throws InputError naming the option that cannot be meant
[[nodiscard]] const ivp::MethodInfo& method_of(const TypedOptions& typed, const UserProblem& problem,
                                               const RunOptions& options);

}  // namespace nlmech::comparison

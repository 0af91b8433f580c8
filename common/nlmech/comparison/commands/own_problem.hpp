/// @file
/// A problem that a user names on the command line, with parameters and initial state of his own.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/choice/choice.hpp"
#include "nlmech/comparison/commands/seen.hpp"
#include "nlmech/comparison/cost/curve.hpp"
#include "nlmech/ivp/events.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// Complaints about a method, under the name of the option that named it.
template <class Work>
auto about(const char* option, Work work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw InputError(std::string(option) + ": " + error.what());
  }
}

/// A function of time and state.
using StateFunction = std::function<double(double t, const double* x)>;

/// What a run is to look out for.
struct WantedEvent {
  std::string text;                                ///< as typed
  StateFunction value;                             ///< whose zero it is
  ivp::Crossing crossing = ivp::Crossing::either;  ///< which passages count
  bool ends = false;                               ///< is the run over at the first of them?
};

/// An expression of equations as a function. @throws InputError that points at the mistake
[[nodiscard]] StateFunction state_function(program::Equations equations, const std::string& option,
                                           const std::string& text);

/// What a user asks of a problem.
struct Request {
  std::vector<double> x0;                ///< initial state
  double t0 = 0;                         ///< begin
  double t1 = 0;                         ///< end
  ivp::Settings settings;                ///< of the method
  std::optional<double> every;           ///< distance of the rows in time; nothing: first and last alone
  ivp::Limits limits;                    ///< when to give up, all in all
  std::vector<WantedEvent> events = {};  ///< a row each time one takes place
  bool section = false;                  ///< rows of events alone
  bool verify = false;                   ///< hold the run to a reference: for runs by a tolerance
  bool draw = false;                     ///< keep what a picture shows
  /// Of many runs: when all of them are to be over, their verifications too.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

/// @throws InputError naming `--every` for more rows than anybody reads: ten million
void check_rows(const Request& request);

/// A run as it is printed.
struct Trajectory {
  std::string rows;      ///< CSV
  std::string remark;    ///< of its verification, for standard error; may be empty
  bool is_open = false;  ///< was it to be verified, and could it not be?
  Seen seen;             ///< for a picture, if Request::draw
};

class OwnProblem;

/// One of many runs, as it is asked for.
struct Posed {
  const OwnProblem* problem;  ///< of the kind of all others; may be the same for many
  Request request;            ///< of its run
};

/// One of many runs, as it has ended.
struct Ended {
  Status status;          ///< a failure, whose run has no rows, leaves the others alone
  Trajectory trajectory;  ///< of a success
};

/// Methods side by side.
struct Comparison {
  std::string rows;           ///< CSV
  std::vector<Curve> curves;  ///< the same by method, for a picture
};

/// A method of a list, with those of the settings that it has.
struct Choice {
  AnyMethod method;        ///< which
  ivp::Settings settings;  ///< how

  /// "step 0.5 nodes 7"
  [[nodiscard]] std::string setting() const;
};

/// One problem behind one interface, whatever its dimension.
class OwnProblem {
 public:
  OwnProblem() = default;
  OwnProblem(const OwnProblem&) = delete;
  OwnProblem& operator=(const OwnProblem&) = delete;
  virtual ~OwnProblem() = default;

  /// As on the command line: "three-dof".
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Names and values of its parameters.
  [[nodiscard]] virtual std::vector<std::pair<std::string, double>> parameters() const = 0;
  /// @throws std::invalid_argument listing the known names, if there is none of that name
  virtual void set_parameter(std::string_view parameter, double value) = 0;
  /// Column names: "x1", ..., "v1", ..., or the problem's own.
  [[nodiscard]] virtual std::vector<std::string> state_names() const = 0;
  /// The publication's.
  [[nodiscard]] virtual std::vector<double> initial_state() const = 0;
  /// The initial state as typed: numbers in the order of the state, or "x1=1, v1=pi/2" for some of them, by
  /// expressions; the publication's for what is not given.
  /// @throws InputError naming `--initial` that points at the mistake, or says how many numbers there must be
  [[nodiscard]] virtual std::vector<double> initial_state(const std::string& text) const;
  /// Where the publication begins.
  [[nodiscard]] virtual double initial_time() const = 0;
  /// Where the text ends, if it is one that says so.
  [[nodiscard]] virtual std::optional<double> final_time() const { return {}; }
  /// The equation in text, and which letter is which parameter.
  [[nodiscard]] virtual std::string_view equation() const = 0;
  /// An expression of time and components, "x = 0" being x - 0. @throws InputError that points at the mistake
  [[nodiscard]] virtual StateFunction expression(const std::string& option, const std::string& text) const;
  /// The method that is taken where none is named: what method_for() says for the tolerance,
  /// among those that have the settings, and, for rows and events on the way, values there as exact as at the
  /// end. `series` where the problem ends before its end, and for a step.
  [[nodiscard]] virtual std::string usual_method(const Request& request) const = 0;
  /// Which method for @p digits at the end; Request::settings may have an absolute tolerance. See choose().
  [[nodiscard]] virtual Chosen chosen(const Request& request, double digits) const = 0;
  /// The methods that are compared where none is named: those of ours that suit the problem, and of each kind
  /// of peers the best that this build has. With Request::settings.step, those of ours that take one.
  [[nodiscard]] virtual std::vector<std::string> usual_methods(const Request& request) const = 0;
  /// Rows `t,...` as CSV: the first, those at Request::every and at events, and the last at t1 exactly, or at
  /// the event that ends the run. With events a last column, `event`, has the text of each.
  /// @throws Failure if the method fails or is wrong, InputError naming `--method` for settings that cannot
  /// be meant
  [[nodiscard]] virtual Trajectory trajectory(const Request& request, const AnyMethod& method) const = 0;
  /// The same for many runs of problems of this kind, side by side where the method can; what trajectory()
  /// throws as Failure is their status. @param threads how many; 0: one a processor
  [[nodiscard]] virtual std::vector<Ended> trajectories(std::span<const Posed> posed, const AnyMethod& method,
                                                        int threads) const = 0;
  /// Rows as ComparisonTable makes them. Methods that fail, and those that are not for the problem or the
  /// settings, keep their row and say why, also on standard error after the name of the @p program. Wall time
  /// is shared: each method gets its part of what those before it have left.
  /// @throws InputError naming `--methods` if none of the methods is for the problem and the settings
  [[nodiscard]] virtual Comparison comparison(const Request& request, const std::vector<Choice>& methods,
                                              std::string_view program) const = 0;
};

/// How to make each of the problems that a program offers.
using OwnProblems = std::vector<std::function<std::unique_ptr<OwnProblem>()>>;

/// The problem of that name.
/// @throws InputError naming `--problem`, the name, and the known ones
[[nodiscard]] std::unique_ptr<OwnProblem> problem_by_name(const OwnProblems& all, const std::string& name);

/// Applies texts "name=value". @throws InputError naming `--set`, the text, and the known parameters; for a
/// parameter that is set twice, both texts
void apply_settings(OwnProblem& problem, const std::vector<std::string>& assignments);

/// Texts "name=value" as values by name. @throws InputError naming `--set` and the text; for a name that is
/// set twice, both texts
[[nodiscard]] std::map<std::string, double> settings_of(const std::vector<std::string>& assignments);

/// For the help: each problem with its equation, its parameters and their values.
[[nodiscard]] std::string describe_problems(const OwnProblems& all);

}  // namespace nlmech::comparison

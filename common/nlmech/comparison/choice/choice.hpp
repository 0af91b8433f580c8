/// @file
/// Choice of a method for an initial value problem: the first matching rule of a list, by features that are
/// found before the problem is solved.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// A problem for which a method is to be chosen.
struct ChoiceRequest {
  ivp::System system;                                             ///< equations
  ivp::State x0;                                                  ///< state at t0
  double t0;                                                      ///< start
  double t1;                                                      ///< end
  double absolute = 1;                                            ///< absolute over relative tolerance
  std::vector<std::string> methods = {};                          ///< methods to choose from; empty: all
  double largest_step = std::numeric_limits<double>::infinity();  ///< bound on the step size

  /// Limits of a short run. @param steps for one component; divided by their number, but at least 50
  [[nodiscard]] ivp::Limits limits(std::int64_t steps) const;
};

/// Does f depend on the time, or on a component with a constant rate? Decided by the recorded equations; if
/// the problem cannot be recorded, by df/dt at (t, x), and true without df/dt.
[[nodiscard]] bool depends_on_time(const ivp::System& system, double t, const ivp::State& x);

/// Features of a problem: counts and ratios, so that they are reproducible unless the time limit of the probe
/// (2 s) ends it early.
struct Features {
  bool velocity_free = false;  ///< the equations are q'' = a(t, q)
  bool switches = false;       ///< abs, sign, min or max of the state decide which equations hold
  int operations = 0;  ///< operations of one right-hand side, as recorded for Taylor series; 0: not recorded
  double stiffness = 0;  ///< mean of |h| rho over coarse steps h of an implicit method, rho the spectral
                         ///< radius of the Jacobian: about 1 where accuracy limits the step size, more where
                         ///< stability would limit that of an explicit method
};

/// Result of probe_problem().
struct Probe {
  Features features;  ///< its stiffness is that of the steps taken
  Status status;      ///< a failure: the solution ends before t1, or the implicit method fails
};

/// Finds the features of a problem, its stiffness by at most 400 coarse steps of `adaptive-collocation`: a
/// few milliseconds for few components.
[[nodiscard]] Probe probe_problem(const ChoiceRequest& request);

/// A rule of the list.
struct Rule {
  std::string_view name;                            ///< "stiff"
  std::string_view reason;                          ///< why its methods suit, as a clause
  bool (*holds)(const Features& f, double digits);  ///< condition on the features and the digits at t1
  std::array<std::string_view, 4> methods;          ///< best first; unused entries are empty
};

/// Features::stiffness from which stability limits the steps of explicit methods. The stability limit of
/// `dop853` is |h| rho near 6, and its steps for nine digits are 5.6 times smaller than those of the probe.
inline constexpr double stiff_from = 30;
/// Features::operations up to which `series` is cheaper than `dop853`: the ratio of the step sizes exceeds
/// the ratio of the costs of a step.
inline constexpr int most_operations = 13;
/// Digits from which `series` is cheaper whatever the operations: order 8 of `dop853` is too low.
inline constexpr double many_digits = 11;

/// All rules in order; the last one always holds.
[[nodiscard]] std::span<const Rule> choice_rules();
/// The first rule that holds.
[[nodiscard]] const Rule& choice_rule(const Features& features, double digits);

/// One method of a ranking.
struct Ranked {
  std::string method;           ///< name of the method
  double tolerance = 0;         ///< relative tolerance; times ChoiceRequest::absolute: the absolute one
  double covered = 0;           ///< share of the interval of integration that the short run covered
  double seconds = 0;           ///< estimate for the whole interval, from the short run
  double right_hand_sides = 0;  ///< estimate for the whole interval, from the short run
};

/// Error growth of a problem.
struct ErrorGrowth {
  double factor = 1;   ///< error relative to the size of a component, for an earlier error of weight
                       ///< absolute + relative, in units of the relative tolerance
  double covered = 0;  ///< share of the interval on which it was found, from 0 to 1; 0: unknown
};

/// Ranking of the methods for a number of digits at t1.
struct MethodChoice {
  Status status;                    ///< a failure: the problem, or every method on it, ends before t1
  Features features;                ///< features of the problem
  double digits = 9;                ///< requested digits at t1
  ErrorGrowth growth;               ///< error growth; ErrorGrowth::covered is 0 if it is unknown
  double condition = 1;             ///< condition number: factor of the growth over its covered share
  double possible = 15;             ///< digits attainable in view of rounding
  double missing = 0;               ///< digits by which the tightest tolerance, 1e-13, falls short
  double right_hand_side = 0;       ///< seconds of one right-hand side
  std::vector<Ranked> ranked = {};  ///< best first
};

/// Name of the method for runs at @p tolerance: the first allowed method of the rule that does not fail in a
/// short run; empty if there is none.
[[nodiscard]] std::string method_for(const ChoiceRequest& request, double tolerance);

/// Finds the features of the problem and its error growth.
/// @returns a MethodChoice without the members that depend on the digits; its status is a failure if the
/// solution ends early
[[nodiscard]] MethodChoice examine(const ChoiceRequest& request);

/// Ranks the methods of the rule for @p digits at t1 after a short run of each. Times do not affect the
/// order, so that it is reproducible.
/// @param examined result of examine() for the same request
[[nodiscard]] MethodChoice choose(const ChoiceRequest& request, double digits, MethodChoice examined);

/// Rows `rank,method,tolerance,seconds,reason` as CSV.
/// @throws Failure with the reason if there is no method to choose
[[nodiscard]] std::string choice_rows(const MethodChoice& chosen);

/// Remark for standard error if rounding and error growth rule out the requested digits; else empty.
[[nodiscard]] std::string choice_remark(const MethodChoice& chosen);

/// Words as one command line of a shell, quoted where necessary.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

/// A text as a quoted CSV cell.
[[nodiscard]] std::string quoted_cell(std::string_view text);

}  // namespace nlmech::comparison

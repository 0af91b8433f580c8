/// @file
/// Which method for an initial value problem: a list of rules on features that are found before it is solved.
/// The first that holds decides.
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
  std::vector<std::string> methods = {};                          ///< that may be chosen; empty: all
  double largest_step = std::numeric_limits<double>::infinity();  ///< bound on the steps

  /// Limits of a short run. @param steps with one component; fewer with more, at least 50
  [[nodiscard]] ivp::Limits limits(std::int64_t steps) const;
};

/// Does f depend on the time, or on a component that moves at a constant rate? By the recorded equations; of
/// a problem that cannot be recorded by df/dt at (t, x), and true where it has none.
[[nodiscard]] bool depends_on_time(const ivp::System& system, double t, const ivp::State& x);

/// The features of a problem. They are counts and ratios: found twice, they are the same, unless half a
/// second cuts the probe short.
struct Features {
  bool velocity_free = false;  ///< the equations are q'' = a(t, q)
  bool switches = false;       ///< abs, sign, min or max of the state decide which equations hold
  int operations = 0;    ///< of one right-hand side, as recorded for Taylor series; 0: it cannot be recorded
  double stiffness = 0;  ///< mean of |h| rho over coarse steps h of an implicit method, rho the greatest
                         ///< modulus of an eigenvalue of the Jacobian: about 1 where accuracy bounds the
                         ///< steps, more where stability would bound those of an explicit method
};

/// The features, or why there are none.
struct Probe {
  Features features;  ///< as far as the steps went
  Status status;      ///< a failure: the solution ends before t1, or the implicit method fails
};

/// Finds the features by some coarse steps of `adaptive-collocation`, at most so many that they take a few
/// milliseconds with few components.
[[nodiscard]] Probe probe_problem(const ChoiceRequest& request);

/// A rule of the list.
struct Rule {
  std::string_view name;                            ///< "stiff"
  std::string_view reason;                          ///< why its methods, in a clause
  bool (*holds)(const Features& f, double digits);  ///< for that many digits at t1
  std::array<std::string_view, 4> methods;          ///< the best first; some may be empty
};

/// Features::stiffness from which stability bounds the steps of explicit methods. Those of `dop853` end near
/// 6, and its steps for nine digits are 5.6 times shorter than the coarse ones of the probe.
inline constexpr double stiff_from = 30;
/// Of a right-hand side: with more operations a step of `series` costs more than it is longer than that of
/// `dop853`.
inline constexpr int most_operations = 13;
/// From so many digits on the order 8 of `dop853` is too low for that.
inline constexpr double many_digits = 11;

/// The list; its last rule always holds.
[[nodiscard]] std::span<const Rule> choice_rules();
/// The first that holds.
[[nodiscard]] const Rule& choice_rule(const Features& features, double digits);

/// A method of a choice, in the order of preference.
struct Ranked {
  std::string method;           ///< its name
  double tolerance = 0;         ///< relative; absolute in the ratio that was asked for
  double covered = 0;           ///< share of the interval of its short run
  double seconds = 0;           ///< of the whole interval, by the short run
  double right_hand_sides = 0;  ///< of the whole interval, by the short run
};

/// What a problem makes of errors.
struct ErrorGrowth {
  double factor = 1;   ///< from one tolerance, absolute + relative, to the error by the size of a component
  double covered = 0;  ///< the share of the interval that it was found on, from 0 to 1; 0: it is not known
};

/// An answer to the question which method gives so many digits.
struct MethodChoice {
  Status status;                    ///< a failure: the problem, or every method on it, ends before t1
  Features features;                ///< of the problem
  double digits = 9;                ///< asked for at t1
  ErrorGrowth growth;               ///< of errors; ErrorGrowth::covered is 0 if it is not known
  double condition = 1;             ///< of the whole interval: the factor of the growth, or more
  double possible = 15;             ///< digits that rounding leaves
  double missing = 0;               ///< digits by which the tightest tolerance, 1e-13, falls short
  double right_hand_side = 0;       ///< s of one
  std::vector<Ranked> ranked = {};  ///< the best first
};

/// The method for runs by @p tolerance: the first of the rule's that may be chosen and does not fail in a
/// short run; empty if there is none.
[[nodiscard]] std::string method_for(const ChoiceRequest& request, double tolerance);

/// Finds the features of the problem and the growth of errors.
/// @returns all of MethodChoice but what depends on the digits; its status is a failure if the solution ends
/// early
[[nodiscard]] MethodChoice examine(const ChoiceRequest& request);

/// Ranks the methods of the rule for @p digits at t1, each by a short run. Times decide nothing: asked twice,
/// it gives the same order.
/// @param examined of examine(), for the same request
[[nodiscard]] MethodChoice choose(const ChoiceRequest& request, double digits, MethodChoice examined);

/// Rows `rank,method,tolerance,seconds,reason` as CSV.
/// @throws Failure if there is nothing to choose from, with the reason
[[nodiscard]] std::string choice_rows(const MethodChoice& chosen);

/// A remark beside the rows: digits that the problem does not give; empty if there are none.
[[nodiscard]] std::string choice_remark(const MethodChoice& chosen);

/// Words as they are typed to a shell.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& words);

/// A text as a cell of CSV, in quotes.
[[nodiscard]] std::string quoted_cell(std::string_view text);

}  // namespace nlmech::comparison

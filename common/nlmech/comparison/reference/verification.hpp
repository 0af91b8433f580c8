/// @file
/// A run verified by integration: its states beside a reference, measured in tolerances and by what the
/// problem makes of them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/comparison/reference/reference.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::comparison {

/// The tolerances of a run by its settings.
[[nodiscard]] Tolerance tolerance_of(const ivp::Settings& settings);

/// A component is right without a remark if it is off by no more than so many tolerances: steps are many, and
/// their errors add up. Well made methods stay below twenty over some ten periods of an oscillator, multistep
/// methods below a hundred; methods that underrate the errors of their steps do not (tests/comparison).
inline constexpr double most_tolerances = 100;
/// A run with fewer digits than are enough is right if it is off by no more than so many times what the
/// problem makes of a single error of one tolerance on the way.
inline constexpr double most_amplified = 10;

/// The digits with which a run is printed, whatever the problem makes of errors: half of those that its
/// relative tolerance asks for, and three at least.
[[nodiscard]] double enough_digits(double tolerance);

/// What came out.
struct Verification {
  /// How it ended.
  enum class Verdict {
    right,    ///< within most_tolerances
    inexact,  ///< beyond them, but with enough_digits() or within most_amplified of what the problem makes
              ///< of one tolerance
    wrong,    ///< none of these
    undetermined,  ///< the problem multiplies one tolerance to the size of the solution: no digit is
                   ///< determined
    ended,         ///< the solution seems to end on the way, and the run to have jumped across: see reason
    unknown        ///< there is no reference that could tell: see reason
  };
  Verdict verdict = Verdict::unknown;  ///< how it ended
  double t = 0;                        ///< where the run has the fewest digits; of a wrong one where it is
                                       ///< furthest off, compared with what is allowed
  int component = 0;                   ///< and in which component, from 0
  double error = 0;                    ///< how far off it is there
  double uncertainty = 0;              ///< how far off the reference may be
  double tolerances = 0;               ///< the same in tolerances
  double allowed = most_tolerances;    ///< how many of them are let pass there
  double growth = 1;                   ///< how much one tolerance grows up to there; 0: not known
  double digits = 0;        ///< of the component there, at least: by its error and the uncertainty,
                            ///< relative to it or, where it is below a thousandth of its size, to
                            ///< that; of a component that never exceeds the absolute tolerance
                            ///< relative to the size at which both tolerances are the same
  std::string reason = {};  ///< of unknown and ended, in words
};

/// What is verified.
struct Verified {
  std::vector<double> times;  ///< of the reference, in the direction of travel; the last is the end
  Eigen::MatrixXd states;     ///< what the run has at these times; columns of NaN where it was not asked
  Tolerance tolerance;        ///< of the run
};

/// The number of times at which rows of a run are verified, at most; the end besides.
inline constexpr int most_verified = 48;

/// How far an error of one weight in every component, made at any of the earlier times, moves a component at
/// a time: at worst, by signs. From each time to the next all components are moved in turn by a small share
/// of their size and integrated by what made the reference; the products of these matrices tell what becomes
/// of errors later.
/// @param way of the reference
/// @param first_weight weight of the components at way.t0
/// @param weight at way.times
/// @param moved gets the result, of the size of @p weight
/// @param seconds wall time
/// @returns success, or why it is not known
[[nodiscard]] Status amplification(const ReferenceRequest& way, const Reference& reference,
                                   const Eigen::VectorXd& first_weight, const Eigen::MatrixXd& weight,
                                   double seconds, Eigen::MatrixXd& moved);

/// Compares a run with a reference. The problem's condition is computed only if the run is off by more than
/// most_tolerances. Unknown is what the reference does not know finely enough to tell.
/// @param reference at run.times
/// @param effort for the condition
[[nodiscard]] Verification verify(const ivp::System& system, const ivp::State& x0, double t0,
                                  const Verified& run, const Reference& reference, const WorkLimit& effort);

/// Does another method, begun anew at each row of the run, come to the same within most_tolerances? Two
/// computations agree then that share nothing but the problem: for one run of many, whose reference would
/// cost more than all else. Where it is false, nothing is known.
/// @param other at a tolerance below that of the run
/// @param limits of the other
[[nodiscard]] bool agrees(const ivp::System& system, const ivp::State& x0, double t0, const Verified& run,
                          const ivp::NamedIntegrator& other, const ivp::Limits& limits);

/// As part of a sentence.
inline constexpr std::string_view what_a_tolerance_holds =
    "holds the error of each step, and not what these add up to";

/// What is worth saying of a run that is right or that could not be verified: "verified: 8.9 digits at the
/// end; x is off by 1.3e-09 there, 130 tolerances"; empty if nothing.
/// @param names of the components
/// @param t1 the end
/// @throws Failure for a run that is wrong or that nothing determines: method, place, what its tolerance
/// holds, and what to change
[[nodiscard]] std::string remark(const Verification& found, const Reference& reference,
                                 const ivp::MethodInfo& method, const ivp::Settings& settings,
                                 const std::vector<std::string>& names, double t1);

}  // namespace nlmech::comparison

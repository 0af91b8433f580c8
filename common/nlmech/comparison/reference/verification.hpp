/// @file
/// Verification of a run: its error against a reference, in tolerances and relative to the error that the
/// conditioning of the problem explains.
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

/// Tolerances of a run with these settings.
[[nodiscard]] Tolerance tolerance_of(const ivp::Settings& settings);

/// Error in tolerances up to which a run is right without a remark; the errors of many steps add up. Over
/// some ten periods of an oscillator good methods stay below 20 and multistep methods below 100; methods
/// whose error estimates are too small do not (tests/comparison).
inline constexpr double most_tolerances = 100;
/// Error in units of the effect of one error of one tolerance made at any earlier time, up to which the
/// problem's condition explains that a run has fewer than required_digits().
inline constexpr double most_amplified = 10;

/// Digits that suffice whatever the conditioning: half of those of the relative tolerance, at least three.
[[nodiscard]] double required_digits(double tolerance);

/// Result of a verification.
struct Verification {
  /// Verdict on the run.
  enum class Verdict {
    right,         ///< error within most_tolerances
    inexact,       ///< error beyond them, but with required_digits()
    undetermined,  ///< fewer digits, because of the problem's condition: within most_amplified times the
                   ///< effect of one tolerance
    wrong,         ///< none of these
    ended,         ///< the solution seems to end before t1 and the run to step across its end: see reason
    unknown        ///< no sufficiently accurate reference: see reason
  };
  Verdict verdict = Verdict::unknown;  ///< verdict on the run
  double t = 0;                      ///< time at which the run has the fewest digits; of a wrong run time of
                                     ///< the greatest error over the allowed one
  int component = 0;                 ///< component, from 0, that belongs to t
  double error = 0;                  ///< error of this component at t
  double uncertainty = 0;            ///< uncertainty of the reference there
  double tolerances = 0;             ///< the error in tolerances
  double allowed = most_tolerances;  ///< the allowed error in tolerances
  double growth = 1;                 ///< growth of an error of one tolerance up to t; 0: unknown
  double digits = 0;        ///< at least so many correct digits: error and uncertainty relative to the
                            ///< component or, if it is below a thousandth of its size, to the size; for a
                            ///< component that never exceeds the absolute tolerance, relative to the size at
                            ///< which both tolerances are equal
  std::string reason = {};  ///< reason of the verdicts unknown and ended
};

/// States of a run for its verification.
struct Verified {
  std::vector<double> times;  ///< output times of the reference, monotonic; the last is the end
  Eigen::MatrixXd states;     ///< states of the run at these times; NaN where the run has none
  Tolerance tolerance;        ///< tolerance of the run
};

/// Greatest number of verified rows of a run, without the end.
inline constexpr int most_verified = 48;

/// Conditioning of the problem: greatest change of each component at each time for an error of one weight in
/// every component, with the worst signs, made at any one of the earlier times. From each time to the next
/// every component is perturbed in turn by a small share of its size and integrated by Reference::first;
/// products of these matrices give the effect on later times.
/// @param request of the reference
/// @param first_weight weights of the components at request.t0
/// @param weight weights at request.times
/// @param moved receives the result, of the size of @p weight
/// @param seconds limit of the wall time
/// @returns success, or why the result is unknown
[[nodiscard]] Status amplification(const ReferenceRequest& request, const Reference& reference,
                                   const Eigen::VectorXd& first_weight, const Eigen::MatrixXd& weight,
                                   double seconds, Eigen::MatrixXd& moved);

/// Compares a run with a reference. amplification() is computed only if the error of the run may exceed
/// most_tolerances. The verdict is unknown if the reference is too inaccurate.
/// @param reference reference at run.times
/// @param effort limit of the wall time of amplification()
[[nodiscard]] Verification verify(const ivp::System& system, const ivp::State& x0, double t0,
                                  const Verified& run, const Reference& reference, const WorkLimit& effort);

/// Does another method, restarted at each row of the run, agree with it within most_tolerances? This cheap
/// verification by an independent method replaces a reference for one of many runs. False proves nothing.
/// @param other method with a tolerance below that of the run
/// @param limits limits of the other method
/// @param observer observer of the other method; may be empty
[[nodiscard]] bool agrees(const ivp::System& system, const ivp::State& x0, double t0, const Verified& run,
                          const ivp::NamedIntegrator& other, const ivp::Limits& limits,
                          const ivp::Observer& observer = {});

/// Meaning of a tolerance, as part of messages.
inline constexpr std::string_view tolerance_meaning = "bounds the error of each step, not their sum";

/// Remark on a run that is inexact or could not be verified: "verified: 8.9 digits at the end; x is off by
/// 1.3e-09 there, 130 tolerances"; empty for a run that is right.
/// @param names names of the components
/// @param t1 end of the run
/// @throws Failure for a run that is wrong, undetermined or ended, with method, place and advice
[[nodiscard]] std::string remark(const Verification& found, const Reference& reference,
                                 const ivp::MethodInfo& method, const ivp::Settings& settings,
                                 const std::vector<std::string>& names, double t1);

}  // namespace nlmech::comparison

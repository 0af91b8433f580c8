/// @file
/// Common code of the scenes on optimal control: cases, their extremals, and the printed method.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/bvp/optimal_control/direct_start.hpp"
#include "nlmech/bvp/optimal_control/duffing.hpp"
#include "nlmech/bvp/optimal_control/printed.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_inverse {

/// Case that the text solves.
struct DuffingSubject {
  bvp::DuffingCase which;  ///< prescribed end values
  std::string row;         ///< name in Table 5.3
  std::string title;       ///< title in words
  int figure;              ///< 5.figure shows states and control, the next two the errors
};

/// The six cases in the order of the text.
[[nodiscard]] const std::vector<DuffingSubject>& duffing_subjects();

/// Final times of the tables; the text does not state T.
inline constexpr std::array<double, 3> final_times = {1, 2, 5};
/// Final time T inferred from the text; the scene `shooting` gives the evidence.
inline constexpr double inferred = 2;

/// Settings of a case with the printed values and S = I.
[[nodiscard]] bvp::DuffingSettings printed_settings(bvp::DuffingCase which, double final_time = inferred);

/// Known extremal of least cost of a case.
struct KnownExtremal {
  bvp::DuffingCase which;       ///< the case, with its printed beta
  double final_time;            ///< T
  double cost;                  ///< J
  std::array<double, 4> first;  ///< x1, x2, lambda1, lambda2 at 0
  std::array<double, 2> last;   ///< x1, x2 at T

  /// Largest error of initial states and co-states, relative for values above 1.
  [[nodiscard]] double error_of(const bvp::Extremal& e) const;
};
/// The six cases and x2x2 at all final times.
[[nodiscard]] const std::vector<KnownExtremal>& known_extremals();
/// The known extremal of a case at a final time.
[[nodiscard]] const KnownExtremal& known_extremal(bvp::DuffingCase which, double final_time = inferred);

/// Known extremal at T = 2, and a start near it: the trajectory of a coarse direct method.
struct ControlStart {
  const KnownExtremal& known;  ///< reference
  bvp::ExtremalProblem problem =
      duffing_problem(printed_settings(known.which, known.final_time));  ///< the case
  bvp::ControlGuess guess = {Eigen::VectorXd::Zero(2),
                             [](double, Eigen::VectorXd& u) { u[0] = 0; }};  ///< no force
  bvp::Start start = direct_start(problem, guess, {.pieces = 40}).start;     ///< start from the guess
};

/// Computation of D.
struct GlobalVariant {
  std::string name;                  ///< name in legends
  bvp::DerivativeMatrix derivative;  ///< D
  double relative_shape;             ///< c T
};
/// Printed shape, a wider shape, printed shape without loss of digits, and the polynomial limit; 40 nodes.
[[nodiscard]] const std::vector<GlobalVariant>& global_variants();

/// Global method of the text. Elimination by x1' = x2 and lambda2' = -lambda1 halves the number of equations
/// without changing the iterates.
[[nodiscard]] bvp::GlobalMethod printed_method(
    const bvp::ExtremalProblem& problem, bvp::DerivativeMatrix derivative = bvp::DerivativeMatrix::gaussian);

/// Largest errors at the nodes relative to the trajectory integrated from the initial values of the solution.
struct NodeErrors {
  double states = 0;    ///< of x
  double costates = 0;  ///< of lambda
};
/// Errors of a result; NaN if it was not integrated.
[[nodiscard]] NodeErrors node_errors(const bvp::GlobalResult& result);
/// The larger of both errors; infinite if the result is not an extremal.
[[nodiscard]] double largest_error(const bvp::GlobalResult& result);

/// Random guess number @p number, from 0, for all states and co-states; equal on every machine. Even numbers:
/// independent values in (-1, 1) at each of 40 nodes. Odd numbers: a constant in (-5, 5) for each component.
[[nodiscard]] bvp::Start random_guess(int number, double final_time);

/// Whether the result is a solution and not a spurious root.
[[nodiscard]] inline bool is_extremal(const bvp::GlobalResult& r) { return r.extremal.solution.status.ok(); }

/// Number of guesses by outcome.
struct GuessCounts {
  std::int64_t good = 0;      ///< extremals
  std::int64_t cheapest = 0;  ///< extremals with a cost within a hundredth of the least known
  std::int64_t spurious = 0;  ///< spurious roots
  std::int64_t failed = 0;    ///< guesses without a root

  GuessCounts& operator+=(const GuessCounts& others);
  /// Fraction of all guesses with an outcome.
  [[nodiscard]] double share(std::int64_t GuessCounts::*what) const {
    return static_cast<double>(this->*what) / static_cast<double>(good + spurious + failed);
  }
};

/// Results of the printed method for one case at one final time, from zeros and ten random guesses.
struct FromGuesses {
  const DuffingSubject* subject = nullptr;  ///< the case
  double final_time = inferred;             ///< T
  std::vector<bvp::GlobalResult> results;   ///< in the order of the guesses

  /// Index of the plotted result: that from zeros if it is an extremal, else the first extremal.
  /// @throws Failure if there is no extremal
  [[nodiscard]] std::size_t chosen() const;
  /// The plotted result. @throws Failure if there is no extremal
  [[nodiscard]] const bvp::GlobalResult& drawn() const { return results[chosen()]; }
  /// Number of guesses by outcome.
  [[nodiscard]] GuessCounts counts() const;
  /// The distinct extremals in order of cost; valid as long as the results.
  [[nodiscard]] std::vector<const bvp::Extremal*> distinct() const;
  /// Least over the extremals of their largest errors at the nodes; infinite without an extremal.
  [[nodiscard]] double least_error() const;
};

/// Name of a guess: "zeros", "random guess 3".
[[nodiscard]] std::string guess_name(std::size_t guess);

/// Extremals of a case from the automatic starts.
[[nodiscard]] scene::Result<bvp::Multistart> extremals(bvp::DuffingCase which, double final_time = inferred);
/// The extremal of least cost. @throws Failure if there is none
[[nodiscard]] const bvp::Extremal& cheapest_of(const bvp::Multistart& all);

/// Results of the printed method from its guesses.
[[nodiscard]] scene::Result<FromGuesses> printed_results(const DuffingSubject& subject,
                                                         double final_time = inferred);
/// printed_results() of all six cases at all final times.
[[nodiscard]] std::vector<scene::Result<FromGuesses>> all_printed_results();
/// Results of global_variants() at T = 2 with the plotted root as start; the first one is that root itself.
[[nodiscard]] scene::Result<std::vector<bvp::GlobalResult>> variants(const DuffingSubject& subject);

}  // namespace nlmech::chapters::rbf_inverse

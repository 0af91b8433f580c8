/// @file
/// What the scenes on optimal control share: the cases, their extremals, and the printed method at them.
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

/// A case that the text solves.
struct DuffingSubject {
  bvp::DuffingCase which;  ///< what is prescribed
  std::string row;         ///< its name in Table 5.3
  std::string title;       ///< in words
  int figure;              ///< 5.figure shows states and control, the next two the errors
};

/// The six of them, in the order of the text.
[[nodiscard]] const std::vector<DuffingSubject>& duffing_subjects();

/// The final times that are tabulated. T is not stated.
inline constexpr std::array<double, 3> final_times = {1, 2, 5};
/// The inferred one of them: the scene `shooting` tells what speaks for it.
inline constexpr double inferred = 2;

/// A case with the printed values, S = I.
[[nodiscard]] bvp::DuffingSettings printed_settings(bvp::DuffingCase which, double final_time = inferred);

/// The lowest extremal known of a case.
struct KnownExtremal {
  bvp::DuffingCase which;       ///< the case, with its printed beta
  double final_time;            ///< T
  double cost;                  ///< J
  std::array<double, 4> first;  ///< x1, x2, lambda1, lambda2 at 0
  std::array<double, 2> last;   ///< x1, x2 at T

  /// The largest error of initial states and co-states, relative where above 1.
  [[nodiscard]] double error_of(const bvp::Extremal& e) const;
};
/// The six cases and x2x2 at all final times.
[[nodiscard]] const std::vector<KnownExtremal>& known_extremals();
/// One of them.
[[nodiscard]] const KnownExtremal& known_extremal(bvp::DuffingCase which, double final_time = inferred);

/// A known extremal at T = 2, and a start in its neighbourhood: the trajectory of a coarse direct method.
struct ControlStart {
  const KnownExtremal& known;  ///< of the case
  bvp::ExtremalProblem problem =
      duffing_problem(printed_settings(known.which, known.final_time));  ///< the case
  bvp::ControlGuess guess = {Eigen::VectorXd::Zero(2),
                             [](double, Eigen::VectorXd& u) { u[0] = 0; }};  ///< no force
  bvp::Start start = direct_start(problem, guess, {.pieces = 40}).start;     ///< from it
};

/// How D is made.
struct GlobalVariant {
  std::string name;                  ///< for legends
  bvp::DerivativeMatrix derivative;  ///< D
  double relative_shape;             ///< c T
};
/// The printed one, a wider shape, the printed one in all digits, and the limit of flat functions; 40 nodes.
[[nodiscard]] const std::vector<GlobalVariant>& global_variants();

/// The equations of the text. x1' = x2 and lambda2' = -lambda1 are used to halve them, which leaves the
/// iterates as they are.
[[nodiscard]] bvp::GlobalMethod printed_method(
    const bvp::ExtremalProblem& problem, bvp::DerivativeMatrix derivative = bvp::DerivativeMatrix::gaussian);

/// Largest errors at the nodes against the trajectory integrated from the solution's own initial values.
struct NodeErrors {
  double states = 0;    ///< of x
  double costates = 0;  ///< of lambda
};
/// NaN if nothing was integrated.
[[nodiscard]] NodeErrors node_errors(const bvp::GlobalResult& result);
/// The larger of both; infinite if it is no extremal.
[[nodiscard]] double largest_error(const bvp::GlobalResult& result);

/// Arbitrary guess number @p number, from 0, the same on every machine, for all states and co-states: even
/// ones have independent values in (-1, 1) at each of 40 nodes, odd ones a constant in (-5, 5) for each
/// component.
[[nodiscard]] bvp::Start random_guess(int number, double final_time);

/// Is it a solution, and no spurious root?
[[nodiscard]] inline bool is_extremal(const bvp::GlobalResult& r) { return r.extremal.solution.status.ok(); }

/// What guesses led to.
struct GuessCounts {
  std::int64_t good = 0;      ///< extremals
  std::int64_t cheapest = 0;  ///< of them, those within a hundredth of the cheapest known
  std::int64_t spurious = 0;  ///< roots that are no solutions
  std::int64_t failed = 0;    ///< no roots

  GuessCounts& operator+=(const GuessCounts& others);
  /// Of all guesses.
  [[nodiscard]] double share(std::int64_t GuessCounts::*what) const {
    return static_cast<double>(this->*what) / static_cast<double>(good + spurious + failed);
  }
};

/// What the printed method made of its guesses for one case at one final time: zeros, then ten random ones.
struct FromGuesses {
  const DuffingSubject* subject = nullptr;  ///< the case
  double final_time = inferred;             ///< T
  std::vector<bvp::GlobalResult> results;   ///< in the order of the guesses

  /// The number of the result that is drawn: that from zeros if it is an extremal, else the first that is
  /// one. @throws Failure if none is
  [[nodiscard]] std::size_t chosen() const;
  /// That result. @throws Failure if there is none
  [[nodiscard]] const bvp::GlobalResult& drawn() const { return results[chosen()]; }
  /// How they ended.
  [[nodiscard]] GuessCounts counts() const;
  /// The extremals among them, each once, cheapest first. They live as long as the results.
  [[nodiscard]] std::vector<const bvp::Extremal*> distinct() const;
  /// Of the extremals' largest errors at the nodes, the least; infinite without an extremal.
  [[nodiscard]] double least_error() const;
};

/// "zeros", "random guess 3".
[[nodiscard]] std::string guess_name(std::size_t guess);

/// What the program's own starts find of a case.
[[nodiscard]] scene::Result<bvp::Multistart> extremals(bvp::DuffingCase which, double final_time = inferred);
/// The cheapest of these. @throws Failure if there is none
[[nodiscard]] const bvp::Extremal& cheapest_of(const bvp::Multistart& all);

/// What the printed method makes of its guesses.
[[nodiscard]] scene::Result<FromGuesses> printed_results(const DuffingSubject& subject,
                                                         double final_time = inferred);
/// The same of all six cases at these final times, one after the other.
[[nodiscard]] std::vector<scene::Result<FromGuesses>> all_printed_results();
/// T = 2: global_variants() begun at the root that is drawn, the first of them that root itself.
[[nodiscard]] scene::Result<std::vector<bvp::GlobalResult>> variants(const DuffingSubject& subject);

}  // namespace nlmech::chapters::rbf_inverse

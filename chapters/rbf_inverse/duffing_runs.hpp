/// @file
/// What the scenes on optimal control share: the cases, their extremals, and the printed method at them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "nlmech/bvp/duffing.hpp"
#include "nlmech/bvp/printed.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

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
/// Index of T = 2 among them, the inferred reading: the scene `shooting` tells what speaks for it.
inline constexpr std::size_t inferred = 1;

/// A case with the printed values, S = I.
[[nodiscard]] bvp::DuffingSettings printed_settings(bvp::DuffingCase which, double final_time);

/// The lowest extremal known of a case.
struct KnownExtremal {
  bvp::DuffingCase which;       ///< the case, with its printed beta
  double final_time;            ///< T
  double cost;                  ///< J
  std::array<double, 4> first;  ///< x1, x2, lambda1, lambda2 at 0
  std::array<double, 2> last;   ///< x1, x2 at T
};
/// The six cases and x2x2 at all final times.
[[nodiscard]] const std::vector<KnownExtremal>& known_extremals();
/// One of them.
[[nodiscard]] const KnownExtremal& known_extremal(bvp::DuffingCase which,
                                                  double final_time = final_times[inferred]);

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

/// Largest errors at the nodes against the trajectory flown from the solution's own initial values.
struct NodeErrors {
  double states = 0;    ///< of x
  double costates = 0;  ///< of lambda
};
/// NaN if nothing was flown.
[[nodiscard]] NodeErrors node_errors(const bvp::GlobalResult& result);

/// The guesses that a case gets: zeros, then ten random ones.
inline constexpr int guesses_a_case = 11;

/// What the printed method made of its guesses, in their order.
using FromGuesses = std::vector<bvp::GlobalResult>;

/// Which of the results is drawn: that from zeros if it is an extremal, else the first that is one.
/// @throws Failure if none is
[[nodiscard]] std::size_t drawn_of(const FromGuesses& all);

/// "zeros", "random guess 3".
[[nodiscard]] std::string guess_name(std::size_t guess);

/// What guesses led to.
struct GuessCounts {
  std::int64_t good = 0;      ///< extremals
  std::int64_t cheapest = 0;  ///< of them, those within a hundredth of the cheapest
  std::int64_t spurious = 0;  ///< roots that are no solutions
};
/// Counts them. @param cheapest cost
[[nodiscard]] GuessCounts count_of(const FromGuesses& all, double cheapest);

/// The extremals among them, each once, cheapest first. They live as long as the results.
[[nodiscard]] std::vector<const bvp::Extremal*> distinct_of(const FromGuesses& all);

/// By final time and by the number of the case in the enumeration.
template <class Result>
using ByCase = std::array<std::array<const scene::Run<Result>*, 8>, final_times.size()>;

/// The shared runs.
struct DuffingRuns {
  ByCase<bvp::Multistart> extremals;  ///< what the own starts find
  ByCase<FromGuesses> printed;        ///< the printed method from guesses; the six cases that the text solves
  /// T = 2: global_variants() begun at the root that is drawn, the first of them that root itself.
  std::array<const scene::Run<FromGuesses>*, 8> variants;
};
/// Declares them.
[[nodiscard]] DuffingRuns add_duffing_runs(scene::Chapter& chapter);

/// The run of a case.
template <class Result>
[[nodiscard]] const scene::Run<Result>& run_of(const ByCase<Result>& runs, bvp::DuffingCase which,
                                               std::size_t time = inferred) {
  return *runs[time][static_cast<std::size_t>(which)];
}
/// What the own starts find.
[[nodiscard]] const bvp::Multistart& extremals_of(const DuffingRuns& runs, scene::Workshop& workshop,
                                                  bvp::DuffingCase which, std::size_t time = inferred);
/// The cheapest. @throws Failure if there is none
[[nodiscard]] const bvp::Extremal& best_of(const DuffingRuns& runs, scene::Workshop& workshop,
                                           bvp::DuffingCase which, std::size_t time = inferred);

/// "T = 2".
[[nodiscard]] std::string time_label(double final_time);

}  // namespace nlmech::chapters

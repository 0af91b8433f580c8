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

/// All extremals of all cases at one final time, by the number of the case in the enumeration.
using Extremals = std::vector<bvp::Multistart>;
/// [subject][variant] at one final time, each begun at the cheapest extremal.
using Globals = std::vector<std::vector<bvp::GlobalResult>>;

/// The cheapest. @throws Failure if there is none
[[nodiscard]] const bvp::Extremal& best_of(const Extremals& all, bvp::DuffingCase which);

/// The shared runs, by final time.
struct DuffingRuns {
  std::array<const scene::Run<Extremals>*, 3> extremals;  ///< what the own starts find
  std::array<const scene::Run<Globals>*, 3> globals;      ///< one interval, 40 nodes
};
/// Declares them.
[[nodiscard]] DuffingRuns add_duffing_runs(scene::Chapter& chapter);

/// "T = 2".
[[nodiscard]] std::string time_label(double final_time);

}  // namespace nlmech::chapters

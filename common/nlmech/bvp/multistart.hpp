/// @file
/// Many starts, and the distinct extremals that they lead to.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "nlmech/bvp/optimal_control/extremal.hpp"

namespace nlmech::bvp {

/// Options of multistart().
struct MultistartOptions {
  /// Two extremals are the same if their initial values and parameters differ by at most this much, relative
  /// to 1 + their size.
  double distinct = 1e-5;
  int second_order_pieces = 0;  ///< of the second-order test of each extremal kept; 0: none
  double seconds = std::numeric_limits<double>::infinity();  ///< no further start after so much time
};

/// An extremal and how often it was found.
struct Found {
  Extremal extremal;  ///< with its second-order test, if that was asked
  int hits = 0;       ///< how many starts led to it
};

/// What many starts led to.
struct Multistart {
  std::vector<Found> found;  ///< distinct, cheapest first
  int good = 0;              ///< starts that led to a solution
  int spurious = 0;          ///< starts that led to a root that cannot be integrated
  int failed = 0;            ///< all other starts begun
  Statistics statistics;     ///< of all of them
};

/// Calls solve_extremal() for one start after the other.
[[nodiscard]] Multistart multistart(const ExtremalProblem& problem, std::span<const Start> starts,
                                    const Options& options = {}, const MultistartOptions& many = {});

}  // namespace nlmech::bvp

/// @file
/// Many starts, and the distinct extremals that they lead to.
#pragma once

#include <functional>
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
  /// Extremals that cost more are counted but not kept.
  double highest_cost = std::numeric_limits<double>::infinity();
  int second_order_pieces = 0;  ///< of the second-order test of each extremal kept; 0: none
  double seconds = std::numeric_limits<double>::infinity();  ///< no start is begun after so much time
};

/// An extremal and how it was found.
struct Found {
  Extremal extremal;            ///< with its second-order test, if that was asked
  int hits = 0;                 ///< how many starts led to it
  std::size_t first_start = 0;  ///< the first of them, from 0
};

/// What many starts led to.
struct Multistart {
  std::vector<Found> found;  ///< distinct, cheapest first
  int good = 0;              ///< starts that led to a solution
  int spurious = 0;          ///< starts that led to a root that cannot be integrated
  int failed = 0;            ///< all other starts begun
  Statistics statistics;     ///< of all of them
};

/// Solves from one start after the other.
/// @param solve_one what to do with a start: solve_extremal, or another method that fills an Extremal
/// @param problem for the second-order test
[[nodiscard]] Multistart multistart(const ExtremalProblem& problem, std::span<const Start> starts,
                                    const std::function<Extremal(const Start&)>& solve_one,
                                    const MultistartOptions& options = {});

/// The same by solve_extremal.
[[nodiscard]] Multistart multistart(const ExtremalProblem& problem, std::span<const Start> starts,
                                    const Options& options = {}, const MultistartOptions& many = {});

}  // namespace nlmech::bvp

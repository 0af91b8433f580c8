/// @file
/// Solutions of typed boundary value problems: fine meshes, infinite ends, several solutions.
#pragma once

#include <vector>

#include "nlmech/bvp/solve.hpp"
#include "nlmech/bvp/typed/typed_problem.hpp"

namespace nlmech::bvp {

/// Solves a typed problem from one start, verified by integration over pieces. Meshes are refined until each
/// piece is short enough for that: in and after a boundary layer adjacent trajectories diverge within a
/// fraction of an interval.
///
/// An infinite end is truncated at doubled times until components with a condition at infinity stay within
/// the tolerance over the last half, and the rest of the solution no longer changes.
///
/// Outcomes besides those of solve(): `outside_validity` for an unknown end that is not after the last known
/// point or is beyond a jump that is no point; `not_converged` for a solution that does not approach its
/// values at infinity.
/// @param problem with an infinite end it is truncated where the solution ends
/// @param tolerance of the residual, see Options
[[nodiscard]] Solution solve_typed(TypedProblem& problem, const Start& start, double tolerance);

/// A solution with the number of its start.
struct FoundSolution {
  Solution solution;  ///< a success
  int start;          ///< 0: the guess; k: start number k
  double size;        ///< size of a random cubic; 0 for the guess
};

/// Result of find_solutions().
struct Search {
  std::vector<FoundSolution> found;  ///< different solutions, in the order of their starts
  Status first;                      ///< status from the guess
};

/// Solves from a guess and then from random cubics of sizes 0.1, 0.3, 0.9, ..., 218.7, 0.1, ..., every other
/// time from a multiple of the first solution.
/// @param starts number of starts, the guess included
/// @param most number of different solutions after which to stop
[[nodiscard]] Search find_solutions(TypedProblem& problem, const Start& guess, int starts, std::size_t most,
                                    double tolerance);

/// Are two solutions of a problem equal to 1e-5 of the size of each component?
[[nodiscard]] bool are_same(const Solution& a, const Solution& b);

}  // namespace nlmech::bvp

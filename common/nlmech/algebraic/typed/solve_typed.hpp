/// @file
/// Roots of typed equations from a start value, by one solver or by several in turn.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/algebraic/typed/root_check.hpp"

namespace nlmech::algebraic {

/// A solver for typed equations: one of solver_names(), or of another library.
struct TypedSolver {
  std::string name;  ///< "dogleg"
  /// Runs until |F| is at most the tolerance, for equations and unknowns of size 1.
  std::function<Report(double tolerance, std::int64_t iterations, Equations&, Eigen::VectorXd&)> run;
};

/// All solvers of solver_names(), or those that apply: energy-trust-region only with an energy.
[[nodiscard]] std::vector<TypedSolver> typed_solvers(const TypedSystem& system);

/// Result of a solver from one start.
struct TypedSolution {
  Status status;        ///< success: `root` is a root, to the tolerance; or why it is none
  Report report;        ///< of the solver, for scaled equations
  Eigen::VectorXd end;  ///< last iterate of the solver
  CheckedRoot root;     ///< the root near the last iterate
  Eigen::VectorXd
      typical;         ///< typical sizes: of start and end; of a start of 0 the largest of the others, or 1
  std::string solver;  ///< name of the solver
  /// -log10 of the distance of `end` from the root in typical sizes; at most 16.
  double digits = 0;
  double seconds = 0;  ///< run time of the solver, without the check
};

/// Runs one solver on equations in units of their sizes: unknowns divided by |start| (by 1 where that is 0),
/// each equation by its change at the start when every unknown changes by that size. Its end is improved and
/// checked by check_root(): success means that the solver reports it, and a proved root whose bound is at
/// most @p tolerance in typical sizes, or 64 eps times its condition; or a singular or unproved one within
/// tolerance^(1/order). A solver that claims success without a root ends with `spurious_root`. Points outside
/// the bounds count as points where F does not exist.
/// @param start within the bounds
/// @param tolerance from 1e-15 to 0.1
[[nodiscard]] TypedSolution solve_by(const TypedSolver& solver, const TypedSystem& system,
                                     const Eigen::VectorXd& start, double tolerance, std::int64_t iterations);

/// Tries energy-trust-region (with an energy), dogleg, levenberg-marquardt, damped-newton and riks from the
/// start, then dogleg and levenberg-marquardt from other starts, the same in each run, until one succeeds: if
/// F(start) is larger than the change that the unknowns can make there, from the next multiples of the start
/// by powers of ten where it is not; then from pseudo-random starts at growing distances.
/// @param tried receives the number of starts
/// @return the first success; else the end of levenberg-marquardt from the given start, with a failure that
/// says whether it is a minimum of |F|
[[nodiscard]] TypedSolution solve_by_several(const TypedSystem& system, const Eigen::VectorXd& start,
                                             double tolerance, std::int64_t iterations, int& tried);

/// Pseudo-random starts about @p start, the same in each run: each component is moved by up to @p size times
/// |start| (1 where that is 0), within the bounds.
[[nodiscard]] std::vector<Eigen::VectorXd> starts_around(const TypedSystem& system,
                                                         const Eigen::VectorXd& start, double size,
                                                         int count);

}  // namespace nlmech::algebraic

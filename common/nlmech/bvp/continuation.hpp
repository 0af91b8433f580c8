/// @file
/// Families of solutions: pseudo-arclength continuation with folds, and constraints tightened step by step.
#pragma once

#include <limits>
#include <optional>

#include "nlmech/bvp/optimal_control/extremal.hpp"

namespace nlmech::bvp {

/// Options of continue_branch().
struct ContinuationOptions {
  double first_step = 0.02;   ///< of the parameter, to begin with; negative: downward
  double longest_step = 0.5;  ///< of arclength, in units of 1 + |initial values and parameters|
  double least_step = 1e-7;   ///< a shorter one ends the branch
  int points = 200;           ///< at most so many
  double low = -std::numeric_limits<double>::infinity();  ///< the branch ends when the parameter is below
  double high = std::numeric_limits<double>::infinity();  ///< or above
  int folds = std::numeric_limits<int>::max();            ///< it ends after so many
  std::optional<double> target = {};  ///< it ends with a point at which the parameter has this value
  Options solve = {};                 ///< of each point
};

/// A point of a branch.
struct BranchPoint {
  double parameter = 0;  ///< the continued one
  double arclength = 0;  ///< from the first point, in the scaled initial values and parameters
  Solution solution;     ///< there
};

/// A branch of solutions.
struct Branch {
  std::vector<BranchPoint> points;  ///< in the order of arclength, the first at the start's parameter
  std::vector<BranchPoint> folds;   ///< where the parameter turns, located by parabolas
  Status status;                    ///< success: it ended as asked; else why it could not go on
  Statistics statistics;            ///< of all solves
};

/// Follows a branch of solutions of a problem whose last parameter has no condition of its own
/// (condition_count is n K + m - 1), through folds. The length is measured in x(t_0) and the parameters,
/// which determine the solution: the condition that is added is local, and costs nothing.
///
/// Tests hold the fold of Bratu's problem to 1e-6 and the upper branch beyond it to 1e-7.
/// @param problem one condition short
/// @param start with all parameters, the continued one last; its value there is that of the first point
/// @throws std::invalid_argument for a wrong number of conditions or options out of range
[[nodiscard]] Branch continue_branch(const Problem& problem, const Start& start,
                                     const ContinuationOptions& options = {});

/// Constraints along a path from easy, at 0, to those asked for, at 1.
using ConstraintPath = std::function<Constraints(double s)>;

/// Solves a control task while its constraints go along a path, each extremal the start of the next; steps
/// are chosen by success.
///
/// Tests hold the cost of a bounded control to 1e-7 of a recorded one by shooting.
/// @param problem gives model and task; its own constraints are not used
/// @param start for s = 0
/// @param options of each solve; with a penalty on states `whole` verifications become `pieces`, because
/// solutions grow like exp(sqrt(weight) t) along a bounded arc
/// @return the extremal at s = 1 (evaluate it with a problem of constraints path(1)); or the last one with
/// the status `infeasible` if the path cannot be followed further: the bounds admit no extremal near, or none
[[nodiscard]] Extremal tighten(const ExtremalProblem& problem, const Start& start, const ConstraintPath& path,
                               const Options& options = {});

/// The same task with other constraints.
[[nodiscard]] ExtremalProblem with_constraints(const ExtremalProblem& problem,
                                               const Constraints& constraints);

/// Constraints for a bounded control: the limit goes from 1.1 times the peak down to @p limit with a wide
/// smoothing, then that goes to @p smoothing.
/// @param peak largest |u| without bound, > 0
/// @throws std::invalid_argument unless all are positive
[[nodiscard]] ConstraintPath control_bound_path(double peak, double limit, double smoothing = 1e-4);

/// Constraints for bounded states: the weight of the penalty grows from 1 to @p weight, the smoothing falls
/// from 0.1 to 1/sqrt(weight).
[[nodiscard]] ConstraintPath state_bound_path(std::vector<StateBound> bounds, double weight = 1e4);

}  // namespace nlmech::bvp

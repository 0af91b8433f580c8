/// @file
/// Solutions of typed equations followed in a parameter.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/algebraic/typed/typed_system.hpp"

namespace nlmech::algebraic {

/// A point of a path.
struct TypedPathPoint {
  using Kind = PointKind;  ///< kinds of points: maxima and minima of the parameter are folds
  int branch;              ///< 0: from the start; others in the order in which they are followed
  Kind kind;               ///< kind of the point
  double parameter;        ///< value of the parameter
  Eigen::VectorXd x;       ///< the solution
  Eigen::Index negative;  ///< with an energy: negative eigenvalues of its Hessian, without one that vanishes;
                          ///< 0: a minimum
};

/// Options of follow_paths().
struct TypedPathOptions {
  double from = 0;            ///< parameter at the start
  double until = 1;           ///< other end of the range; all branches end at both
  double turn = 0.15;         ///< target rotation of the tangent in a step, rad
  int steps = 1000;           ///< largest number of steps of a branch
  int branches = 0;           ///< largest number of branches to follow besides the first
  double seconds = HUGE_VAL;  ///< largest wall time; the points found until then are kept
};

/// Paths from a start.
struct TypedPaths {
  std::vector<TypedPathPoint> points;  ///< branch by branch, along each
  Status status;       ///< success: every branch reached an end of the range, another branch, or its start
  int unfollowed = 0;  ///< half branches that were not followed
  int unresolved = 0;  ///< bifurcation points at which no other branch was found
};

/// Follows the solution from a root at `from` through folds to an end of the range, and then, up to
/// `branches`, the half branches that leave its bifurcations (half_branches()), by Path. Bifurcation points
/// are those of Path and those of bifurcation_near() where dF/d(x, a) comes near to losing rank. Points count
/// as roots to 1e-6 of the unknowns or 1e-9 of their sizes, and 1e-6 of the parameter.
/// @param system with a parameter
/// @param root a root at the value `from` of the parameter
[[nodiscard]] TypedPaths follow_paths(const TypedSystem& system, const Eigen::VectorXd& root,
                                      const TypedPathOptions& options);

}  // namespace nlmech::algebraic

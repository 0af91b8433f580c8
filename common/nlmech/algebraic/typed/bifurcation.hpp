/// @file
/// Bifurcation points of curves F(z) = 0, n equations for n + 1 unknowns, and the branches that meet there.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace nlmech::algebraic {

/// Evaluates F (n) and dF/dz (n rows, n + 1 columns) at z, in unknowns and equations of comparable sizes. Not
/// finite where F does not exist.
using CurveEquations = std::function<void(const Eigen::VectorXd& z, Eigen::VectorXd& f, Eigen::MatrixXd& j)>;

/// The point near @p start where F(z) = 0 and dF/dz loses rank, by Newton's iteration for
///
///     F(z) + mu b = 0,  (dF/dz)^T v = 0,  b^T v = 1
///
/// (Moore 1980), also from branches on which no determinant changes its sign. z is accurate to the rounding
/// of F at a simple bifurcation, to about its square root where the second derivatives vanish too.
/// @param reach largest distance of the point
/// @return empty if there is none, or if mu exceeds its rounding: branches pass each other with a gap
[[nodiscard]] std::optional<Eigen::VectorXd> bifurcation_near(const CurveEquations& equations,
                                                              const Eigen::VectorXd& start, double reach);

/// A point on each half branch that leaves a bifurcation point @p at, at the distance @p radius in the null
/// space of dF/dz: zeros of the bifurcation equation (Lyapunov-Schmidt reduction) on a circle, so that
/// branches with a common tangent, and more than two, are found. Branches that it touches without change of
/// sign are not; nor any if dF/dz loses more than one rank.
[[nodiscard]] std::vector<Eigen::VectorXd> half_branches(const CurveEquations& equations,
                                                         const Eigen::VectorXd& at, double radius);

}  // namespace nlmech::algebraic

/// @file
/// Displacement control for tests: the load for a prescribed value of one displacement, and the slope of the
/// load path there.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <utility>

#include "nlmech/frames/frame.hpp"

namespace nlmech::frames {

/// A point of the load path.
struct PathPoint {
  Eigen::VectorXd x;  ///< displacements
  double load;        ///< load factor
  double slope;       ///< derivative of the load factor by the controlled displacement
};

/// Newton's iteration for f(x) = W load, x_i = value, with dense matrices.
/// @param rounding largest relative step at which stagnation counts as convergence: more where the tangent is
/// nearly singular
inline PathPoint control(const Frame& frame, const Eigen::VectorXd& load, Eigen::Index i, double value,
                         PathPoint at, double rounding = 1e-9) {
  const Eigen::Index n = frame.size();
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + 1, n + 1);
  Eigen::VectorXd f(n), rest(n + 1);
  Eigen::SparseMatrix<double> k;
  double before = HUGE_VAL;
  for (int iteration = 0; iteration < 60; ++iteration) {
    EXPECT_TRUE(frame.force<double>(at.x, f).ok());
    EXPECT_TRUE(frame.tangent<double>(at.x, k).ok());
    bordered.topLeftCorner(n, n) = k;
    bordered.col(n).head(n) = -load;
    bordered(n, i) = 1;
    rest << f - at.load * load, at.x[i] - value;
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(bordered);
    const Eigen::VectorXd step = lu.solve(rest);
    at.x -= step.head(n);
    at.load -= step[n];
    const double length = step.head(n).norm() / (1 + at.x.norm());
    if (length < rounding && length >= before / 4) {  // stagnation at rounding errors
      at.slope = lu.solve(Eigen::VectorXd::Unit(n + 1, n))[n];
      return at;
    }
    before = length;
  }
  ADD_FAILURE() << "displacement control does not converge at " << value;
  return at;
}

}  // namespace nlmech::frames

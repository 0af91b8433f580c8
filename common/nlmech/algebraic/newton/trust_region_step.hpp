/// @file
/// The step of a trust region method: the least value of a quadratic function within a ball.
#pragma once

#include <Eigen/Core>

#include "nlmech/algebraic/symmetric_solver.hpp"

namespace nlmech::algebraic {

/// Minimises m(p) = g^T p + p^T B p/2 for |p| <= radius, nearly: a p on the boundary has a length within 10 %
/// of the radius, and m(p) is within 10 % of the least value (More and Sorensen 1983).
///
/// The minimiser solves (B + lambda I) p = -g with B + lambda I positive semidefinite, lambda >= 0, and
/// lambda (|p| - radius) = 0. lambda is found by Newton's iteration for 1/|p| = 1/radius between bounds that
/// every factorisation narrows. In the hard case, where g has no part along the eigenvectors of the least
/// eigenvalue, such a vector is added.
///
/// Tests hold random steps to 80 % of the best decrease within 1.2 radii.
class TrustRegionStep {
 public:
  /// What came out.
  struct Result {
    double multiplier = 0;      ///< lambda; 0: B is positive definite and p is Newton's step, inside the ball
    double decrease = 0;        ///< -m(p), not negative
    double length = 0;          ///< |p|
    int factorisations = 0;     ///< of B + lambda I
    Eigen::Index negative = 0;  ///< negative eigenvalues of B itself
    bool found = false;         ///< false: no usable p, B or g are beyond the range of double
  };

  /// Finds p. The solver has taken B.
  [[nodiscard]] Result find(SymmetricSolver& b, const Eigen::VectorXd& g, double radius, Eigen::VectorXd& p);

 private:
  void next(double radius, double length, const SymmetricSolver& b, const Eigen::VectorXd& p);
  void pick();
  bool add_null_vector(const SymmetricSolver& b, const Eigen::VectorXd& g, double radius, Eigen::VectorXd& p);

  Eigen::VectorXd v_, w_;
  double lambda_ = 0, lower_ = 0, upper_ = 0, last_ = 0;
};

}  // namespace nlmech::algebraic

/// @file
/// Minimising a potential by trust regions: stable equilibria, with no limit on the distance of the start.
#pragma once

#include <Eigen/Core>

#include "nlmech/algebraic/equations.hpp"
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

/// Minimises V from x by steps p that minimise V + F^T p + p^T B p/2 within a ball |S p| <= radius; the ball
/// grows where V falls as predicted and shrinks where it does not, or is not finite there. Every step lets V
/// fall, so that no limit point holds the iteration up: past one, V falls on to the next stable equilibrium.
///
/// Near the minimum, differences of V drown in rounding. When a step predicts such a difference, or one of
/// 1e-10 of all that V has fallen by, Newton's iteration takes over. It ends when its increments are no
/// longer than 4 eps |S x| or, having stopped shrinking, than 64 times the increment that rounding of x
/// alone calls for, which is measured. So there is no tolerance on F, whose own rounding grows without bound
/// when a structure is divided into more and more elements. The last B is positive definite or the report
/// is a failure: what is found is a stable equilibrium.
///
/// Tests hold the energy to fall at every step, its ends to minima (never a saddle, nor a place where |F|
/// alone is least), and equilibria of random toggles and of a thousand elements to known ones.
struct EnergyTrustRegion {
  /// Diagonal of S, positive. Empty: the square roots of |B_ii| at the start, none below 1e-8 of the
  /// greatest.
  Eigen::VectorXd scale = {};
  double radius = 0;      ///< first radius, in units of |S p|; 0: the length of the step of steepest descent
  int iterations = 2000;  ///< at most so many steps, rejected ones included; else `step_limit`
};

/// Minimises. Outcomes besides success: `step_limit`; `non_finite` if V, F or B is not finite at the start,
/// or in every neighbourhood of an iterate that can be told from it; `not_converged` if V falls no more and
/// the iterate is no minimum to rounding; `wrong_branch` if the equations say so of the point found;
/// `interrupted`. statistics: `newton_iterations` counts steps of the last stage, `right_hand_sides`
/// evaluations of F, those of V excluded.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const EnergyTrustRegion& method, Potential& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

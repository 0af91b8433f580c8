/// @file
/// Minimisation of a potential by a trust-region method: stable equilibria from any start.
#pragma once

#include <Eigen/Core>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/algebraic/symmetric_solver.hpp"

namespace nlmech::algebraic {

/// Trust-region subproblem: minimises m(p) = g^T p + p^T B p/2 for |p| <= radius approximately. A p on the
/// boundary has a length within 10 % of the radius; m(p) is within 10 % of the minimum (More and Sorensen
/// 1983).
///
/// The minimiser solves (B + lambda I) p = -g with B + lambda I positive semidefinite, lambda >= 0, and
/// lambda (|p| - radius) = 0. Newton's iteration for 1/|p| = 1/radius finds lambda between bounds that every
/// factorisation narrows. In the hard case, where g has no part along the eigenvectors of the least
/// eigenvalue, such a vector is added.
///
/// Tests require random steps to reach 80 % of the best decrease within 1.2 radii.
class TrustRegionStep {
 public:
  /// Result of the subproblem.
  struct Result {
    double multiplier = 0;      ///< lambda; 0: B is positive definite and p is Newton's step, inside the ball
    double decrease = 0;        ///< -m(p), not negative
    double length = 0;          ///< |p|
    int factorisations = 0;     ///< number of factorisations of B + lambda I
    Eigen::Index negative = 0;  ///< negative eigenvalues of B itself
    bool found = false;         ///< false if p is not finite (B or g near the range of double)
  };

  /// Solves the subproblem. The solver must hold B.
  [[nodiscard]] Result find(SymmetricSolver& b, const Eigen::VectorXd& g, double radius, Eigen::VectorXd& p);

 private:
  void next(double radius, double length, const SymmetricSolver& b, const Eigen::VectorXd& p);
  void pick();
  bool add_null_vector(const SymmetricSolver& b, const Eigen::VectorXd& g, double radius, Eigen::VectorXd& p);

  Eigen::VectorXd v_, w_;
  double lambda_ = 0, lower_ = 0, upper_ = 0, last_ = 0;
};

/// Trust-region method: minimises V by steps p that minimise V + F^T p + p^T B p/2 within |S p| <= radius.
/// The radius grows where V decreases as predicted and shrinks where V does not or is not finite. V decreases
/// at every step, so the iteration passes limit points and continues to the next stable equilibrium.
///
/// Near the minimum, differences of V are lost in rounding. When the predicted decrease is that small, or
/// below 1e-10 of the total decrease of V, Newton's iteration takes over. It ends when the increments are at
/// most 4 eps |S x|, or no longer shrink and are at most 64 times the increment that rounding of x alone
/// causes, which is measured. There is no tolerance on F, because the rounding of F grows without bound as a
/// structure is divided into more elements. Success requires the last B to be positive definite: the result
/// is a stable equilibrium.
///
/// Tests check that the energy decreases at every step and that the result is a minimum (no saddle, no
/// minimum of |F| alone), and compare equilibria of random toggles and of a thousand elements with known
/// ones.
struct EnergyTrustRegion {
  /// Diagonal of S, positive. Empty: the square roots of |B_ii| at the start, none below 1e-8 of the
  /// greatest.
  Eigen::VectorXd scale = {};
  double radius = 0;      ///< first radius, in units of |S p|; 0: length of the steepest-descent step
  int iterations = 2000;  ///< limit of steps, including rejected ones; then `step_limit`
};

/// Minimises V. Outcomes besides success: `step_limit`; `non_finite` if V, F or B is not finite at the start,
/// or if V is not finite down to the smallest radius about an iterate; `not_converged` if V decreases no more
/// and the iterate is no minimum to rounding; `wrong_branch` if the equations report it for the result;
/// `interrupted`. statistics: `newton_iterations` counts the final Newton steps, `right_hand_sides`
/// evaluations of F without those of V.
/// @throws std::invalid_argument if an option is out of range or x has another size than the equations,
/// std::logic_error if they have no matrix
[[nodiscard]] Report find_root(const EnergyTrustRegion& method, Potential& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

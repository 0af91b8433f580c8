/// @file
/// Equations that are the gradient of a potential.
#pragma once

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// F = dV/dx: the roots are stationary points of V, and B, its Hessian, is symmetric.
///
/// Past a limit point |F| has minima that are no roots, and a method that only lets |F| fall ends there. V
/// has none of that kind: where V is bounded below, a minimum of V is a root, and a stable equilibrium.
class Potential : public Equations {
 public:
  /// V(x); not finite where V does not exist.
  [[nodiscard]] virtual double energy(const Eigen::VectorXd& x) = 0;
};

}  // namespace nlmech::algebraic

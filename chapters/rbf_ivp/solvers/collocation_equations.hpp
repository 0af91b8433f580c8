/// @file
/// Equations of one interval of collocation in time (Eq. 4.16) as a system F(x) = 0 for solvers, in two
/// forms.
#pragma once

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Form of F. Both forms have the same roots and the same Newton steps.
enum class Form {
  printed,    ///< D x - g, as Eq. 4.16
  integrated  ///< x - (D_ss)^-1 (g - D_s1 x_1); D_ss: rows and columns 2..N of D
};

/// An interval of an initial value problem with its nodes.
struct Interval {
  ivp::System system;          ///< the problem
  double t0;                   ///< start of the interval
  double h;                    ///< length of the interval
  ivp::State x0;               ///< state at t0
  Eigen::VectorXd nodes;       ///< on the unit interval, the first 0, the last 1
  Eigen::MatrixXd derivative;  ///< on the unit interval, from values at the nodes to derivatives there

  /// Unknowns of the constant state x0. The unknowns are the states at nodes 2..N, ordered by node.
  [[nodiscard]] Eigen::VectorXd start() const { return x0.replicate(nodes.size() - 1, 1); }
};

/// F of an interval; `x - F(x)` of the integrated form is a sweep of Picard's iteration.
[[nodiscard]] algebraic::DenseEquations collocation_equations(const Interval& interval, Form form);

}  // namespace nlmech::chapters::rbf_ivp

/// @file
/// The equations of one interval of collocation in time (Eq. 4.16) as a system F(x) = 0 for any solver, in
/// two forms.
#pragma once

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Which F. Both have the same roots, and Newton's iteration takes the same steps on both.
enum class Form {
  printed,    ///< D x - g, as Eq. 4.16
  integrated  ///< x - (D_ss)^-1 (g - D_s1 x_1): the same times the inverse of the rows and columns 2..N of D
};

/// An interval of an initial value problem, and its nodes.
struct Interval {
  ivp::System system;          ///< the problem
  double t0;                   ///< start
  double h;                    ///< length
  ivp::State x0;               ///< state at the start
  Eigen::VectorXd nodes;       ///< on the unit interval, the first 0, the last 1
  Eigen::MatrixXd derivative;  ///< on the unit interval, from values at the nodes to derivatives there

  /// The states at nodes 2..N, ordered node by node, are the unknowns: those of a constant state.
  [[nodiscard]] Eigen::VectorXd start() const { return x0.replicate(nodes.size() - 1, 1); }
};

/// F of an interval; `x - F(x)` of the integrated form is a sweep of Picard's iteration.
[[nodiscard]] algebraic::DenseEquations collocation_equations(const Interval& interval, Form form);

}  // namespace nlmech::chapters::rbf_ivp

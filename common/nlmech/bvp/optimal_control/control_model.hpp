/// @file
/// Model of an optimal control problem: dynamics and cost with the derivatives for extremals and direct
/// methods.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace nlmech::bvp {

/// Bound low <= x_component <= high, enforced by a penalty.
struct StateBound {
  int component = 0;                                      ///< number of the state, from 0
  double low = -std::numeric_limits<double>::infinity();  ///< lower bound
  double high = std::numeric_limits<double>::infinity();  ///< upper bound
};

/// Smoothed bounds on controls and states.
struct Constraints {
  /// |u_i| <= limit for each control: the unconstrained control is clipped, which is Pontryagin's principle
  /// if H is convex in u and has no products of controls.
  double control_limit = std::numeric_limits<double>::infinity();
  /// d of (sqrt((u + limit)^2 + d^2) - sqrt((u - limit)^2 + d^2))/2, which replaces the clipping; > 0.
  double control_smoothing = 1e-3;
  std::vector<StateBound> states = {};  ///< each bound adds weight/2 (v + sqrt(v^2 + d^2))^2/4 to the running
                                        ///< cost, with the excess v and the smoothing d
  double penalty_weight = 0;            ///< weight of the penalties on states; >= 0
  double penalty_smoothing = 1e-3;      ///< d of the penalties on states; > 0
};

/// Dynamics dx/dt = g(t, x, u) with derivatives with respect to x and u.
struct LinearDynamics {
  Eigen::VectorXd g;    ///< dx/dt
  Eigen::MatrixXd g_x;  ///< dg/dx
  Eigen::MatrixXd g_u;  ///< dg/du
};

/// Hamiltonian H(t, x, u, lambda) = L + lambda^T g and dynamics, with derivatives with respect to x and u.
struct HamiltonianExpansion : LinearDynamics {
  double value = 0;          ///< H
  Eigen::VectorXd gradient;  ///< by x, then u
  Eigen::MatrixXd hessian;   ///< by x, then u
};

/// End cost phi(x(t_0), x(t_F), t_F) with derivatives with respect to x(t_0), x(t_F), t_F in this order.
struct EndCost {
  double value = 0;          ///< phi
  Eigen::VectorXd gradient;  ///< 2 n + 1
  Eigen::MatrixXd hessian;   ///< 2 n + 1 by 2 n + 1
};

/// Minimise phi(x(t_0), x(t_F), t_F) + integral L(t, x, u) dt subject to dx/dt = g(t, x, u) (Eq. 5.2), n
/// states and q controls. All functions may depend on a parameter mu. z = (x, lambda) has 2 n components.
/// DualControl creates a model from function templates.
class ControlModel {
 public:
  virtual ~ControlModel() = default;

  /// n.
  [[nodiscard]] virtual int states() const = 0;
  /// q.
  [[nodiscard]] virtual int controls() const = 0;
  /// Control that makes H stationary (Eq. 5.7, third line), within its bounds; NaN if there is none.
  virtual void control(double t, const Eigen::VectorXd& z, double mu, const Constraints& constraints,
                       Eigen::VectorXd& u) const = 0;
  /// Right-hand side dz/dt of extremals (Eq. 5.7).
  virtual void extremal(double t, const Eigen::VectorXd& z, double mu, const Constraints& constraints,
                        Eigen::VectorXd& dzdt) const = 0;
  /// Jacobian of extremal() with respect to z and t if @p j has 2 n + 1 columns, with respect to z alone if
  /// it has 2 n.
  virtual void extremal_jacobian(double t, const Eigen::VectorXd& z, double mu,
                                 const Constraints& constraints, Eigen::MatrixXd& j) const = 0;
  /// H on an extremal, and its gradient with respect to z and t.
  [[nodiscard]] virtual double hamiltonian(double t, const Eigen::VectorXd& z, double mu,
                                           const Constraints& constraints,
                                           Eigen::VectorXd& gradient) const = 0;
  /// H and its derivatives for a given control; with lambda = 0 those of L.
  [[nodiscard]] virtual HamiltonianExpansion expand(double t, const Eigen::VectorXd& x,
                                                    const Eigen::VectorXd& u, const Eigen::VectorXd& lambda,
                                                    double mu, const Constraints& constraints) const = 0;
  /// g and its derivatives.
  virtual void linearise(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double mu,
                         LinearDynamics& linear) const = 0;
  /// Sets g(t, x, u) and returns L without penalties.
  virtual double dynamics(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double mu,
                          Eigen::VectorXd& g) const = 0;
  /// The end cost with its derivatives.
  [[nodiscard]] virtual EndCost end_cost(const Eigen::VectorXd& x0, const Eigen::VectorXd& xF,
                                         double tF) const = 0;
};

}  // namespace nlmech::bvp

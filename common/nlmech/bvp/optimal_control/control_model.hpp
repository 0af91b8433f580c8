/// @file
/// Optimal control: the dynamics and the cost with all derivatives that extremals and direct methods need.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace nlmech::bvp {

/// low <= x_component <= high, kept by a penalty.
struct StateBound {
  int component = 0;                                      ///< from 0
  double low = -std::numeric_limits<double>::infinity();  ///< least value
  double high = std::numeric_limits<double>::infinity();  ///< greatest value
};

/// Bounds on control and states, in smooth form.
struct Constraints {
  /// |u_i| <= limit for each control: the unconstrained control is clipped, as Pontryagin's principle asks
  /// where H is convex in u and has no products of controls.
  double control_limit = std::numeric_limits<double>::infinity();
  /// d of (sqrt((u + limit)^2 + d^2) - sqrt((u - limit)^2 + d^2))/2, which stands for the clip; > 0.
  double control_smoothing = 1e-3;
  std::vector<StateBound> states = {};  ///< each adds weight/2 (v + sqrt(v^2 + d^2))^2/4 to the running cost,
                                        ///< v the excess and d the smoothing
  double penalty_weight = 0;            ///< of the states' bounds
  double penalty_smoothing = 1e-3;      ///< d of the states' bounds
};

/// dx/dt = g(t, x, u) with its derivatives by x and u.
struct LinearDynamics {
  Eigen::VectorXd g;    ///< dx/dt
  Eigen::MatrixXd g_x;  ///< its derivatives by x
  Eigen::MatrixXd g_u;  ///< and by u
};

/// H(t, x, u, lambda) = L + lambda^T g with its derivatives by x and u, beside those of the dynamics.
struct HamiltonianExpansion : LinearDynamics {
  double value = 0;          ///< H
  Eigen::VectorXd gradient;  ///< by x, then u
  Eigen::MatrixXd hessian;   ///< by x, then u
};

/// phi(x(t_0), x(t_F), t_F) with its derivatives by x(t_0), x(t_F), t_F in this order.
struct EndCost {
  double value = 0;          ///< phi
  Eigen::VectorXd gradient;  ///< 2 n + 1
  Eigen::MatrixXd hessian;   ///< 2 n + 1 square
};

/// Minimise phi(x(t_0), x(t_F), t_F) + integral L(t, x, u) dt subject to dx/dt = g(t, x, u) (Eq. 5.2), n
/// states and q controls. All functions may depend on one more number, mu. z = (x, lambda) has 2 n
/// components. DualControl makes a model of functions written once.
class ControlModel {
 public:
  virtual ~ControlModel() = default;

  /// n.
  [[nodiscard]] virtual int states() const = 0;
  /// q.
  [[nodiscard]] virtual int controls() const = 0;
  /// The control that makes H stationary (Eq. 5.7, third line), within its bounds. NaN where there is none.
  virtual void control(double t, const Eigen::VectorXd& z, double mu, const Constraints& constraints,
                       Eigen::VectorXd& u) const = 0;
  /// dz/dt of extremals (Eq. 5.7).
  virtual void extremal(double t, const Eigen::VectorXd& z, double mu, const Constraints& constraints,
                        Eigen::VectorXd& dzdt) const = 0;
  /// Its derivatives by z and t, in 2 n + 1 columns; by z alone in a @p j of 2 n.
  virtual void extremal_jacobian(double t, const Eigen::VectorXd& z, double mu,
                                 const Constraints& constraints, Eigen::MatrixXd& j) const = 0;
  /// H along an extremal, and its gradient by z and t.
  [[nodiscard]] virtual double hamiltonian(double t, const Eigen::VectorXd& z, double mu,
                                           const Constraints& constraints,
                                           Eigen::VectorXd& gradient) const = 0;
  /// H and its derivatives for a given control. With lambda = 0 those of L.
  [[nodiscard]] virtual HamiltonianExpansion expand(double t, const Eigen::VectorXd& x,
                                                    const Eigen::VectorXd& u, const Eigen::VectorXd& lambda,
                                                    double mu, const Constraints& constraints) const = 0;
  /// g and its derivatives alone.
  virtual void linearise(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double mu,
                         LinearDynamics& linear) const = 0;
  /// g(t, x, u) alone, and L, which is returned without penalties.
  virtual double dynamics(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double mu,
                          Eigen::VectorXd& g) const = 0;
  /// phi with its derivatives.
  [[nodiscard]] virtual EndCost end_cost(const Eigen::VectorXd& x0, const Eigen::VectorXd& xF,
                                         double tF) const = 0;
};

}  // namespace nlmech::bvp

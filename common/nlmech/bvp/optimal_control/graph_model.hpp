/// @file
/// Control model from the expressions of a graph, for direct_start().
#pragma once

#include <memory>

#include "nlmech/bvp/optimal_control/arcs.hpp"
#include "nlmech/bvp/optimal_control/control_model.hpp"
#include "nlmech/bvp/optimal_control/extremal.hpp"

namespace nlmech::bvp {

/// Additions to the cost that make a problem regular for a direct method.
struct Regularisation {
  double control = 0;  ///< weight of (u - middle)^2/2 of each control in which H is linear, relative to its
                       ///< bounds
  double bounds = 0;   ///< weight of max(S, 0)^2/2 of each bound on states
  double ends = 1e4;   ///< weight of psi^2/2 of each condition that is not a prescribed value
};

/// ControlModel of a ControlProblem without bounds of controls; bounds on states and conditions other than
/// prescribed values are penalties.
class GraphModel final : public ControlModel {
 public:
  /// Copies @p problem. @param necessary its necessary conditions
  GraphModel(const ControlProblem& problem, std::shared_ptr<const NecessaryConditions> necessary,
             const Regularisation& regularisation);

  [[nodiscard]] int states() const override { return n_; }
  [[nodiscard]] int controls() const override { return q_; }
  void control(double t, const Eigen::VectorXd& z, double mu, const Constraints& constraints,
               Eigen::VectorXd& u) const override;
  void extremal(double t, const Eigen::VectorXd& z, double mu, const Constraints& constraints,
                Eigen::VectorXd& dzdt) const override;
  void extremal_jacobian(double t, const Eigen::VectorXd& z, double mu, const Constraints& constraints,
                         Eigen::MatrixXd& j) const override;
  [[nodiscard]] double hamiltonian(double t, const Eigen::VectorXd& z, double mu,
                                   const Constraints& constraints, Eigen::VectorXd& gradient) const override;
  [[nodiscard]] HamiltonianExpansion expand(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                                            const Eigen::VectorXd& lambda, double mu,
                                            const Constraints& constraints) const override;
  void linearise(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double mu,
                 LinearDynamics& linear) const override;
  double dynamics(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double mu,
                  Eigen::VectorXd& g) const override;
  [[nodiscard]] EndCost end_cost(const Eigen::VectorXd& x0, const Eigen::VectorXd& xF,
                                 double tF) const override;

 private:
  [[nodiscard]] Eigen::VectorXd wide(const Eigen::VectorXd& x, const Eigen::VectorXd& lambda,
                                     const Eigen::VectorXd& u) const;
  void derive_end_cost(const ControlProblem& problem, double weight);

  std::shared_ptr<const NecessaryConditions> necessary_;
  ArcFlow interior_;
  int n_, q_;
  Expressions cost_, expansion_, dynamics_, ends_;
};

/// The task of a ControlProblem: its interval and its prescribed values.
[[nodiscard]] ControlTask task_of(const ControlProblem& problem);

}  // namespace nlmech::bvp

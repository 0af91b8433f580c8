/// @file
/// The right-hand side of a boundary value problem with the derivatives of its flight: what shooting flies.
#pragma once

#include <Eigen/Core>
#include <stdexcept>

#include "nlmech/bvp/problem.hpp"

namespace nlmech::chapters::rbf_inverse {

/// x and the n by n derivative by its initial value, one column after the other, for integrators. No
/// parameters.
struct Variational {
  static constexpr int dimension = Eigen::Dynamic;  ///< known when it runs
  const bvp::Problem* problem;                      ///< outlives the system

  /// n (n + 1).
  [[nodiscard]] int size() const { return problem->states() * (1 + problem->states()); }
  /// The slopes of all.
  void operator()(const double& t, const Eigen::VectorXd& y, Eigen::VectorXd& dydt) const {
    const Eigen::Index n = problem->states();
    Eigen::VectorXd slope(n);
    Eigen::MatrixXd by_state(n, n), none(n, 0);
    const Eigen::VectorXd x = y.head(n);
    problem->rhs(t, x, Eigen::VectorXd(), slope);
    problem->jacobian(t, x, Eigen::VectorXd(), by_state, none);
    dydt.resize(y.size());
    dydt.head(n) = slope;
    dydt.tail(n * n) = (by_state * y.tail(n * n).reshaped(n, n)).reshaped();
  }
  /// Not given: explicit methods and fixed-point iterations take none. @throws std::logic_error always
  void jacobian(double /*t*/, const Eigen::VectorXd& /*y*/, Eigen::MatrixXd& /*j*/) const {
    throw std::logic_error("the variational equations give no Jacobian");
  }
};

/// x0 with the derivative of a flight that has not begun: the identity.
[[nodiscard]] inline Eigen::VectorXd with_identity(const Eigen::VectorXd& x0) {
  const Eigen::Index n = x0.size();
  Eigen::VectorXd y(n + n * n);
  y << x0, Eigen::MatrixXd::Identity(n, n).reshaped();
  return y;
}

}  // namespace nlmech::chapters::rbf_inverse

#include "chapters/rbf_ivp/solvers/collocation_equations.hpp"

#include <Eigen/LU>

namespace nlmech::chapters::rbf_ivp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

algebraic::DenseEquations collocation_equations(const Interval& interval, Form form) {
  const Index s = interval.nodes.size() - 1, m = interval.system.size();
  const MatrixXd inner = interval.derivative.bottomRightCorner(s, s), identity = MatrixXd::Identity(s, s);
  const MatrixXd from_start = interval.derivative.col(0).tail(s) * interval.x0.transpose();
  // F = left X + constant - right g(X), with the state at a node in each row of X and F.
  const bool printed = form == Form::printed;
  const MatrixXd left = printed ? MatrixXd(inner / interval.h) : identity,
                 right = printed ? identity : MatrixXd(interval.h * inner.inverse()),
                 constant =
                     printed ? MatrixXd(from_start / interval.h) : inner.partialPivLu().solve(from_start);
  const auto time = [interval](Index k) { return interval.t0 + interval.h * interval.nodes[k + 1]; };
  const auto residual = [=](const VectorXd& x, VectorXd& f) {
    const Eigen::Map<const MatrixXd> states(x.data(), m, s);
    MatrixXd slopes(m, s);
    ivp::State slope = interval.x0;
    for (Index k = 0; k < s; ++k) {
      interval.system.rhs(time(k), ivp::State(states.col(k)), slope);
      slopes.col(k) = slope;
    }
    Eigen::Map<MatrixXd>(f.data(), m, s) =
        states * left.transpose() + constant.transpose() - slopes * right.transpose();
  };
  const auto derivative = [=](const VectorXd& x, MatrixXd& b) {
    ivp::Jacobian jacobian = ivp::Jacobian::Zero(m, m);
    for (Index column = 0; column < s; ++column) {
      interval.system.jacobian(time(column), ivp::State(x.segment(column * m, m)), jacobian);
      for (Index row = 0; row < s; ++row) {
        auto block = b.block(row * m, column * m, m, m);
        block = -right(row, column) * jacobian;
        block.diagonal().array() += left(row, column);
      }
    }
  };
  return {s * m, residual, derivative};
}

}  // namespace nlmech::chapters::rbf_ivp

// The root of x^2 = 2.
#include <cmath>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/algebraic/named_solvers.hpp"

int main() {
  using namespace nlmech::algebraic;
  DenseEquations equations(
      1, [](const Eigen::VectorXd& x, Eigen::VectorXd& f) { f[0] = x[0] * x[0] - 2; },
      [](const Eigen::VectorXd& x, Eigen::MatrixXd& b) { b(0, 0) = 2 * x[0]; });
  Eigen::VectorXd x = Eigen::VectorXd::Ones(1);
  const Report report = find_root(NamedSolver{.name = "newton", .tolerance = 1e-12}, equations, x);
  return report.status.ok() && std::abs(x[0] - std::sqrt(2.0)) < 1e-12 ? 0 : 1;
}

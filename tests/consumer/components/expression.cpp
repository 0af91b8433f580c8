// x'' + 4 x = 0 at x = 3: the acceleration is -12.
#include "nlmech/expression/equations.hpp"
#include "nlmech/expression/problem.hpp"

int main() {
  using namespace nlmech::expression;
  const Problem problem(Equations(SourceText("equation", "x'' + 4 x = 0")));
  const Eigen::VectorXd x = Eigen::Vector2d(3, 0);
  Eigen::VectorXd slope(2);
  problem(0.0, x, slope);
  return slope[0] == 0 && slope[1] == -12 ? 0 : 1;
}

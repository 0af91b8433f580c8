// d/dx x^3 = 12 at x = 2, the series of 1/(1 - d), and x'' + 4 x = 0 at x = 3: the acceleration is -12.
#include "nlmech/program/dual.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/power_series.hpp"
#include "nlmech/program/problem.hpp"

int main() {
  using namespace nlmech::program;
  using Dual = nlmech::Dual<double, 1>;
  using Series = nlmech::PowerSeries<double>;
  const Dual x = Dual::variable(2, 0);
  const Series quotient = 1.0 / (1.0 - Series::variable(0, 3));
  const Problem problem(Equations(SourceText("equation", "x'' + 4 x = 0")));
  const Eigen::VectorXd state = Eigen::Vector2d(3, 0);
  Eigen::VectorXd slope(2);
  problem(0.0, state, slope);
  return (x * x * x).partial[0] == 12 && quotient.coefficients()[3] == 1 && slope[0] == 0 && slope[1] == -12
             ? 0
             : 1;
}

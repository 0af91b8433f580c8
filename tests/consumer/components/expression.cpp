// x'' + 4 x = 0 at x = 3: the acceleration is -12.
#include "nlmech/expression/equations.hpp"
#include "nlmech/expression/problem.hpp"

int main() {
  using namespace nlmech::expression;
  const Problem<2> problem(Equations(SourceText("equation", "x'' + 4 x = 0")));
  const nlmech::Vector<double, 2> x(3, 0);
  nlmech::Vector<double, 2> slope;
  problem(0.0, x, slope);
  return slope[0] == 0 && slope[1] == -12 ? 0 : 1;
}

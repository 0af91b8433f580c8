// d/dx x^3 = 12 at x = 2, and the series of 1/(1 - d).
#include "nlmech/series/dual.hpp"
#include "nlmech/series/power_series.hpp"

int main() {
  using Dual = nlmech::Dual<double, 1>;
  using Series = nlmech::PowerSeries<double>;
  const Dual x = Dual::variable(2, 0);
  const Series quotient = 1.0 / (1.0 - Series::variable(0, 3));
  return (x * x * x).partial[0] == 12 && quotient.coefficients()[3] == 1 ? 0 : 1;
}

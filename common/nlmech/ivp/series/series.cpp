#include "nlmech/ivp/series/series.hpp"

namespace nlmech::ivp {

int series_order(double relative_tolerance) {
  // Measured: above 1e-9 the fixed cost of a step equals that of its terms, so higher orders are cheaper.
  const double digits = -std::log(relative_tolerance);
  return std::min(static_cast<int>(std::ceil(std::max(1 + 0.75 * digits, 9 + 0.36 * digits))), 40);
}

void check_options(const Series& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  require_within(method.name, "relative_tolerance", method.relative_tolerance, 1e-18, 0.1);
  require_within(method.name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(method.name, "step", method.step, 0, largest);
  require_within(method.name, "largest_step", method.largest_step, 0, largest);
  if (method.order != 0) require_within(method.name, "order", method.order, 2, 100);
}

Solution run(const InitialValueProblem& problem, const Series& method) {
  return run<System>(problem, method);
}

}  // namespace nlmech::ivp

#include "nlmech/ivp/runge_kutta/dop853.hpp"

namespace nlmech::ivp {

void check_options(const Dop853& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  require_within(method.name, "relative_tolerance", method.relative_tolerance, 0, 0.1);
  require_within(method.name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(method.name, "initial_step", method.initial_step, 0, largest);
  require_within(method.name, "largest_step", method.largest_step, 0, largest);
}

Solution run(const InitialValueProblem& problem, const Dop853& method) {
  return run<System>(problem, method);
}

}  // namespace nlmech::ivp

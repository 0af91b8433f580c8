#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"

namespace nlmech::ivp {

void check_options(const Ode45& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  const double eps = std::numeric_limits<double>::epsilon();
  require_within(method.name, "relative_tolerance", method.relative_tolerance, 100 * eps, 0.1);
  require_within(method.name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(method.name, "initial_step", method.initial_step, 0, largest);
  require_within(method.name, "largest_step", method.largest_step, 0, largest);
  require_within(method.name, "refine", method.refine, 1, 1000);
}

Solution run(const InitialValueProblem& problem, const Ode45& method) { return run<System>(problem, method); }

}  // namespace nlmech::ivp

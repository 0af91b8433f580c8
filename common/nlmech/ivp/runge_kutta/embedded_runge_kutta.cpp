#include "nlmech/ivp/runge_kutta/embedded_runge_kutta.hpp"

#include <limits>

#include "nlmech/ivp/runge_kutta/dop853.hpp"
#include "nlmech/ivp/runge_kutta/dormand_prince.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"

namespace nlmech::ivp {

void check_embedded_options(std::string_view name, double least_relative_tolerance, double relative_tolerance,
                            double absolute_tolerance, double initial_step, double largest_step) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  require_within(name, "relative_tolerance", relative_tolerance, least_relative_tolerance, 0.1);
  require_within(name, "absolute_tolerance", absolute_tolerance, least, largest);
  require_within(name, "initial_step", initial_step, 0, largest);
  require_within(name, "largest_step", largest_step, 0, largest);
}

Solution run(const InitialValueProblem& problem, const Ode45& method) { return run<System>(problem, method); }

Solution run(const InitialValueProblem& problem, const Dop853& method) {
  return run<System>(problem, method);
}

Solution run(const InitialValueProblem& problem, const Rkn1210& method) {
  return run<System>(problem, method);
}

}  // namespace nlmech::ivp

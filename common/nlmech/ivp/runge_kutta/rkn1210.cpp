#include "nlmech/ivp/runge_kutta/rkn1210.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nlmech::ivp {

void check_options(const Rkn1210& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  require_within(method.name, "relative_tolerance", method.relative_tolerance, 0, 0.1);
  require_within(method.name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(method.name, "initial_step", method.initial_step, 0, largest);
  require_within(method.name, "largest_step", method.largest_step, 0, largest);
}

void refuse_velocities(std::string_view method) {
  throw std::invalid_argument(
      fmt::format("{}: the accelerations of this problem depend on velocities; take another method", method));
}

Status depends_on_velocities(std::string_view method, double t) {
  return Status::failure(
      Outcome::outside_validity,
      fmt::format("{}: the accelerations depend on velocities, as shows at t = {:.17g}; take another method",
                  method, t));
}

Solution run(const InitialValueProblem& problem, const Rkn1210& method) {
  return run<System>(problem, method);
}

}  // namespace nlmech::ivp

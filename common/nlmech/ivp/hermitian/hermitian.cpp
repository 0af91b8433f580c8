#include "nlmech/ivp/hermitian/hermitian.hpp"

#include <fmt/format.h>

#include <limits>

namespace nlmech::ivp {

void check_options(const Hermitian& method) {
  constexpr double largest = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::string_view name = method.operators.name;
  require_within(name, "step", method.step, 0, largest);
  require_within(name, "relative_tolerance", method.relative_tolerance, 1e-14, 0.1);
  require_within(name, "absolute_tolerance", method.absolute_tolerance, least, largest);
  require_within(name, "branch_tolerance", method.branch_tolerance, least, infinity);
}

Status hermitian::wrong_branch(std::string_view method, double t, double step, double estimate) {
  return Status::failure(
      Outcome::wrong_branch,
      fmt::format("{}: Newton's iteration of the step of {:.6g} from t = {:.17g} converged, but the error "
                  "estimate is {:.2g} of the displacement: its root need not continue the solution; take a "
                  "smaller step, or a tolerance in its place",
                  method, step, t, estimate));
}

Status hermitian::errors_add_up(std::string_view method, double t, std::int64_t steps, double sum) {
  return Status::failure(
      Outcome::not_converged,
      fmt::format(
          "{}: each of {} steps to t = {:.17g} is within the tolerance, but their errors may add up to "
          "{:.2g} of the state; take a smaller tolerance",
          method, steps, t, sum));
}

}  // namespace nlmech::ivp

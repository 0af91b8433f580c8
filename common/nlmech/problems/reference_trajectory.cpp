#include "nlmech/problems/reference_trajectory.hpp"

#include <cstdio>

namespace nlmech::problems::detail {

Status reference_failure(Outcome outcome, double t, double step, std::size_t steps) {
  const char* advice = "take reference_states() over a shorter time, or raise the limit";
  if (outcome == Outcome::step_underflow) advice = "the solution ends here, or has a singularity close by";
  if (outcome == Outcome::non_finite) advice = "the right-hand side or a Taylor coefficient is not finite";
  char place[96];
  (void)std::snprintf(place, sizeof place, "t = %.17g, step %.3g after %zu steps", t, step, steps);
  return Status::failure(outcome, std::string("reference trajectory: stopped at ") + place + "; " + advice);
}

}  // namespace nlmech::problems::detail

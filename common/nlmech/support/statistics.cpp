#include "nlmech/support/statistics.hpp"

namespace nlmech {

Statistics& Statistics::operator+=(const Statistics& other) noexcept {
  steps += other.steps;
  rejected += other.rejected;
  right_hand_sides += other.right_hand_sides;
  jacobians += other.jacobians;
  newton_iterations += other.newton_iterations;
  factorisations += other.factorisations;
  fallbacks += other.fallbacks;
  seconds += other.seconds;
  return *this;
}

}  // namespace nlmech

/// @file
/// Work counters of a computation, the same for all methods, so that methods can be compared.
#pragma once

#include <cstdint>

namespace nlmech {

/// Work of one call of a solver or integrator. Unused counters stay zero.
struct Statistics {
  std::int64_t steps = 0;              ///< accepted steps or outer iterations
  std::int64_t rejected = 0;           ///< rejected steps
  std::int64_t right_hand_sides = 0;   ///< evaluations of f(t, x) or F(x), one per node
  std::int64_t jacobians = 0;          ///< evaluations of the Jacobian matrix
  std::int64_t newton_iterations = 0;  ///< linear solves with a Jacobian
  std::int64_t factorisations = 0;     ///< matrix factorisations
  std::int64_t fallbacks = 0;          ///< number of times a slower, always valid algorithm was used
  double seconds = 0;                  ///< wall time of the call

  /// Adds counter by counter.
  Statistics& operator+=(const Statistics& other) noexcept;
};

/// Sum, counter by counter.
[[nodiscard]] inline Statistics operator+(Statistics a, const Statistics& b) noexcept { return a += b; }

}  // namespace nlmech

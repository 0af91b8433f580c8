/// @file
/// What a computation cost. Every method fills the same counters, so that methods can be set side by side.
#pragma once

#include <cstdint>

namespace nlmech {

/// Work done by one call of a solver or integrator. Counters that a method has no use for stay zero.
struct Statistics {
  std::int64_t steps = 0;              ///< accepted steps or outer iterations
  std::int64_t rejected = 0;           ///< steps computed and thrown away
  std::int64_t right_hand_sides = 0;   ///< evaluations of f(t, x) or F(x), one a node
  std::int64_t jacobians = 0;          ///< evaluations of the Jacobian matrix
  std::int64_t newton_iterations = 0;  ///< linear solves with a Jacobian
  std::int64_t factorisations = 0;     ///< matrix factorisations
  std::int64_t fallbacks = 0;          ///< rare event: a slower, always valid path was taken
  double seconds = 0;                  ///< wall time of the call

  /// Sums two pieces of work, counter by counter.
  Statistics& operator+=(const Statistics& other) noexcept;
};

/// Sum, counter by counter.
[[nodiscard]] inline Statistics operator+(Statistics a, const Statistics& b) noexcept { return a += b; }

}  // namespace nlmech

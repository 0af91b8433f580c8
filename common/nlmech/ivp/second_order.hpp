/// @file
/// What methods for accelerations share: they split a state into positions and velocities.
#pragma once

#include <string_view>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// May a state of n components be positions and then as many velocities?
template <int n>
inline constexpr bool has_halves = n == Eigen::Dynamic || n % 2 == 0;

/// Positions: the first half of @p x, to read or to write.
template <class X>
[[nodiscard]] auto positions(X& x) {
  constexpr int m = half<X::RowsAtCompileTime>;
  return x.head(Eigen::fix<m>(static_cast<int>(x.size()) / 2));
}

/// Velocities: the second half of @p x, to read or to write.
template <class X>
[[nodiscard]] auto velocities(X& x) {
  constexpr int m = half<X::RowsAtCompileTime>;
  return x.tail(Eigen::fix<m>(static_cast<int>(x.size()) / 2));
}

/// @throws std::invalid_argument unless the system gives accelerations, or if its size is odd
template <SystemLike S>
void require_accelerations(std::string_view method, const S& system) {
  static_assert(
      has_halves<S::dimension>,
      "a method for accelerations needs a state of positions and as many velocities: an odd dimension "
      "cannot be split");
  require_second_order(method, system.second_order() && system.size() % 2 == 0);
}

}  // namespace nlmech::ivp

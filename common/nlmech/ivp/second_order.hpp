/// @file
/// Helpers for second-order methods, which split a state into positions and velocities.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::ivp {

/// Positions: the first half of @p x, to read or to write.
template <class X>
[[nodiscard]] auto positions(X& x) {
  constexpr int n = X::RowsAtCompileTime, m = n == Eigen::Dynamic ? n : n / 2;
  return x.head(Eigen::fix<m>(static_cast<int>(x.size()) / 2));
}

/// Velocities: the second half of @p x, to read or to write.
template <class X>
[[nodiscard]] auto velocities(X& x) {
  constexpr int n = X::RowsAtCompileTime, m = n == Eigen::Dynamic ? n : n / 2;
  return x.tail(Eigen::fix<m>(static_cast<int>(x.size()) / 2));
}

/// Assembles a state and its derivative: x = (q, v), f = (v, a).
inline void join(const State& q, const State& v, const State& a, State& x, State& f) {
  const Eigen::Index size = q.size();
  for (Eigen::Index i = 0; i < size; ++i) {
    x[i] = q[i];
    x[size + i] = f[i] = v[i];
    f[size + i] = a[i];
  }
}

/// The largest |x_i| with begin <= i < end; not for NaN.
[[nodiscard]] inline double greatest(const State& x, Eigen::Index begin, Eigen::Index end) {
  double most = 0;
  for (Eigen::Index i = begin; i < end; ++i) most = std::max(most, std::abs(x[i]));
  return most;
}

/// @throws std::invalid_argument unless the system gives accelerations, or if its size is odd
template <SystemLike S>
void require_accelerations(std::string_view method, const S& system) {
  static_assert(S::dimension == Eigen::Dynamic || S::dimension % 2 == 0,
                "a method for accelerations needs positions and as many velocities");
  require_second_order(method, system.second_order() && system.size() % 2 == 0);
}

}  // namespace nlmech::ivp

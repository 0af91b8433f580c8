/// @file
/// Weighted sums of the stages of a Runge-Kutta method.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>

namespace nlmech::ivp {

/// sum_j weights[j] k[j][d] over the first `count` stages, left to right, with no operation for a weight 0
/// but the first. Written out component by component on plain numbers and inlined, so that short vectors stay
/// in registers from stage to stage.
template <const auto& weights, std::size_t count, class V, std::size_t stages>
[[nodiscard, gnu::always_inline]] inline double weighted(const std::array<V, stages>& k, Eigen::Index d) {
  double sum = weights[0] * k[0].data()[d];
  const auto add = [&]<std::size_t... j>(std::index_sequence<j...>) __attribute__((always_inline)) {
    ((weights[j + 1] != 0 ? void(sum += weights[j + 1] * k[j + 1].data()[d]) : void()), ...);
  };
  add(std::make_index_sequence<count - 1>());
  return sum;
}

namespace detail {
/// @p sum and the terms from j on.
template <const auto& weights, std::size_t j, std::size_t count, class Sum, class V, std::size_t stages>
[[nodiscard, gnu::always_inline]] inline auto add_weighted(const Sum& sum, const std::array<V, stages>& k) {
  if constexpr (j == count)
    return sum;
  else if constexpr (weights[j] == 0)
    return add_weighted<weights, j + 1, count>(sum, k);
  else
    return add_weighted<weights, j + 1, count>(sum + weights[j] * k[j], k);
}
}  // namespace detail

/// The same of all components, as an expression of Eigen that refers to @p k: two components an operation.
template <const auto& weights, std::size_t count, class V, std::size_t stages>
[[nodiscard, gnu::always_inline]] inline auto weighted(const std::array<V, stages>& k) {
  return detail::add_weighted<weights, 1, count>(weights[0] * k[0], k);
}

}  // namespace nlmech::ivp

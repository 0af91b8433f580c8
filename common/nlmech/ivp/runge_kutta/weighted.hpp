/// @file
/// Weighted sums of the stages of a Runge-Kutta method, as plain loops over components: for short vectors of
/// dynamic size they take a third of the time of Eigen expressions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

namespace nlmech::ivp {

namespace detail {

/// Two components at a time, available on every processor. Passed by reference: the calling convention of
/// vectors depends on the processor.
struct Pair {
  using Numbers [[gnu::vector_size(2 * sizeof(double))]] = double;  ///< vector type of the compiler
  /// Loads the components from @p from on.
  [[gnu::always_inline]] static void load(const double* from, Numbers& numbers) {
    std::memcpy(&numbers, from, sizeof numbers);
  }
  /// Stores the components from @p to on.
  [[gnu::always_inline]] static void store(double* to, const Numbers& numbers) {
    std::memcpy(to, &numbers, sizeof numbers);
  }
};
/// One component.
struct Single {
  using Numbers = double;  ///< the number
  /// Loads the component at @p from.
  [[gnu::always_inline]] static void load(const double* from, double& number) { number = *from; }
  /// Stores the component at @p to.
  [[gnu::always_inline]] static void store(double* to, double number) { *to = number; }
};

/// Calls @p work(index, kind) for all of @p size components: in pairs, then for a single last one. (In fours
/// GCC 12 stores through the stack on processors with pairs only.)
template <class Work>
[[gnu::always_inline]] inline void for_components(Eigen::Index size, Work work) {
  Eigen::Index d = 0;
  for (; d + 2 <= size; d += 2) work(d, Pair{});
  if (d < size) work(d, Single{});
}

/// @p sum = sum_j weights[j] k_j from left to right; after the first term those with weight 0 are omitted.
template <const auto& weights, class Kind, std::size_t count>
[[gnu::always_inline]] inline void add_up(const std::array<const double*, count>& k, Eigen::Index d,
                                          typename Kind::Numbers& sum) {
  Kind::load(k[0] + d, sum);
  sum = weights[0] * sum;
  const auto add = [&](double weight, const double* from) __attribute__((always_inline)) {
    typename Kind::Numbers stage;
    Kind::load(from + d, stage);
    sum += weight * stage;
  };
  [&]<std::size_t... j>(std::index_sequence<j...>) __attribute__((always_inline)) {
    ((weights[j + 1] != 0 ? add(weights[j + 1], k[j + 1]) : void()), ...);
  }
  (std::make_index_sequence<count - 1>());
}

/// Pointers to the first @p count stages.
template <std::size_t count, class V, std::size_t stages>
[[nodiscard, gnu::always_inline]] inline std::array<const double*, count> places(
    const std::array<V, stages>& k) {
  return [&]<std::size_t... j>(std::index_sequence<j...>) __attribute__((always_inline)) {
    return std::array<const double*, count>{k[j].data()...};
  }
  (std::make_index_sequence<count>());
}

/// Writes to @p y the sum of each component as modified by @p finish(index, kind, sum).
template <const auto& weights, std::size_t count, class V, std::size_t stages, class Finish>
[[gnu::always_inline]] inline void store_sums(const std::array<V, stages>& k, V& y, Finish finish) {
  const auto from = places<count>(k);
  double* const to = y.data();
  for_components(
      y.size(), [&](Eigen::Index d, auto kind) __attribute__((always_inline)) {
        using Kind = decltype(kind);
        typename Kind::Numbers sum;
        add_up<weights, Kind>(from, d, sum);
        finish(d, kind, sum);
        Kind::store(to + d, sum);
      });
}

/// y = x + sum of the terms of each component; @p terms calls its argument with weight and index of each
/// stage.
template <std::size_t count, class V, std::size_t stages, class Terms>
[[gnu::always_inline]] inline void add_terms(const V& x, const std::array<V, stages>& k, V& y, Terms terms) {
  const auto from = places<count>(k);
  const double* const base = x.data();
  double* const to = y.data();
  for_components(
      y.size(), [&](Eigen::Index d, auto kind) __attribute__((always_inline)) {
        using Kind = decltype(kind);
        typename Kind::Numbers sum;
        Kind::load(base + d, sum);
        terms([&](double weight, std::size_t j) __attribute__((always_inline)) {
          typename Kind::Numbers stage;
          Kind::load(from[j] + d, stage);
          sum += weight * stage;
        });
        Kind::store(to + d, sum);
      });
}

}  // namespace detail

/// y = sum_j weights[j] k_j over the first `count` stages, each component from left to right.
template <const auto& weights, std::size_t count, class V, std::size_t stages>
[[gnu::always_inline]] inline void weighted(const std::array<V, stages>& k, V& y) {
  detail::store_sums<weights, count>(k, y, [](auto, auto, auto&) __attribute__((always_inline)){});
}

/// y = x + h sum_j weights[j] k_j.
template <const auto& weights, std::size_t count, class V, std::size_t stages>
[[gnu::always_inline]] inline void advance(const V& x, double h, const std::array<V, stages>& k, V& y) {
  const double* const base = x.data();
  detail::store_sums<weights, count>(
      k, y, [&](Eigen::Index d, auto kind, auto& sum) __attribute__((always_inline)) {
        typename decltype(kind)::Numbers start;
        decltype(kind)::load(base + d, start);
        sum = start + h * sum;
      });
}

/// y = x + (h weights[0]) k_0 + (h weights[1]) k_1 + ..., from left to right, without the weights 0: the
/// usual order for a tableau.
template <const auto& weights, std::size_t count, class V, std::size_t stages>
[[gnu::always_inline]] inline void add_stages(const V& x, double h, const std::array<V, stages>& k, V& y) {
  detail::add_terms<count>(
      x, k, y, [&](auto add) __attribute__((always_inline)) {
        [&]<std::size_t... j>(std::index_sequence<j...>) __attribute__((always_inline)) {
          ((weights[j] != 0 ? add(h * weights[j], j) : void()), ...);
        }
        (std::make_index_sequence<count>());
      });
}

/// y = x + b_0 k_0 + b_1 k_1 + ..., from left to right, over all stages, with weights known at run time.
template <class V, std::size_t stages>
[[gnu::always_inline]] inline void add_stages(const V& x, const std::array<double, stages>& b,
                                              const std::array<V, stages>& k, V& y) {
  detail::add_terms<stages>(
      x, k, y, [&](auto add) __attribute__((always_inline)) {
        [&]<std::size_t... j>(std::index_sequence<j...>) __attribute__((always_inline)) {
          (add(b[j], j), ...);
        }
        (std::make_index_sequence<stages>());
      });
}

/// sum_j weights[j] k_j for component @p d.
template <const auto& weights, std::size_t count, class V, std::size_t stages>
[[nodiscard, gnu::always_inline]] inline double weighted(const std::array<V, stages>& k, Eigen::Index d) {
  double sum = 0;
  detail::add_up<weights, detail::Single>(detail::places<count>(k), d, sum);
  return sum;
}

}  // namespace nlmech::ivp

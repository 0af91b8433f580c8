/// @file
/// The replay of a tape for several solutions at once, one a lane, each with the bits that it has alone.
/// Internal to the kernels.
#pragma once

#include "nlmech/program/kernels/replay.hpp"

namespace nlmech::tape {

/// One solution a lane. @tparam V simd::Pack
template <class V>
struct Many {
  using Number = V;
  static constexpr int width = V::lanes;

  [[gnu::always_inline]] static V load(const double* from) { return V::load(from); }
  [[gnu::always_inline]] static void store(double* to, V x) { x.store(to); }
  [[gnu::always_inline]] static V all(double x) { return V::all(x); }
  [[gnu::always_inline]] static V constant(double, const double* constants, int i) {
    return V::load(constants + i * width);
  }
};

/// Sums in the order of the AVX2 kernel: eight partial sums, and what is left of four.
template <class V>
struct ManyInFours : Many<V> {
  using Many<V>::load;
  using Many<V>::width;

  [[gnu::always_inline]] static V sum(const double* a, const double* b, int n) {
    V rest = V::all(0);
    int i = 0;
    if (n < 4) {
      for (; i < n; ++i) rest = product(a, b, i, rest);
      return rest;
    }
    V even[4], odd[4];
    for (int j = 0; j < 4; ++j) even[j] = load(a + j * width) * load(b - j * width);
    for (int j = 0; j < 4; ++j) odd[j] = V::all(0);
    for (i = 4; i + 8 <= n; i += 8) {
      for (int j = 0; j < 4; ++j) odd[j] = product(a, b, i + j, odd[j]);
      for (int j = 0; j < 4; ++j) even[j] = product(a, b, i + 4 + j, even[j]);
    }
    if (i + 4 <= n) {
      for (int j = 0; j < 4; ++j) odd[j] = product(a, b, i + j, odd[j]);
      i += 4;
    }
    for (; i < n; ++i) rest = product(a, b, i, rest);
    for (int j = 0; j < 4; ++j) even[j] = even[j] + odd[j];
    return ((even[0] + even[2]) + (even[1] + even[3])) + rest;
  }

 private:
  [[gnu::always_inline]] static V product(const double* a, const double* b, int i, V sum) {
    return multiply_add(load(a + i * width), load(b - i * width), sum);
  }
};

/// Sums in the order of the baseline kernel: four partial sums, products rounded.
template <class V>
struct ManyRounded : Many<V> {
  using Many<V>::load;
  using Many<V>::width;

  [[gnu::always_inline]] static V sum(const double* a, const double* b, int n) {
    V s[4];
    for (int j = 0; j < 4; ++j) s[j] = V::all(0);
    int i = 0;
    for (; i + 4 <= n; i += 4) {
      for (int j = 0; j < 4; ++j) s[j] = s[j] + load(a + (i + j) * width) * load(b - (i + j) * width);
    }
    for (; i < n; ++i) s[0] = s[0] + load(a + i * width) * load(b - i * width);
    return (s[0] + s[1]) + (s[2] + s[3]);
  }
};

/// See LaneKernel::increments: even and odd powers apart, the two halves side by side.
template <class V>
void lane_increments(const double* memory, std::int64_t stride, int size, int order, const double* s,
                     double* sums) {
  const V x = V::load(s), square = x * x;
  for (int i = 0; i < size; ++i) {
    const double* const c = memory + (i + 1) * stride;
    const auto at = [c](int k) __attribute__((always_inline)) { return V::load(c + k * V::lanes); };
    int k = order;
    V high = at(k), low = at(k - 1);
    for (k -= 2; k >= 2; k -= 2) {
      high = high * square + at(k);
      low = low * square + at(k - 1);
    }
    const V sum = k == 1 ? (high * square + at(1)) * x + low * square : high * square + low * x;
    sum.store(sums + i * V::lanes);
  }
}

/// The kernel of Numbers, ManyInFours or ManyRounded.
template <class Numbers>
inline constexpr LaneKernel lane_kernel = {Numbers::width, Replayer<Numbers>::run,
                                           lane_increments<typename Numbers::Number>};

}  // namespace nlmech::tape

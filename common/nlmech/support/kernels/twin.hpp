/// @file
/// Two registers as one: a kernel whose operations wait for each other has twice as many to do meanwhile.
/// Internal to the kernels.
#pragma once

#include "nlmech/support/kernels/lanes.hpp"
#include "nlmech/support/kernels/rough_logarithm.hpp"

namespace nlmech::simd {

/// The operations of Lanes for two of them. @tparam V Lanes
template <class V>
struct Twin {
  static constexpr int lanes = 2 * V::lanes;  ///< of both
  V a;                                        ///< the first half
  V b;                                        ///< the second

  /// Of both halves.
  struct Mask {
    typename V::Mask a;  ///< of the first half
    typename V::Mask b;  ///< of the second

    [[gnu::always_inline]] friend Mask operator&(Mask x, Mask y) { return {x.a & y.a, x.b & y.b}; }
  };

  /// See Lanes.
  /// @{
  [[gnu::always_inline]] static Twin all(double x) { return {V::all(x), V::all(x)}; }
  [[gnu::always_inline]] static Twin load(const double* from) {
    return {V::load(from), V::load(from + V::lanes)};
  }
  [[gnu::always_inline]] void store(double* to) const { a.store(to), b.store(to + V::lanes); }
  [[gnu::always_inline]] friend Twin operator+(Twin x, Twin y) { return {x.a + y.a, x.b + y.b}; }
  [[gnu::always_inline]] friend Twin operator-(Twin x, Twin y) { return {x.a - y.a, x.b - y.b}; }
  [[gnu::always_inline]] friend Twin operator*(Twin x, Twin y) { return {x.a * y.a, x.b * y.b}; }
  [[gnu::always_inline]] friend Twin operator/(Twin x, Twin y) { return {x.a / y.a, x.b / y.b}; }
  [[gnu::always_inline]] friend Twin multiply_add(Twin x, Twin y, Twin z) {
    return {multiply_add(x.a, y.a, z.a), multiply_add(x.b, y.b, z.b)};
  }
  [[gnu::always_inline]] friend Twin subtract_product(Twin x, Twin y, Twin z) {
    return {subtract_product(x.a, y.a, z.a), subtract_product(x.b, y.b, z.b)};
  }
  [[gnu::always_inline]] friend Twin square_root(Twin x) { return {square_root(x.a), square_root(x.b)}; }
  [[gnu::always_inline]] friend Twin larger(Twin x, Twin y) { return {larger(x.a, y.a), larger(x.b, y.b)}; }
  [[gnu::always_inline]] friend Twin smaller(Twin x, Twin y) {
    return {smaller(x.a, y.a), smaller(x.b, y.b)};
  }
  [[gnu::always_inline]] friend Mask operator>(Twin x, Twin y) { return {x.a > y.a, x.b > y.b}; }
  [[gnu::always_inline]] friend Mask within(Twin low, Twin x, Twin high) {
    return {within(low.a, x.a, high.a), within(low.b, x.b, high.b)};
  }
  [[gnu::always_inline]] friend Twin select(Mask m, Twin yes, Twin no) {
    return {select(m.a, yes.a, no.a), select(m.b, yes.b, no.b)};
  }
  [[gnu::always_inline]] static unsigned bits(Mask m) { return V::bits(m.a) | V::bits(m.b) << V::lanes; }
  [[gnu::always_inline]] friend Twin rough_log2(Twin x) { return {rough_log2(x.a), rough_log2(x.b)}; }
  [[gnu::always_inline]] friend Twin rough_exp2(Twin x) { return {rough_exp2(x.a), rough_exp2(x.b)}; }
  /// @}
};

}  // namespace nlmech::simd

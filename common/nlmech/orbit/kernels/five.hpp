/// @file
/// Five doubles for the Taylor kernels: a position, f and m f_m. Internal to the kernels.
#pragma once

#include "nlmech/support/kernels/lanes.hpp"

namespace nlmech::orbit::kernels {

template <class Set>
using Four = simd::Lanes<Set, 4>;

/// The first three lanes of @p r, then @p a.
template <class Set>
[[gnu::always_inline]] inline Four<Set> joined(Four<Set> r, double a) {
  r.v[3] = a;
  return r;
}

/// Four lanes and one, where no register holds more.
template <class Set, bool in_one_register = (Set::lanes > 4)>
struct Five {
  Four<Set> low;
  double high;

  [[gnu::always_inline]] static Five zero() { return {Four<Set>::all(0), 0}; }
  /// The first three lanes of r, then a and b.
  [[gnu::always_inline]] static Five of(Four<Set> r, double a, double b) { return {joined(r, a), b}; }
  [[gnu::always_inline]] friend Five operator+(Five a, Five b) { return {a.low + b.low, a.high + b.high}; }
  [[gnu::always_inline]] friend Five operator*(Five a, double b) {
    return {a.low * Four<Set>::all(b), a.high * b};
  }
  /// a b + c
  [[gnu::always_inline]] friend Five multiply_add(Five a, double b, Five c) {
    return {multiply_add(a.low, Four<Set>::all(b), c.low), Set::multiply_add(a.high, b, c.high)};
  }
  [[gnu::always_inline]] Four<Set> four() const { return low; }
  [[gnu::always_inline]] double fourth() const { return low[3]; }
  [[gnu::always_inline]] double fifth() const { return high; }
};

/// Five of eight lanes.
template <class Set>
struct Five<Set, true> {
  using Eight = simd::Lanes<Set, 8>;
  Eight v;

  [[gnu::always_inline]] static Five zero() { return {Eight::all(0)}; }
  [[gnu::always_inline]] static Five of(Four<Set> r, double a, double b) {
    return {{__builtin_shufflevector(joined(r, a).v, Four<Set>::all(b).v, 0, 1, 2, 3, 4, 5, 6, 7)}};
  }
  [[gnu::always_inline]] friend Five operator+(Five a, Five b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Five operator*(Five a, double b) { return {a.v * Eight::all(b)}; }
  [[gnu::always_inline]] friend Five multiply_add(Five a, double b, Five c) {
    return {multiply_add(a.v, Eight::all(b), c.v)};
  }
  [[gnu::always_inline]] Four<Set> four() const { return {__builtin_shufflevector(v.v, v.v, 0, 1, 2, 3)}; }
  [[gnu::always_inline]] double fourth() const { return v[3]; }
  [[gnu::always_inline]] double fifth() const { return v[4]; }
};

}  // namespace nlmech::orbit::kernels

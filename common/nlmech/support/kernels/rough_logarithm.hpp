/// @file
/// Logarithm and exponential to base 2 in lanes, accurate enough for step-size control. Internal to the
/// kernels.
#pragma once

#include "nlmech/support/kernels/pack.hpp"

namespace nlmech::simd {

/// Unsigned integers as wide as the lanes; a right shift is one instruction from AVX2 on.
template <int n>
struct Integers {
  using Bits [[gnu::vector_size(n * sizeof(double))]] = std::uint64_t;  ///< one per lane
};

/// log2(x) within 6e-5 for normal x: the exponent plus a polynomial in the fraction. Zeros, infinities and
/// NaNs give values near +-1024; the sign is ignored.
template <class Set, int n>
[[gnu::always_inline]] inline Pack<Set, n> rough_log2(Pack<Set, n> x) {
  if constexpr (n > Set::lanes) {
    return {rough_log2(x.a), rough_log2(x.b)};
  } else {
    using V = Pack<Set, n>;
    using Bits = typename Integers<n>::Bits;
    const Bits bits = Bits(x.v);
    // Put the exponent bits into the last bits of 2^52: a conversion available in every instruction set.
    const Bits biased = ((bits >> 52U) & 0x7ffU) | 0x4330000000000000U;
    const V exponent = V{typename V::Native(biased)} - V::all(0x1p52 + 1023);
    const V m = V{typename V::Native((bits & 0xfffffffffffffU) | 0x3ff0000000000000U)} - V::all(1);
    V p = V::all(0.058664939715711);
    p = multiply_add(p, m, V::all(-0.225103025498408));
    p = multiply_add(p, m, V::all(0.440599032955431));
    p = multiply_add(p, m, V::all(-0.716714663167679));
    p = multiply_add(p, m, V::all(1.442603894242363));
    return multiply_add(p, m, exponent);
  }
}

/// 2^x with a relative error of at most 1.1e-4 for |x| <= 1000; x is clamped to this range. NaN gives a
/// number.
template <class Set, int n>
[[gnu::always_inline]] inline Pack<Set, n> rough_exp2(Pack<Set, n> x) {
  if constexpr (n > Set::lanes) {
    return {rough_exp2(x.a), rough_exp2(x.b)};
  } else {
    using V = Pack<Set, n>;
    using Bits = typename Integers<n>::Bits;
    const V bounded = larger(smaller(x, V::all(1000)), V::all(-1000));
    const V shifted = bounded + V::all(0x1.8p52);  // the nearest integer in the last bits
    const V m = bounded - (shifted - V::all(0x1.8p52));
    V p = V::all(0.055838282946220);
    p = multiply_add(p, m, V::all(0.242639478546258));
    p = multiply_add(p, m, V::all(0.693136733883621));
    p = multiply_add(p, m, V::all(0.999924556950871));
    return {typename V::Native(Bits(p.v) + (Bits(shifted.v) << 52U))};
  }
}

}  // namespace nlmech::simd

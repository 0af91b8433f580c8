/// @file
/// Vectors of doubles with the operations of the kernels. Internal to the kernels.
///
/// Every type has its instruction set as a template argument. A kernel in the AVX-512 file therefore has
/// another symbol than the same kernel in the baseline file, so the linker cannot mix code for different
/// processors. For the same reason no inline functions of the standard library are used. Multiply-adds are
/// explicit, so that results do not depend on the number of lanes.
#pragma once

#include <cstdint>

namespace nlmech::simd {

/// Vector types of the compiler with @p n lanes.
template <int n>
struct Vectors {
  using Numbers [[gnu::vector_size(n * sizeof(double))]] = double;     ///< operands
  using Mask [[gnu::vector_size(n * sizeof(double))]] = std::int64_t;  ///< all bits of a lane set or clear
};

/// Several doubles with lane-wise operations.
/// @tparam Set Baseline, Avx2 or Avx512: operations that the vector types of the compiler lack
/// @tparam n number of lanes, a power of two
/// @tparam halves is n above the number of doubles per register?
template <class Set, int n, bool halves = (n > Set::lanes)>
struct Pack {
  static constexpr int lanes = n;               ///< number of lanes
  using Native = typename Vectors<n>::Numbers;  ///< the compiler's vector
  using Mask = typename Vectors<n>::Mask;       ///< all bits of a lane set or clear
  Native v;                                     ///< the numbers

  /// The same number in all lanes; x - 0 is x, also for x = -0.
  [[gnu::always_inline]] static Pack all(double x) { return {x - Native{}}; }
  /// One number per lane.
  template <class... Numbers>
  [[gnu::always_inline]] static Pack of(Numbers... x) {
    static_assert(sizeof...(x) == n);
    return {Native{x...}};
  }
  /// Loads from memory, aligned or not.
  [[gnu::always_inline]] static Pack load(const double* from) {
    Pack x;
    __builtin_memcpy(&x.v, from, sizeof x.v);
    return x;
  }
  /// Stores to memory, aligned or not.
  [[gnu::always_inline]] void store(double* to) const { __builtin_memcpy(to, &v, sizeof v); }
  /// Lane @p i.
  [[gnu::always_inline]] double operator[](int i) const { return v[i]; }
  /// Sets lane @p i.
  [[gnu::always_inline]] void set(int i, double x) { v[i] = x; }

  [[gnu::always_inline]] friend Pack operator+(Pack a, Pack b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Pack operator-(Pack a, Pack b) { return {a.v - b.v}; }
  [[gnu::always_inline]] friend Pack operator*(Pack a, Pack b) { return {a.v * b.v}; }
  [[gnu::always_inline]] friend Pack operator/(Pack a, Pack b) { return {a.v / b.v}; }
  /// a b + c, rounded once where the instruction set can.
  [[gnu::always_inline]] friend Pack multiply_add(Pack a, Pack b, Pack c) {
    return {Set::multiply_add(a.v, b.v, c.v)};
  }
  /// c - a b, rounded once where the instruction set can.
  [[gnu::always_inline]] friend Pack subtract_product(Pack a, Pack b, Pack c) {
    return {Set::subtract_product(a.v, b.v, c.v)};
  }
  /// Lane by lane; the compiler emits one instruction.
  [[gnu::always_inline]] friend Pack square_root(Pack a) {
    for (int i = 0; i < n; ++i) a.v[i] = __builtin_sqrt(a.v[i]);
    return a;
  }
  [[gnu::always_inline]] friend Pack magnitude(Pack a) { return {Native(Mask(a.v) & ~sign_bit())}; }
  [[gnu::always_inline]] friend Pack larger(Pack a, Pack b) { return {Set::larger(a.v, b.v)}; }
  [[gnu::always_inline]] friend Pack smaller(Pack a, Pack b) { return {Set::smaller(a.v, b.v)}; }

  [[gnu::always_inline]] friend Mask operator>(Pack a, Pack b) { return Mask(a.v > b.v); }
  /// low <= x <= high
  [[gnu::always_inline]] friend Mask within(Pack low, Pack x, Pack high) {
    return Set::both(Mask(low.v <= x.v), Mask(x.v <= high.v));
  }
  [[gnu::always_inline]] friend Pack select(Mask m, Pack yes, Pack no) { return {m ? yes.v : no.v}; }
  [[gnu::always_inline]] friend Pack negate_if(Mask m, Pack a) {
    return {Native(Mask(a.v) ^ (m & sign_bit()))};
  }
  /// -a in lanes where the sign bit of @p sign is set, including -0.
  [[gnu::always_inline]] friend Pack flip_sign(Pack a, Pack sign) {
    return {Native(Mask(a.v) ^ (Mask(sign.v) & sign_bit()))};
  }
  /// a with the sign bit of @p sign; @p a must not be negative.
  [[gnu::always_inline]] friend Pack with_sign(Pack a, Pack sign) {
    return {Native(Mask(a.v) | (Mask(sign.v) & sign_bit()))};
  }
  /// One bit per lane, the lowest for the first lane.
  [[gnu::always_inline]] static unsigned bits(Mask m) { return Set::bits(m); }

 private:
  [[gnu::always_inline]] static Mask sign_bit() { return Mask(all(-0.0).v); }
};

/// A single double, without comparison and selection of lanes.
template <class Set>
struct Pack<Set, 1, false> {
  using Mask = bool;  ///< mask of one lane
  double v;           ///< the number

  [[gnu::always_inline]] static Pack all(double x) { return {x}; }
  [[gnu::always_inline]] friend Pack operator+(Pack a, Pack b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Pack operator-(Pack a, Pack b) { return {a.v - b.v}; }
  [[gnu::always_inline]] friend Pack operator*(Pack a, Pack b) { return {a.v * b.v}; }
  [[gnu::always_inline]] friend Pack operator/(Pack a, Pack b) { return {a.v / b.v}; }
  [[gnu::always_inline]] friend Pack multiply_add(Pack a, Pack b, Pack c) {
    return {Set::multiply_add(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend Pack subtract_product(Pack a, Pack b, Pack c) {
    return {Set::subtract_product(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend Pack square_root(Pack a) { return {__builtin_sqrt(a.v)}; }
  [[gnu::always_inline]] friend Pack magnitude(Pack a) { return {__builtin_fabs(a.v)}; }
  [[gnu::always_inline]] friend Mask within(Pack low, Pack x, Pack high) {
    return (low.v <= x.v) & (x.v <= high.v);
  }
};

/// Two halves of one or more registers each: independent operations hide the latency of dependent ones.
template <class Set, int n>
struct Pack<Set, n, true> {
  static constexpr int lanes = n;  ///< lanes of both halves
  using Half = Pack<Set, n / 2>;   ///< n is even
  Half a;                          ///< the first half
  Half b;                          ///< the second half

  /// Masks of both halves.
  struct Mask {
    typename Half::Mask a;  ///< mask of the first half
    typename Half::Mask b;  ///< mask of the second half

    [[gnu::always_inline]] friend Mask operator&(Mask x, Mask y) { return {x.a & y.a, x.b & y.b}; }
  };

  /// See above.
  /// @{
  [[gnu::always_inline]] static Pack all(double x) { return {Half::all(x), Half::all(x)}; }
  [[gnu::always_inline]] static Pack load(const double* from) {
    return {Half::load(from), Half::load(from + Half::lanes)};
  }
  [[gnu::always_inline]] void store(double* to) const { a.store(to), b.store(to + Half::lanes); }
  [[gnu::always_inline]] double operator[](int i) const {
    return i < Half::lanes ? a[i] : b[i - Half::lanes];
  }
  [[gnu::always_inline]] void set(int i, double x) {
    i < Half::lanes ? a.set(i, x) : b.set(i - Half::lanes, x);
  }
  [[gnu::always_inline]] friend Pack operator+(Pack x, Pack y) { return {x.a + y.a, x.b + y.b}; }
  [[gnu::always_inline]] friend Pack operator-(Pack x, Pack y) { return {x.a - y.a, x.b - y.b}; }
  [[gnu::always_inline]] friend Pack operator*(Pack x, Pack y) { return {x.a * y.a, x.b * y.b}; }
  [[gnu::always_inline]] friend Pack operator/(Pack x, Pack y) { return {x.a / y.a, x.b / y.b}; }
  [[gnu::always_inline]] friend Pack multiply_add(Pack x, Pack y, Pack z) {
    return {multiply_add(x.a, y.a, z.a), multiply_add(x.b, y.b, z.b)};
  }
  [[gnu::always_inline]] friend Pack subtract_product(Pack x, Pack y, Pack z) {
    return {subtract_product(x.a, y.a, z.a), subtract_product(x.b, y.b, z.b)};
  }
  [[gnu::always_inline]] friend Pack square_root(Pack x) { return {square_root(x.a), square_root(x.b)}; }
  [[gnu::always_inline]] friend Pack magnitude(Pack x) { return {magnitude(x.a), magnitude(x.b)}; }
  [[gnu::always_inline]] friend Pack larger(Pack x, Pack y) { return {larger(x.a, y.a), larger(x.b, y.b)}; }
  [[gnu::always_inline]] friend Pack smaller(Pack x, Pack y) {
    return {smaller(x.a, y.a), smaller(x.b, y.b)};
  }
  [[gnu::always_inline]] friend Mask operator>(Pack x, Pack y) { return {x.a > y.a, x.b > y.b}; }
  [[gnu::always_inline]] friend Mask within(Pack low, Pack x, Pack high) {
    return {within(low.a, x.a, high.a), within(low.b, x.b, high.b)};
  }
  [[gnu::always_inline]] friend Pack select(Mask m, Pack yes, Pack no) {
    return {select(m.a, yes.a, no.a), select(m.b, yes.b, no.b)};
  }
  [[gnu::always_inline]] static unsigned bits(Mask m) {
    return Half::bits(m.a) | Half::bits(m.b) << Half::lanes;
  }
  /// @}
};

/// Pack that fills one register of the set.
template <class Set>
using Widest = Pack<Set, Set::lanes>;

}  // namespace nlmech::simd

/// @file
/// Vectors of doubles behind the operations that kernels are written in. Internal to the kernels.
///
/// Every type carries the instruction set it is compiled for as a template argument. A kernel instantiated in
/// the AVX-512 file therefore has another name than the same kernel in the baseline file, and the linker can
/// never hand code for the wrong processor to either. For the same reason nothing inline of the standard
/// library is used. Multiply-adds are explicit, so that two lanes and eight round alike.
#pragma once

#include <cstdint>

namespace nlmech::simd {

/// The compiler's own vectors of @p n lanes.
template <int n>
struct Vectors {
  using Numbers [[gnu::vector_size(n * sizeof(double))]] = double;     ///< as operands
  using Mask [[gnu::vector_size(n * sizeof(double))]] = std::int64_t;  ///< all bits of a lane set or clear
};

/// Several doubles, and the operations on all of them at once.
/// @tparam Set Baseline, Avx2 or Avx512: what the compiler's own vectors cannot say
/// @tparam n number of lanes, a power of two
/// @tparam halves are they more than a register of the set has?
template <class Set, int n, bool halves = (n > Set::lanes)>
struct Pack {
  static constexpr int lanes = n;               ///< how many
  using Native = typename Vectors<n>::Numbers;  ///< the compiler's vector
  using Mask = typename Vectors<n>::Mask;       ///< all bits of a lane set or clear
  Native v;                                     ///< the numbers

  /// The same number in all lanes: x - 0 is x, be it -0.
  [[gnu::always_inline]] static Pack all(double x) { return {x - Native{}}; }
  /// One number a lane.
  template <class... Numbers>
  [[gnu::always_inline]] static Pack of(Numbers... x) {
    static_assert(sizeof...(x) == n);
    return {Native{x...}};
  }
  /// From memory, aligned or not.
  [[gnu::always_inline]] static Pack load(const double* from) {
    Pack x;
    __builtin_memcpy(&x.v, from, sizeof x.v);
    return x;
  }
  /// To memory, aligned or not.
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
  /// Lane by lane, which the compiler makes one instruction of.
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
  /// -a in lanes where the sign bit of @p sign is set, -0 among them.
  [[gnu::always_inline]] friend Pack flip_sign(Pack a, Pack sign) {
    return {Native(Mask(a.v) ^ (Mask(sign.v) & sign_bit()))};
  }
  /// |a| is given; the sign bit of @p sign is set in it.
  [[gnu::always_inline]] friend Pack with_sign(Pack a, Pack sign) {
    return {Native(Mask(a.v) | (Mask(sign.v) & sign_bit()))};
  }
  /// One bit a lane, the first lane's lowest.
  [[gnu::always_inline]] static unsigned bits(Mask m) { return Set::bits(m); }

 private:
  [[gnu::always_inline]] static Mask sign_bit() { return Mask(all(-0.0).v); }
};

/// One double, where no lanes are to be compared or chosen from.
template <class Set>
struct Pack<Set, 1, false> {
  using Mask = bool;  ///< of one lane
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

/// Two halves, of a register or more each: a kernel whose operations wait for each other has twice as many to
/// do meanwhile.
template <class Set, int n>
struct Pack<Set, n, true> {
  static constexpr int lanes = n;  ///< of both
  using Half = Pack<Set, n / 2>;   ///< n is even
  Half a;                          ///< the first half
  Half b;                          ///< the second

  /// Of both halves.
  struct Mask {
    typename Half::Mask a;  ///< of the first half
    typename Half::Mask b;  ///< of the second

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

/// As many lanes as a register of the set holds.
template <class Set>
using Widest = Pack<Set, Set::lanes>;

}  // namespace nlmech::simd

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

/// @tparam Set Baseline, Avx2 or Avx512: what the compiler's own vectors cannot say
/// @tparam n number of lanes, a power of two
template <class Set, int n>
struct Lanes {
  static constexpr int lanes = n;               ///< how many
  using Native = typename Vectors<n>::Numbers;  ///< the compiler's vector
  using Mask = typename Vectors<n>::Mask;       ///< all bits of a lane set or clear
  Native v;                                     ///< the numbers

  /// The same number in all lanes: x - 0 is x, be it -0.
  [[gnu::always_inline]] static Lanes all(double x) { return {x - Native{}}; }
  /// One number a lane.
  template <class... Numbers>
  [[gnu::always_inline]] static Lanes of(Numbers... x) {
    static_assert(sizeof...(x) == n);
    return {Native{x...}};
  }
  /// From memory, aligned or not.
  [[gnu::always_inline]] static Lanes load(const double* from) {
    Lanes x;
    __builtin_memcpy(&x.v, from, sizeof x.v);
    return x;
  }
  /// To memory, aligned or not.
  [[gnu::always_inline]] void store(double* to) const { __builtin_memcpy(to, &v, sizeof v); }
  /// Lane @p i.
  [[gnu::always_inline]] double operator[](int i) const { return v[i]; }

  [[gnu::always_inline]] friend Lanes operator+(Lanes a, Lanes b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Lanes operator-(Lanes a, Lanes b) { return {a.v - b.v}; }
  [[gnu::always_inline]] friend Lanes operator*(Lanes a, Lanes b) { return {a.v * b.v}; }
  [[gnu::always_inline]] friend Lanes operator/(Lanes a, Lanes b) { return {a.v / b.v}; }
  /// a b + c, rounded once where the instruction set can.
  [[gnu::always_inline]] friend Lanes multiply_add(Lanes a, Lanes b, Lanes c) {
    return {Set::multiply_add(a.v, b.v, c.v)};
  }
  /// c - a b, rounded once where the instruction set can.
  [[gnu::always_inline]] friend Lanes subtract_product(Lanes a, Lanes b, Lanes c) {
    return {Set::subtract_product(a.v, b.v, c.v)};
  }
  /// Lane by lane, which the compiler makes one instruction of.
  [[gnu::always_inline]] friend Lanes square_root(Lanes a) {
    for (int i = 0; i < n; ++i) a.v[i] = __builtin_sqrt(a.v[i]);
    return a;
  }
  [[gnu::always_inline]] friend Lanes magnitude(Lanes a) { return {Native(Mask(a.v) & ~sign_bit())}; }
  [[gnu::always_inline]] friend Lanes larger(Lanes a, Lanes b) { return {Set::larger(a.v, b.v)}; }
  [[gnu::always_inline]] friend Lanes smaller(Lanes a, Lanes b) { return {Set::smaller(a.v, b.v)}; }

  [[gnu::always_inline]] friend Mask operator>(Lanes a, Lanes b) { return Mask(a.v > b.v); }
  /// low <= x <= high
  [[gnu::always_inline]] friend Mask within(Lanes low, Lanes x, Lanes high) {
    return Set::both(Mask(low.v <= x.v), Mask(x.v <= high.v));
  }
  [[gnu::always_inline]] friend Lanes select(Mask m, Lanes yes, Lanes no) { return {m ? yes.v : no.v}; }
  [[gnu::always_inline]] friend Lanes negate_if(Mask m, Lanes a) {
    return {Native(Mask(a.v) ^ (m & sign_bit()))};
  }
  /// -a in lanes where the sign bit of @p sign is set, -0 among them.
  [[gnu::always_inline]] friend Lanes flip_sign(Lanes a, Lanes sign) {
    return {Native(Mask(a.v) ^ (Mask(sign.v) & sign_bit()))};
  }
  /// |a| is given; the sign bit of @p sign is set in it.
  [[gnu::always_inline]] friend Lanes with_sign(Lanes a, Lanes sign) {
    return {Native(Mask(a.v) | (Mask(sign.v) & sign_bit()))};
  }
  /// One bit a lane, the first lane's lowest.
  [[gnu::always_inline]] static unsigned bits(Mask m) { return Set::bits(m); }

 private:
  [[gnu::always_inline]] static Mask sign_bit() { return Mask(all(-0.0).v); }
};

/// One double, where no lanes are to be compared or chosen from.
template <class Set>
struct Lanes<Set, 1> {
  using Mask = bool;  ///< of one lane
  double v;           ///< the number

  [[gnu::always_inline]] static Lanes all(double x) { return {x}; }
  [[gnu::always_inline]] friend Lanes operator+(Lanes a, Lanes b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Lanes operator-(Lanes a, Lanes b) { return {a.v - b.v}; }
  [[gnu::always_inline]] friend Lanes operator*(Lanes a, Lanes b) { return {a.v * b.v}; }
  [[gnu::always_inline]] friend Lanes operator/(Lanes a, Lanes b) { return {a.v / b.v}; }
  [[gnu::always_inline]] friend Lanes multiply_add(Lanes a, Lanes b, Lanes c) {
    return {Set::multiply_add(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend Lanes subtract_product(Lanes a, Lanes b, Lanes c) {
    return {Set::subtract_product(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend Lanes square_root(Lanes a) { return {__builtin_sqrt(a.v)}; }
  [[gnu::always_inline]] friend Lanes magnitude(Lanes a) { return {__builtin_fabs(a.v)}; }
  [[gnu::always_inline]] friend Mask within(Lanes low, Lanes x, Lanes high) {
    return (low.v <= x.v) & (x.v <= high.v);
  }
};

/// As many lanes as a register of the set holds.
template <class Set>
using Widest = Lanes<Set, Set::lanes>;

}  // namespace nlmech::simd

/// @file
/// One and two lanes of doubles behind the operations that the kernels are written in. Internal to the
/// kernels.
///
/// Every type carries the instruction set it is compiled for as a template argument. A kernel instantiated in
/// the AVX-512 file therefore has another name than the same kernel in the baseline file, and the linker can
/// never hand code for the wrong processor to either. For the same reason the kernels use nothing inline from
/// the standard library. Multiply-adds are explicit, so that one lane and eight lanes round alike.
#pragma once

#include <cstdint>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace nlmech::geodesy::kernels {

struct Baseline {
  static constexpr bool fused = false;
};
struct Avx2 {
  static constexpr bool fused = true;
};
struct Avx512 {
  static constexpr bool fused = true;
};

/// One double.
template <class Set>
struct Single {
  static constexpr int lanes = 1;
  using Mask = bool;
  double v;

  [[gnu::always_inline]] static Single all(double value) { return {value}; }
  [[gnu::always_inline]] friend Single operator+(Single a, Single b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Single operator-(Single a, Single b) { return {a.v - b.v}; }
  [[gnu::always_inline]] friend Single operator*(Single a, Single b) { return {a.v * b.v}; }
  [[gnu::always_inline]] friend Single operator/(Single a, Single b) { return {a.v / b.v}; }
  /// a b + c, rounded once where the instruction set can.
  [[gnu::always_inline]] friend Single multiply_add(Single a, Single b, Single c) {
    if constexpr (Set::fused) {
      return {__builtin_fma(a.v, b.v, c.v)};
    } else {
      return {a.v * b.v + c.v};
    }
  }
  /// c - a b, rounded once where the instruction set can.
  [[gnu::always_inline]] friend Single subtract_product(Single a, Single b, Single c) {
    if constexpr (Set::fused) {
      return {__builtin_fma(-a.v, b.v, c.v)};
    } else {
      return {c.v - a.v * b.v};
    }
  }
  [[gnu::always_inline]] friend Single square_root(Single a) { return {__builtin_sqrt(a.v)}; }
  [[gnu::always_inline]] friend Single magnitude(Single a) { return {__builtin_fabs(a.v)}; }
  [[gnu::always_inline]] friend Mask within(Single low, Single x, Single high) {
    return (low.v <= x.v) & (x.v <= high.v);
  }
};

#if defined(__SSE2__)
/// Two doubles.
template <class Set>
struct Pair {
  static constexpr int lanes = 2;
  using Mask = __m128d;  ///< all bits of a lane set or clear
  __m128d v;

  [[gnu::always_inline]] static Pair all(double value) { return {_mm_set1_pd(value)}; }
  [[gnu::always_inline]] static Pair of(double first, double second) { return {_mm_set_pd(second, first)}; }
  [[gnu::always_inline]] double first() const { return _mm_cvtsd_f64(v); }
  [[gnu::always_inline]] double second() const { return _mm_cvtsd_f64(_mm_unpackhi_pd(v, v)); }
  [[gnu::always_inline]] static Pair load(const double* from) { return {_mm_loadu_pd(from)}; }
  [[gnu::always_inline]] void store(double* to) const { _mm_storeu_pd(to, v); }
  [[gnu::always_inline]] friend Pair operator+(Pair a, Pair b) { return {_mm_add_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Pair operator-(Pair a, Pair b) { return {_mm_sub_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Pair operator*(Pair a, Pair b) { return {_mm_mul_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Pair operator/(Pair a, Pair b) { return {_mm_div_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Pair multiply_add(Pair a, Pair b, Pair c) {
    if constexpr (Set::fused) {
      return {_mm_fmadd_pd(a.v, b.v, c.v)};
    } else {
      return {_mm_add_pd(_mm_mul_pd(a.v, b.v), c.v)};
    }
  }
  [[gnu::always_inline]] friend Pair subtract_product(Pair a, Pair b, Pair c) {
    if constexpr (Set::fused) {
      return {_mm_fnmadd_pd(a.v, b.v, c.v)};
    } else {
      return {_mm_sub_pd(c.v, _mm_mul_pd(a.v, b.v))};
    }
  }
  [[gnu::always_inline]] friend Pair square_root(Pair a) { return {_mm_sqrt_pd(a.v)}; }
  [[gnu::always_inline]] friend Pair magnitude(Pair a) { return {_mm_andnot_pd(_mm_set1_pd(-0.0), a.v)}; }
  [[gnu::always_inline]] friend Pair larger(Pair a, Pair b) { return {_mm_max_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Pair smaller(Pair a, Pair b) { return {_mm_min_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Mask operator>(Pair a, Pair b) { return _mm_cmpgt_pd(a.v, b.v); }
  [[gnu::always_inline]] friend Mask within(Pair low, Pair x, Pair high) {
    return _mm_and_pd(_mm_cmple_pd(low.v, x.v), _mm_cmple_pd(x.v, high.v));
  }
  /// Lanes whose sign bit is set, -0 among them. SSE2 has no 64-bit shift that keeps the sign: copy the upper
  /// word's.
  [[gnu::always_inline]] friend Mask negative(Pair a) {
    const __m128i sign = _mm_srai_epi32(_mm_castpd_si128(a.v), 31);
    return _mm_castsi128_pd(_mm_shuffle_epi32(sign, 0xF5));
  }
  [[gnu::always_inline]] friend Pair select(Mask m, Pair yes, Pair no) {
    return {_mm_or_pd(_mm_and_pd(m, yes.v), _mm_andnot_pd(m, no.v))};
  }
  [[gnu::always_inline]] friend Pair negate_if(Mask m, Pair a) {
    return {_mm_xor_pd(a.v, _mm_and_pd(m, _mm_set1_pd(-0.0)))};
  }
  /// |a| is given; the sign bit of @p sign is set in it.
  [[gnu::always_inline]] friend Pair with_sign(Pair a, Pair sign) {
    return {_mm_or_pd(a.v, _mm_and_pd(sign.v, _mm_set1_pd(-0.0)))};
  }
  /// One bit a lane, the first lane's lowest.
  [[gnu::always_inline]] static unsigned bits(Mask m) { return static_cast<unsigned>(_mm_movemask_pd(m)); }
};
#else
/// Two doubles for processors other than x86-64, left to the compiler's own vector types.
template <class Set>
struct Pair {
  static constexpr int lanes = 2;
  using Native [[gnu::vector_size(16)]] = double;
  using Mask [[gnu::vector_size(16)]] = std::int64_t;  ///< all bits of a lane set or clear
  Native v;

  [[gnu::always_inline]] static Pair all(double value) { return {Native{value, value}}; }
  [[gnu::always_inline]] static Pair of(double first, double second) { return {Native{first, second}}; }
  [[gnu::always_inline]] double first() const { return v[0]; }
  [[gnu::always_inline]] double second() const { return v[1]; }
  [[gnu::always_inline]] static Pair load(const double* from) { return of(from[0], from[1]); }
  [[gnu::always_inline]] void store(double* to) const { to[0] = v[0], to[1] = v[1]; }
  [[gnu::always_inline]] friend Pair operator+(Pair a, Pair b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Pair operator-(Pair a, Pair b) { return {a.v - b.v}; }
  [[gnu::always_inline]] friend Pair operator*(Pair a, Pair b) { return {a.v * b.v}; }
  [[gnu::always_inline]] friend Pair operator/(Pair a, Pair b) { return {a.v / b.v}; }
  [[gnu::always_inline]] friend Pair multiply_add(Pair a, Pair b, Pair c) { return {a.v * b.v + c.v}; }
  [[gnu::always_inline]] friend Pair subtract_product(Pair a, Pair b, Pair c) { return {c.v - a.v * b.v}; }
  [[gnu::always_inline]] friend Pair square_root(Pair a) {
    return of(__builtin_sqrt(a.v[0]), __builtin_sqrt(a.v[1]));
  }
  [[gnu::always_inline]] friend Pair magnitude(Pair a) { return {Native(Mask(a.v) & ~sign_bit())}; }
  [[gnu::always_inline]] friend Pair larger(Pair a, Pair b) { return select(a.v > b.v, a, b); }
  [[gnu::always_inline]] friend Pair smaller(Pair a, Pair b) { return select(a.v < b.v, a, b); }
  [[gnu::always_inline]] friend Mask operator>(Pair a, Pair b) { return a.v > b.v; }
  [[gnu::always_inline]] friend Mask within(Pair low, Pair x, Pair high) {
    return (low.v <= x.v) & (x.v <= high.v);
  }
  [[gnu::always_inline]] friend Mask negative(Pair a) { return Mask(a.v) >> 63; }
  [[gnu::always_inline]] friend Pair select(Mask m, Pair yes, Pair no) {
    return {Native((m & Mask(yes.v)) | (~m & Mask(no.v)))};
  }
  [[gnu::always_inline]] friend Pair negate_if(Mask m, Pair a) {
    return {Native(Mask(a.v) ^ (m & sign_bit()))};
  }
  [[gnu::always_inline]] friend Pair with_sign(Pair a, Pair sign) {
    return {Native(Mask(a.v) | (Mask(sign.v) & sign_bit()))};
  }
  [[gnu::always_inline]] static unsigned bits(Mask m) {
    return (m[0] != 0 ? 1u : 0u) | (m[1] != 0 ? 2u : 0u);
  }

 private:
  [[gnu::always_inline]] static Mask sign_bit() { return Mask(Native{-0.0, -0.0}); }
};
#endif

}  // namespace nlmech::geodesy::kernels

/// @file
/// Eight doubles in an AVX-512 register: the operations of lanes.hpp. Internal to the kernels.
#pragma once

#include "nlmech/geodesy/kernels/lanes.hpp"

namespace nlmech::geodesy::kernels {

struct Octet {
  static constexpr int lanes = 8;
  using Mask = __mmask8;
  /// GCC 12 warns of its own uninitialised operand in the forms without a mask (its bug 105593); the code is
  /// the same.
  static constexpr Mask every = 0xFF;
  __m512d v;

  [[gnu::always_inline]] static Octet all(double value) { return {_mm512_set1_pd(value)}; }
  [[gnu::always_inline]] static Octet load(const double* from) { return {_mm512_loadu_pd(from)}; }
  [[gnu::always_inline]] void store(double* to) const { _mm512_storeu_pd(to, v); }
  [[gnu::always_inline]] friend Octet operator+(Octet a, Octet b) { return {_mm512_add_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Octet operator-(Octet a, Octet b) { return {_mm512_sub_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Octet operator*(Octet a, Octet b) { return {_mm512_mul_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Octet operator/(Octet a, Octet b) { return {_mm512_div_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Octet multiply_add(Octet a, Octet b, Octet c) {
    return {_mm512_fmadd_pd(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend Octet subtract_product(Octet a, Octet b, Octet c) {
    return {_mm512_fnmadd_pd(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend Octet square_root(Octet a) { return {_mm512_maskz_sqrt_pd(every, a.v)}; }
  [[gnu::always_inline]] friend Octet magnitude(Octet a) {
    return {_mm512_andnot_pd(_mm512_set1_pd(-0.0), a.v)};
  }
  [[gnu::always_inline]] friend Octet larger(Octet a, Octet b) {
    return {_mm512_maskz_max_pd(every, a.v, b.v)};
  }
  [[gnu::always_inline]] friend Octet smaller(Octet a, Octet b) {
    return {_mm512_maskz_min_pd(every, a.v, b.v)};
  }
  [[gnu::always_inline]] friend Mask operator>(Octet a, Octet b) {
    return _mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ);
  }
  [[gnu::always_inline]] friend Mask within(Octet low, Octet x, Octet high) {
    return _mm512_mask_cmp_pd_mask(_mm512_cmp_pd_mask(low.v, x.v, _CMP_LE_OQ), x.v, high.v, _CMP_LE_OQ);
  }
  [[gnu::always_inline]] friend Mask negative(Octet a) {
    return _mm512_movepi64_mask(_mm512_castpd_si512(a.v));
  }
  [[gnu::always_inline]] friend Octet select(Mask m, Octet yes, Octet no) {
    return {_mm512_mask_blend_pd(m, no.v, yes.v)};
  }
  [[gnu::always_inline]] friend Octet negate_if(Mask m, Octet a) {
    return {_mm512_mask_xor_pd(a.v, m, a.v, _mm512_set1_pd(-0.0))};
  }
  [[gnu::always_inline]] friend Octet with_sign(Octet a, Octet sign) {
    return {_mm512_or_pd(a.v, _mm512_and_pd(sign.v, _mm512_set1_pd(-0.0)))};
  }
  [[gnu::always_inline]] static unsigned bits(Mask m) { return m; }
};

}  // namespace nlmech::geodesy::kernels

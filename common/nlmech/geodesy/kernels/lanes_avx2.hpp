/// @file
/// Four doubles in an AVX register: the operations of lanes.hpp. Internal to the kernels.
#pragma once

#include "nlmech/geodesy/kernels/lanes.hpp"

namespace nlmech::geodesy::kernels {

struct Quad {
  static constexpr int lanes = 4;
  using Mask = __m256d;  ///< all bits of a lane set or clear; selection looks at the sign bit alone
  __m256d v;

  [[gnu::always_inline]] static Quad all(double value) { return {_mm256_set1_pd(value)}; }
  [[gnu::always_inline]] static Quad load(const double* from) { return {_mm256_loadu_pd(from)}; }
  [[gnu::always_inline]] void store(double* to) const { _mm256_storeu_pd(to, v); }
  [[gnu::always_inline]] friend Quad operator+(Quad a, Quad b) { return {_mm256_add_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Quad operator-(Quad a, Quad b) { return {_mm256_sub_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Quad operator*(Quad a, Quad b) { return {_mm256_mul_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Quad operator/(Quad a, Quad b) { return {_mm256_div_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Quad multiply_add(Quad a, Quad b, Quad c) {
    return {_mm256_fmadd_pd(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend Quad subtract_product(Quad a, Quad b, Quad c) {
    return {_mm256_fnmadd_pd(a.v, b.v, c.v)};
  }
  [[gnu::always_inline]] friend Quad square_root(Quad a) { return {_mm256_sqrt_pd(a.v)}; }
  [[gnu::always_inline]] friend Quad magnitude(Quad a) {
    return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), a.v)};
  }
  [[gnu::always_inline]] friend Quad larger(Quad a, Quad b) { return {_mm256_max_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Quad smaller(Quad a, Quad b) { return {_mm256_min_pd(a.v, b.v)}; }
  [[gnu::always_inline]] friend Mask operator>(Quad a, Quad b) { return _mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ); }
  [[gnu::always_inline]] friend Mask within(Quad low, Quad x, Quad high) {
    return _mm256_and_pd(_mm256_cmp_pd(low.v, x.v, _CMP_LE_OQ), _mm256_cmp_pd(x.v, high.v, _CMP_LE_OQ));
  }
  [[gnu::always_inline]] friend Mask negative(Quad a) { return a.v; }
  [[gnu::always_inline]] friend Quad select(Mask m, Quad yes, Quad no) {
    return {_mm256_blendv_pd(no.v, yes.v, m)};
  }
  [[gnu::always_inline]] friend Quad negate_if(Mask m, Quad a) {
    return {_mm256_xor_pd(a.v, _mm256_and_pd(m, _mm256_set1_pd(-0.0)))};
  }
  [[gnu::always_inline]] friend Quad with_sign(Quad a, Quad sign) {
    return {_mm256_or_pd(a.v, _mm256_and_pd(sign.v, _mm256_set1_pd(-0.0)))};
  }
  [[gnu::always_inline]] static unsigned bits(Mask m) { return static_cast<unsigned>(_mm256_movemask_pd(m)); }
};

}  // namespace nlmech::geodesy::kernels

/// @file
/// Branch-free four-quadrant arctangent for the kernels. Internal.
#pragma once

namespace nlmech::geodesy::kernels {

/// (atan(t)/t - 1)/t^2 as a polynomial in t^2, minimax for the absolute error of atan(t) on |t| <= tan(pi/8),
/// which is 8.7e-18 with the coefficients rounded to double. Computed by tools/arctangent_minimax.cpp.
inline constexpr double arctangent_coefficients[10] = {
    -0x1.5555555554f9ap-2, 0x1.99999998f9cbcp-3, -0x1.249248f053a2bp-3, 0x1.c71c600c6008fp-4,
    -0x1.745b4e5479b66p-4, 0x1.3af68290088d2p-4, -0x1.0fd8c1f53afeap-4, 0x1.d0af5b0308e8ep-5,
    -0x1.60be15cf97ba5p-5, 0x1.527e5ae467d62p-6};

/// (atan(t) - t)/t^3 by Horner's rule in t^4, separately for even and odd terms: half the latency for one
/// additional product.
template <class V>
[[gnu::always_inline]] inline V arctangent_tail(V w) {
  const auto& c = arctangent_coefficients;
  const V w2 = w * w;
  V even = V::all(c[8]), odd = V::all(c[9]);
  for (int k = 6; k >= 0; k -= 2) {
    even = multiply_add(even, w2, V::all(c[k]));
    odd = multiply_add(odd, w2, V::all(c[k + 1]));
  }
  return multiply_add(odd, w, even);
}

/// atan2(|y|, x) + correction: an angle from 0 to pi; the caller applies the sign of y.
///
/// The half plane is folded to |t| <= tan(pi/8), where angle = base +- atan(t), with one division:
///   small <= tan(pi/8) big: t = small/big;  otherwise t = (small - big)/(small + big), relative to the
///   diagonal.
/// The base is a multiple of pi/4 with its rounding error as a second term, lambda base; all multiples share
/// one lambda since pi/2, 3 pi/4 and pi in double precision are exact multiples of pi/4 in double precision.
/// @param half_plane x may be negative (including -0: then the angle is pi); otherwise x >= +0 is assumed
template <bool half_plane, class V>
[[gnu::always_inline]] inline V arctangent(V y_magnitude, V x, V correction) {
  const V quarter = V::all(0x1.921fb54442d18p-1), half = V::all(0x1.921fb54442d18p+0);
  const V lambda = V::all(0x1.1a62633145c07p-54 / 0x1.921fb54442d18p+0);
  const V x_magnitude = half_plane ? magnitude(x) : x;
  // The smallest positive number in place of 0/0 gives atan2(0, +0) = 0 and changes no other quotient.
  const V big = larger(larger(x_magnitude, y_magnitude), V::all(0x1p-1074));
  const V small = smaller(x_magnitude, y_magnitude);
  const auto diagonal = small > V::all(0x1.a827999fcef32p-2) * big;  // tan(pi/8)
  const auto steep = y_magnitude > x_magnitude;

  V numerator = negate_if(steep, select(diagonal, small - big, small));
  V base = select(diagonal, quarter, select(steep, half, V::all(0)));
  if constexpr (half_plane) {  // mirrored at the axis of y
    numerator = flip_sign(numerator, x);
    base = half - flip_sign(half - base, x);
  }
  const V t = numerator / select(diagonal, small + big, big);
  const V w = t * t;
  // Add the smallest terms first, so that only the last addition rounds at the size of the result.
  return base + (t + (multiply_add(t * w, arctangent_tail(w), lambda * base) + correction));
}

}  // namespace nlmech::geodesy::kernels

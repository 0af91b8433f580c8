/// @file
/// Vectorised peers, with the SIMD lanes and the arctangent of the nlmech kernel, so that a comparison
/// measures only the methods. Each is homogeneous in the sine and cosine of the iterated angle, and hence has
/// no division before the last one and, if the method permits, no special case at the poles. Lengths are in
/// units of a.
#pragma once

#include "nlmech/geodesy/kernels/reverse_kernel.hpp"
#include "nlmech/peers/geodesy/simd_peers.hpp"

namespace nlmech::peers::geodesy {

using nlmech::geodesy::kernels::Meridian;

template <class V>
struct Projected {
  V r, z, r2, z2;  ///< |z|
};

template <class V>
[[gnu::always_inline]] inline Projected<V> project(V x, V y, V z, const UnitEllipsoid& k) {
  const V unit = V::all(k.inverse_a), r2 = multiply_add(x, x, y * y);
  return {square_root(r2) * unit, magnitude(z) * unit, r2, z * z};
}

/// Height from S : C = sin phi : cos phi: h = (r C + z S - W)/H, W^2 = C^2 + (1 - e^2) S^2, H^2 = C^2 +
/// S^2 (Bowring 1985).
template <class V>
[[gnu::always_inline]] inline Meridian<V> finish(V S, V C, const Projected<V>& p, const UnitEllipsoid& k) {
  const V S2 = S * S, H2 = multiply_add(C, C, S2);
  const V W = square_root(subtract_product(V::all(k.e2), S2, H2));
  const V h = multiply_add(p.r, C, multiply_add(p.z, S, V::all(0) - W)) * V::all(k.a) / square_root(H2);
  return {S, C, V::all(0), h, within(H2, H2, H2)};
}

/// tan phi = (z + e'^2 b sin^3 beta)/(r - e^2 a cos^3 beta) for s : c = sin beta : cos beta.
template <class V>
[[gnu::always_inline]] inline void bowring_step(V& s, V& c, const Projected<V>& p, const UnitEllipsoid& k) {
  const V n2 = multiply_add(s, s, c * c), n3 = n2 * square_root(n2);
  const V S = multiply_add(V::all(k.second_e2 * k.b) * (s * s), s, p.z * n3);
  c = subtract_product(V::all(k.e2) * (c * c), c, p.r * n3);
  s = S;
}

/// Bowring's iteration from an initial s : c.
template <int iterations, class V>
[[gnu::always_inline]] inline Meridian<V> bowring(V s, V c, const Projected<V>& p, const UnitEllipsoid& k) {
  bowring_step(s, c, p, k);
  for (int n = 1; n < iterations; ++n) {
    s = s * V::all(k.b);
    bowring_step(s, c, p, k);
  }
  return finish(s, c, p, k);
}

/// Bowring, Survey Review 23 (1976) 323-327.
template <int iterations>
struct SimdBowring1976 {
  template <class V>
  [[gnu::always_inline]] static Meridian<V> meridian(V x, V y, V z, const UnitEllipsoid& k) {
    const Projected<V> p = project(x, y, z, k);
    const V s = p.z, c = p.r * V::all(k.b);
    return bowring<iterations>(s, c, p, k);
  }
};

/// Bowring, Survey Review 28 (1985) 202-206: the start tan beta = b z/(a r) (1 + e'^2 b/R).
template <int iterations>
struct SimdBowring1985 {
  template <class V>
  [[gnu::always_inline]] static Meridian<V> meridian(V x, V y, V z, const UnitEllipsoid& k) {
    const Projected<V> p = project(x, y, z, k);
    const V R = square_root(p.r2 + p.z2) * V::all(k.inverse_a);
    const V s = p.z * multiply_add(V::all(k.b), R, V::all(k.second_e2 * k.b * k.b)), c = p.r * R;
    return bowring<iterations>(s, c, p, k);
  }
};

/// Fukushima, Journal of Geodesy 79 (2006) 689-693: Halley's method for S : C = sin beta : cos beta.
template <int iterations>
struct SimdFukushima2006 {
  template <class V>
  [[gnu::always_inline]] static Meridian<V> meridian(V x, V y, V z, const UnitEllipsoid& k) {
    const Projected<V> p = project(x, y, z, k);
    const V E = V::all(k.e2), Z = p.z * V::all(k.b);
    V S = Z, C = p.r * V::all(k.b);
    for (int n = 0; n < iterations; ++n) {
      const V A2 = multiply_add(S, S, C * C), A = square_root(A2), A3 = A2 * A, SC = S * C;
      const V B = V::all(1.5) * E * C * SC * subtract_product(E, SC, A * subtract_product(Z, C, p.r * S));
      const V D = multiply_add(E * S, S * S, Z * A3), F = subtract_product(E * C, C * C, p.r * A3);
      S = subtract_product(B, S, D * F);
      C = subtract_product(B, C, F * F);
    }
    const auto pole = V::all(1e-30) > p.r;  // S and C both vanish there
    return finish(select(pole, V::all(1), S), C * V::all(k.b), p, k);
  }
};

struct TwoArctangents {
  template <class V>
  [[gnu::always_inline]] static Meridian<V> meridian(V x, V y, V z, const UnitEllipsoid&) {
    return {magnitude(z), magnitude(x), V::all(0), y, within(x, x, x)};
  }
};

template <class Method, class V>
void simd_batch(const UnitEllipsoid& k, const SimdArrays& p) noexcept {
  namespace kernels = nlmech::geodesy::kernels;
  for (std::size_t i = 0; i < p.size; i += V::lanes) {
    const V x = V::load(p.x + i), y = V::load(p.y + i), z = V::load(p.z + i);
    const Meridian<V> g = Method::template meridian<V>(x, y, z, k);
    with_sign(kernels::arctangent<false>(g.y, g.x, g.correction), z).store(p.latitude + i);
    with_sign(kernels::arctangent<true>(magnitude(y), x, V::all(0)), y).store(p.longitude + i);
    g.height.store(p.height + i);
  }
}

/// Table of the methods in the order of SimdMethod.
template <class V>
inline constexpr SimdTable simd_table = {
    simd_batch<TwoArctangents, V>,      simd_batch<SimdBowring1976<1>, V>,
    simd_batch<SimdBowring1976<2>, V>,  simd_batch<SimdBowring1985<1>, V>,
    simd_batch<SimdBowring1985<2>, V>,  simd_batch<SimdFukushima2006<1>, V>,
    simd_batch<SimdFukushima2006<2>, V>};

}  // namespace nlmech::peers::geodesy

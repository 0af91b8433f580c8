/// @file
/// The fast reverse transformation for any number of lanes. Internal: included by the file of each
/// instruction set.
#pragma once

#include "nlmech/geodesy/kernels/arctangent.hpp"
#include "nlmech/geodesy/kernels/kernel.hpp"
#include "nlmech/support/kernels/pack.hpp"

namespace nlmech::geodesy::kernels {

/// Latitude as the angle of (x, y) plus a small correction, height, and their validity.
template <class V>
struct Meridian {
  V y, x, correction, height;
  typename V::Mask valid;
};

/// The polynomial F(q, m), evaluated in pairs of terms: as many multiply-adds as Horner's rule and half the
/// latency.
template <class V>
[[gnu::always_inline]] inline V economised(V q, V m, const Constants& k) {
  static_assert(Constants::q_terms == 5 && Constants::m_terms == 6);
  const V q2 = q * q, m2 = m * m;
  V row[Constants::q_terms];
  for (int i = 0; i < Constants::q_terms; ++i) {
    const auto& c = k.tangent[i];
    const V high = multiply_add(V::all(c[5]), m, V::all(c[4]));
    const V middle = multiply_add(V::all(c[3]), m, V::all(c[2]));
    const V low = multiply_add(V::all(c[1]), m, V::all(c[0]));
    row[i] = multiply_add(multiply_add(high, m2, middle), m2, low);
  }
  const V high = multiply_add(row[4], q2, multiply_add(row[3], q, row[2]));
  return multiply_add(high, q2, multiply_add(row[1], q, row[0]));
}

/// u = T/(s c), the tangent of the angle between geodetic and geocentric latitude without its trigonometric
/// factors: the economised series, corrected by Newton's method on  u W - e^2 q A B = 0.
template <int corrections, class V>
[[gnu::always_inline]] inline V tangent(V q, V m, V c2, const Constants& k) {
  V u = q * economised(q, m, k);
  const V one = V::all(1), e2 = V::all(k.e2);
  for (int n = 0; n < corrections; ++n) {
    const V up = multiply_add(c2, u, one), in = subtract_product(m, u, one);  // A and B
    const V mc2 = m * c2, eq = e2 * q;
    const V W2 = multiply_add(mc2 * u, u, subtract_product(e2 * m, up * up, one));
    const V W = square_root(W2);
    const V residual = subtract_product(eq * up, in, u * W);
    // Slope times W: one division per correction instead of two.
    const V slope = multiply_add(mc2 * u, subtract_product(e2, up, u), W2) - eq * W * (c2 * in - m * up);
    u = u - residual * W / slope;
  }
  return u;
}

/// All of the transformation except the two arctangents.
template <int corrections, class V>
[[gnu::always_inline]] inline Meridian<V> meridian(V x, V y, V z, const Constants& k) {
  const V one = V::all(1);
  const V r2 = multiply_add(x, x, y * y), R2 = multiply_add(z, z, r2);
  const V r = square_root(r2), R = square_root(R2);
  // 1/R^2 does not depend on the square root of R^2, unlike 1/R.
  const V inverse2 = one / R2, z_magnitude = magnitude(z);
  const V m = z * z * inverse2, c2 = r2 * inverse2, q = V::all(k.a) * R * inverse2;
  const V u = tangent<corrections>(q, m, c2, k);
  const V T = z_magnitude * r * inverse2 * u, T2 = T * T, A = multiply_add(c2, u, one);

  // h = (R - a W)/sqrt(1 + T^2), the projection on the normal: an error of T enters squared.
  const V W = square_root(multiply_add(T, T, subtract_product(V::all(k.e2) * (m * A), A, one)));
  const V difference = subtract_product(V::all(k.a), W, R);
  Meridian<V> result{z_magnitude, r, V::all(0), difference,
                     within(V::all(k.nearest2), R2, V::all(k.farthest2))};
  if constexpr (corrections == 0) {
    // |T| < 0.005 q. The next terms are T^7/7 < 2e-17 of the angle, and 5/16 T^6 of the height, which is
    // small where T is not: less than 1e-9 m for the Earth.
    const V cosine = multiply_add(T2, multiply_add(T2, V::all(3. / 8), V::all(-.5)), one);
    result.height = difference * cosine;
    result.correction = multiply_add(T * T2, multiply_add(T2, V::all(1. / 5), V::all(-1. / 3)), T);
  } else {
    result.height = difference / square_root(one + T2);
    result.y = z_magnitude * A;
    result.x = r * subtract_product(m, u, one);
  }
  return result;
}

/// Two angles at once: latitude in the first lane, longitude in the second.
template <class Set, int corrections>
Position reverse_point(const Constants& k, double x, double y, double z) noexcept {
  using One = simd::Pack<Set, 1>;
  using Two = simd::Pack<Set, 2>;
  const Meridian<One> g = meridian<corrections>(One{x}, One{y}, One{z}, k);
  const Two angles =
      arctangent<true>(magnitude(Two::of(g.y.v, y)), Two::of(g.x.v, x), Two::of(g.correction.v, 0.0));
  const Two result = with_sign(angles, Two::of(z, y));
  return {result[0], result[1], g.height.v, g.valid};
}

/// Transforms one vector of points from x, y, z to latitude, longitude, height. @return one bit for each
/// point that is not valid
template <class V, int corrections>
[[gnu::always_inline]] inline unsigned reverse_lanes(const Constants& k, V x, V y, V z, double* latitude,
                                                     double* longitude, double* height) {
  const Meridian<V> g = meridian<corrections>(x, y, z, k);
  with_sign(arctangent<false>(g.y, g.x, g.correction), z).store(latitude);
  with_sign(arctangent<true>(magnitude(y), x, V::all(0)), y).store(longitude);
  g.height.store(height);
  return V::bits(g.valid) ^ ((1u << V::lanes) - 1);
}

/// Computes the points marked in @p bits by ClosestPoint. The inputs are in registers, so an output may be
/// the same array as an input.
template <class V>
void redo_lanes(unsigned bits, V x, V y, V z, const ClosestPoint& exact, const Arrays& p, std::size_t first,
                Tally& tally) noexcept {
  double xs[V::lanes], ys[V::lanes], zs[V::lanes];
  x.store(xs), y.store(ys), z.store(zs);
  for (int lane = 0; lane < V::lanes; ++lane) {
    if (bits >> lane & 1)
      redo(exact, xs[lane], ys[lane], zs[lane], p, first + static_cast<unsigned>(lane), tally);
  }
}

template <class V, int corrections>
Tally reverse_batch(const Constants& k, const ClosestPoint& exact, const Arrays& p) noexcept {
  constexpr std::size_t lanes = V::lanes;
  Tally tally;
  std::size_t i = 0;
  for (; i + lanes <= p.size; i += lanes) {
    const V x = V::load(p.x + i), y = V::load(p.y + i), z = V::load(p.z + i);
    const unsigned bits =
        reverse_lanes<V, corrections>(k, x, y, z, p.latitude + i, p.longitude + i, p.height + i);
    if (bits != 0) [[unlikely]]
      redo_lanes(bits, x, y, z, exact, p, i, tally);
  }
  if (i == p.size) return tally;

  // The remaining points use the same code, padded with a valid point, so that results do not depend on the
  // index.
  double xs[lanes], ys[lanes] = {}, zs[lanes] = {}, out[3][lanes];
  const std::size_t rest = p.size - i;
  for (std::size_t lane = 0; lane < lanes; ++lane) xs[lane] = k.a;
  for (std::size_t lane = 0; lane < rest; ++lane) {
    xs[lane] = p.x[i + lane], ys[lane] = p.y[i + lane], zs[lane] = p.z[i + lane];
  }
  const V x = V::load(xs), y = V::load(ys), z = V::load(zs);
  const unsigned bits =
      reverse_lanes<V, corrections>(k, x, y, z, out[0], out[1], out[2]) & ((1u << rest) - 1);
  for (std::size_t lane = 0; lane < rest; ++lane) {
    p.latitude[i + lane] = out[0][lane];
    p.longitude[i + lane] = out[1][lane];
    p.height[i + lane] = out[2][lane];
  }
  if (bits != 0) redo_lanes(bits, x, y, z, exact, p, i, tally);
  return tally;
}

/// The kernels of one instruction set.
template <class Set, class V = simd::Widest<Set>>
inline constexpr Kernel kernel = {{reverse_point<Set, 0>, reverse_point<Set, 1>, reverse_point<Set, 2>},
                                  {reverse_batch<V, 0>, reverse_batch<V, 1>, reverse_batch<V, 2>}};

}  // namespace nlmech::geodesy::kernels

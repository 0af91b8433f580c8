/// @file
/// The recurrences of analytic continuation with unrolled sums, for any instruction set. Internal to the
/// kernels.
#pragma once

#include <cmath>

#include "nlmech/orbit/kernels/kernel.hpp"
#include "nlmech/support/kernels/pack.hpp"

namespace nlmech::orbit::kernels {

// Normalised coefficients of f = r.r (Eq. 3.61), g = -mu f^(-3/2) (Eqs 3.63, 3.66 as corrected) and r (3.68):
//
//     g_n = -(P_n + Q_n/(2n))/f_0,  P_n = sum_{m=1}^{n} f_m g_{n-m},  Q_n = sum_{m=1}^{n} m f_m g_{n-m}
//     r_{n+2} = sum_{m=0}^{n} r_m g_{n-m} / ((n + 1)(n + 2))
//
// f itself needs no sum over products of r (3.62). With r'' = g r it follows from 3.61 that
// f''' = 2 mu (f^(-1/2))', and as f g = -mu f^(-1/2) has the coefficients -Q_n/(2n),
//
//     f_{n+2} = Q_n/(n (n + 1)(n + 2)).
//
// The sums for r, P and Q use the same g: r_m, f_m and m f_m are stored in one pack, and each term is one
// multiply-add with g in all lanes.
//
// The dependency chain from one order to the next limits the speed, not the number of operations. Sums
// therefore have independent parts, and the last operations of a new number are multiply-adds with
// precomputed terms:
//
//     r_{n+2} = u_n + w_n g_n,  w_n = r_0/((n + 1)(n + 2))
//     g_n = (all that needs neither g_{n-1} nor f_n) - (1 + 1/(2n)) (f_1/f_0) g_{n-1} - (3/2) (g_0/f_0) f_n

/// 1/d = high + low in twice the precision: a rounded reciprocal has the same relative error in every step,
/// and the energy would drift linearly. Without fused multiply-add the product with high is rounded, so a
/// division is used instead.
struct Reciprocal {
  double d, high, low;
};
constexpr Reciprocal reciprocal(int d) {
  // 1 - d high is exact in two pieces: high is split so that its products with a small integer are exact.
  const double high = 1.0 / d, split = high * 134217729.0, top = split - (split - high);
  return {static_cast<double>(d), high, ((1 - d * top) - d * (high - top)) / d};
}

/// The first three lanes of @p r, then @p a and @p b.
template <class Set>
[[gnu::always_inline]] inline simd::Pack<Set, 8> joined(simd::Pack<Set, 4> r, double a, double b) {
  using Four = simd::Pack<Set, 4>;
  r.set(3, a);
  if constexpr (Set::lanes < 8) {
    return {r, Four::all(b)};
  } else {
    return {__builtin_shufflevector(r.v, Four::all(b).v, 0, 1, 2, 3, 4, 5, 6, 7)};
  }
}
template <class Set>
[[gnu::always_inline]] inline simd::Pack<Set, 4> first_four(simd::Pack<Set, 8> x) {
  if constexpr (Set::lanes < 8) {
    return x.a;
  } else {
    return {__builtin_shufflevector(x.v, x.v, 0, 1, 2, 3)};
  }
}

/// Sum of the first three lanes.
template <class Set>
[[gnu::always_inline]] inline double sum3(simd::Pack<Set, 4> a) {
  return (a[0] + a[1]) + a[2];
}

template <class Set>
struct Taylor {
  using Four = simd::Pack<Set, 4>;
  using Five = simd::Pack<Set, 8>;  ///< r, f and m f; three lanes are unused
  static constexpr int size = most_unrolled + 1;

  Five five[size];
  Four r[size];
  double f[size + 1], g[size];
  double f0_inverse, f1_ratio, f_factor;  ///< 1/f_0, f_1/f_0, (3/2) g_0/f_0
  Coefficients& c;

  [[gnu::always_inline]] explicit Taylor(Coefficients& out) : c(out) {}

  [[gnu::always_inline]] static double over(double x, Reciprocal d) {
    if constexpr (Set::fuses) {
      return Set::multiply_add(x, d.high, x * d.low);
    } else {
      return x / d.d;
    }
  }
  [[gnu::always_inline]] static Four over(Four x, Reciprocal d) {
    if constexpr (Set::fuses) {
      return multiply_add(x, Four::all(d.high), x * Four::all(d.low));
    } else {
      return x / Four::all(d.d);
    }
  }

  /// Computes all quantities of orders 0 and 1.
  [[gnu::always_inline]] void start(double mu) {
    r[0] = Four::load(c.row[0]);
    r[1] = Four::load(c.row[1]);
    f[0] = sum3(r[0] * r[0]);
    f0_inverse = 1 / f[0];
    g[0] = -mu * f0_inverse / std::sqrt(f[0]);
    r[2] = r[0] * Four::all(0.5 * g[0]);
    r[2].store(c.row[2]);
    f[1] = 2 * sum3(r[0] * r[1]);
    f[2] = Set::multiply_add(f[0], g[0], sum3(r[1] * r[1]));
    five[1] = joined<Set>(r[1], f[1], f[1]);
    f1_ratio = f[1] * f0_inverse;
    f_factor = 1.5 * g[0] * f0_inverse;
    g[1] = -f_factor * f[1];
    f[3] = over(f[1] * g[0], reciprocal(6));
    next<1>(r[1] * Four::all(g[0]));
  }

  /// r_{n+2} from g_n and the sum without r_0 g_n.
  template <int n>
  [[gnu::always_inline]] void next(Four sum) {
    constexpr Reciprocal d = reciprocal((n + 1) * (n + 2));
    r[n + 2] = multiply_add(over(r[0], d), Four::all(g[n]), over(sum, d));
    r[n + 2].store(c.row[n + 2]);
  }

  /// g_n, f_{n+2} and r_{n+2} for n > 1.
  template <int n>
  [[gnu::always_inline]] void order() {
    five[n] = joined<Set>(r[n], f[n], n * f[n]);
    const double factor = f1_ratio + over(f1_ratio, reciprocal(2 * n));
    const double known_late = Set::multiply_add(factor, g[n - 1], f_factor * f[n]);
    double q = Set::multiply_add(f[1], g[n - 1], n * (f[n] * g[0]));
    Four sum = multiply_add(r[1], Four::all(g[n - 1]), r[n] * Four::all(g[0]));
    if constexpr (n == 2) {
      g[2] = -known_late;
    } else {
      // Terms m = 2 .. n - 1 in parts, the one with g_{n-2} last.
      constexpr int parts = n > 14 ? 3 : n > 6 ? 2 : 1;
      Five part[3] = {five[n - 1] * Five::all(g[1]), Five::all(0), Five::all(0)};
      if constexpr (parts > 1) part[1] = five[n - 2] * Five::all(g[2]);
      if constexpr (parts > 2) part[2] = five[n - 3] * Five::all(g[3]);
#pragma GCC unroll 40
      for (int m = n - 1 - parts; m >= 3; --m)
        part[(n - 1 - m) % parts] = multiply_add(five[m], Five::all(g[n - m]), part[(n - 1 - m) % parts]);
      Five all = part[0];
      if constexpr (parts > 2) part[1] = part[1] + part[2];
      if constexpr (parts > 1) all = all + part[1];
      if constexpr (n > 3) all = multiply_add(five[2], Five::all(g[n - 2]), all);
      const double known = all[3] + over(all[4], reciprocal(2 * n));
      g[n] = -Set::multiply_add(known, f0_inverse, known_late);
      q += all[4];
      sum = sum + first_four<Set>(all);
    }
    f[n + 2] = over(q, reciprocal(n * (n + 1) * (n + 2)));
    next<n>(sum);
  }

  /// Orders from n up to @p wanted.
  template <int n>
  [[gnu::always_inline]] void orders(int wanted) {
    order<n>();
    if constexpr (n + 2 < most_unrolled) {
      if constexpr (n + 2 >= least_unrolled) {
        if (n + 2 == wanted) return;
      }
      orders<n + 1>(wanted);
    }
  }

  static void expand(double mu, int order, Coefficients& c) noexcept {
    Taylor t(c);
    t.start(mu);
    t.template orders<2>(order);
  }

  struct Change {
    Four position, velocity;
  };
  /// sum_{k>=1} r_k h^k and sum_{k>=2} k r_k h^(k-1), summed separately for k = 0 .. 3 modulo 4, to shorten
  /// the dependency chain of Horner's rule.
  [[gnu::always_inline]] static Change change(const Coefficients& c, int order, double h) {
    const Four step = Four::all(h), square = step * step, fourth = square * square;
    Four p[4], v[4];  // terms of position and velocity
    int base = order & ~3;
    for (int j = 0; j < 4; ++j) {
      p[j] = base + j <= order ? Four::load(c.row[base + j]) : Four::all(0);
      v[j] = p[j] * Four::all(base + j);
    }
    if (base == 0) p[0] = v[0] = v[1] = Four::all(0);
    for (base -= 4; base > 0; base -= 4) {
#pragma GCC unroll 4
      for (int j = 0; j < 4; ++j) {
        const Four row = Four::load(c.row[base + j]);
        p[j] = multiply_add(p[j], fourth, row);
        v[j] = multiply_add(v[j], fourth, row * Four::all(base + j));
      }
    }
    // p[0] starts with r_4 and v[1] with 5 r_5: row 0, and row 1 of the velocity, are not part of the change.
    if (base == 0) {
      const Four third = Four::load(c.row[3]), second = Four::load(c.row[2]);
      p[1] = multiply_add(p[1], fourth, Four::load(c.row[1]));
      p[2] = multiply_add(p[2], fourth, second);
      p[3] = multiply_add(p[3], fourth, third);
      v[2] = multiply_add(v[2], fourth, second + second);
      v[3] = multiply_add(v[3], fourth, third * Four::all(3));
    }
    return {multiply_add(multiply_add(p[0], step, p[3]), square, multiply_add(p[2], step, p[1])) * step,
            multiply_add(multiply_add(v[1], step, v[0]), square, multiply_add(v[3], step, v[2])) * step};
  }

  static void increments(const Coefficients& c, int order, double h, double* position,
                         double* velocity) noexcept {
    const Change d = change(c, order, h);
    d.position.store(position);
    d.velocity.store(velocity);
  }

  /// high + low + change, exact to the rounding of low + change (Knuth's two-sum, for operands in any order).
  [[gnu::always_inline]] static void add(double* high, double* low, Four change, double keep) {
    const Four a = Four::load(high), b = Four::load(low) + change;
    const Four sum = a + b, virtual_b = sum - a;
    sum.store(high);
    (((a - (sum - virtual_b)) + (b - virtual_b)) * Four::all(keep)).store(low);
  }

  static void advance(const Coefficients& c, int order, double h, bool compensated, Body& body) noexcept {
    const Change d = change(c, order, h);
    const double keep = compensated ? 1 : 0;
    add(body.position, body.position_low, d.position, keep);
    add(body.velocity, body.velocity_low, d.velocity, keep);
  }
};

template <class Set>
inline constexpr Kernel kernel = {Taylor<Set>::expand, Taylor<Set>::increments, Taylor<Set>::advance};

}  // namespace nlmech::orbit::kernels

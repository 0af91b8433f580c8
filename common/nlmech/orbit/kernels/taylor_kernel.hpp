/// @file
/// The recurrences of analytic continuation with unrolled sums, for any set of lanes. Internal to the
/// kernels.
#pragma once

#include <cmath>

#include "nlmech/orbit/kernels/kernel.hpp"

namespace nlmech::orbit::kernels {

// Normalised coefficients of f = r.r (Eq. 3.62), g = -mu f^(-3/2) (Eqs 3.63, 3.66 as corrected) and r (3.68):
//
//     f_n = sum_{m=0}^{n} r_m . r_{n-m}
//     g_n = -(P_n + Q_n/(2n))/f_0,  P_n = sum_{m=1}^{n} f_m g_{n-m},  Q_n = sum_{m=1}^{n} m f_m g_{n-m}
//     r_{n+2} = sum_{m=0}^{n} r_m g_{n-m} / ((n + 1)(n + 2))
//
// The sums for r, P and Q run over the same g: r_m, f_m and m f_m lie side by side in one Isa::Five, and each
// term is one multiply-add with g in all lanes.
//
// What limits the speed is the chain from one order to the next, not the number of operations. So sums have
// independent parts, and the last link to each new number is one multiply-add with all else prepared:
//
//     r_n = u_n + w_n g_{n-2},  w_n = r_0/((n - 1) n)
//     f_n = (all that does not need g_{n-2}) + (2 f_0/((n - 1) n)) g_{n-2}
//     g_n = (all that needs neither g_{n-1} nor f_n) - (1 + 1/(2n)) (f_1/f_0) g_{n-1} - (3/2) (g_0/f_0) f_n

/// 1/d = high + low to twice the precision: a rounded reciprocal would be wrong by the same share in every
/// step, and the energy would drift linearly.
struct Reciprocal {
  double high, low;
};
constexpr Reciprocal reciprocal(int d) {
  // 1 - d high is exact in two pieces: high is split so that its products with a small integer are exact.
  const double high = 1.0 / d, split = high * 134217729.0, top = split - (split - high);
  return {high, ((1 - d * top) - d * (high - top)) / d};
}

template <class Isa>
struct Taylor {
  using Four = typename Isa::Four;
  using Five = typename Isa::Five;
  static constexpr int size = most_unrolled + 1;

  Coefficients& c;
  Five five[size];
  Four r[size], u[size];
  double f[size], g[size];
  double f0_inverse, f1_ratio, f_factor;  ///< 1/f_0, f_1/f_0, (3/2) g_0/f_0

  [[gnu::always_inline]] explicit Taylor(Coefficients& out) : c(out) {}

  [[gnu::always_inline]] static double over(double x, Reciprocal d) {
    return Isa::fused(x, d.high, x * d.low);
  }
  [[gnu::always_inline]] static Four over(Four x, Reciprocal d) {
    return multiply_add(x, Four::all(d.high), x * Four::all(d.low));
  }

  /// Everything of orders 0 and 1.
  [[gnu::always_inline]] void start(double mu) {
    r[0] = Four::load(c.row[0]);
    r[1] = Four::load(c.row[1]);
    f[0] = sum3(r[0] * r[0]);
    f0_inverse = 1 / f[0];
    g[0] = -mu * f0_inverse / std::sqrt(f[0]);
    r[2] = r[0] * Four::all(0.5 * g[0]);
    r[2].store(c.row[2]);
    f[1] = 2 * sum3(r[0] * r[1]);
    five[1] = Five::of(r[1], f[1], f[1]);
    f1_ratio = f[1] * f0_inverse;
    f_factor = 1.5 * g[0] * f0_inverse;
    g[1] = -f_factor * f[1];
    u[2] = Four::all(0);
    next<1>(r[1] * Four::all(g[0]));
  }

  /// r_{n+2} from g_n and the sum without r_0 g_n.
  template <int n>
  [[gnu::always_inline]] void next(Four sum) {
    constexpr Reciprocal d = reciprocal((n + 1) * (n + 2));
    u[n + 2] = over(sum, d);
    r[n + 2] = multiply_add(over(r[0], d), Four::all(g[n]), u[n + 2]);
    r[n + 2].store(c.row[n + 2]);
  }

  /// f_n: every product occurs twice, but for that of the middle.
  template <int n>
  [[gnu::always_inline]] double square() const {
    constexpr int pairs = (n + 1) / 2;  // m = 0 .. pairs - 1
    Four a = Four::all(0);
    if constexpr (pairs > 2) {
      constexpr int parts = pairs > 8 ? 2 : 1;
      Four part[2] = {r[2] * r[n - 2], Four::all(0)};
      if constexpr (parts == 2) part[1] = r[3] * r[n - 3];
#pragma GCC unroll 16
      for (int m = 2 + parts; m < pairs; ++m) part[m % parts] = multiply_add(r[m], r[n - m], part[m % parts]);
      a = part[0];
      if constexpr (parts == 2) a = a + part[1];
      a = multiply_add(r[1], r[n - 1], a);
    } else if constexpr (pairs == 2) {
      a = r[1] * r[n - 1];
    }
    if constexpr (n > 2) a = pairs > 1 ? multiply_add(r[0], u[n], a) : r[0] * u[n];
    a = a + a;
    if constexpr (n % 2 == 0) a = multiply_add(r[n / 2], r[n / 2], a);
    return Isa::fused(over(2 * f[0], reciprocal((n - 1) * n)), g[n - 2], sum3(a));
  }

  /// f_n, g_n and r_{n+2} for n > 1.
  template <int n>
  [[gnu::always_inline]] void order() {
    f[n] = square<n>();
    five[n] = Five::of(r[n], f[n], n * f[n]);
    const double factor = f1_ratio + over(f1_ratio, reciprocal(2 * n));
    const double known_late = Isa::fused(factor, g[n - 1], f_factor * f[n]);
    Four sum = Four::all(0);
    if constexpr (n == 2) {
      g[2] = -known_late;
      sum = r[1] * Four::all(g[1]);
    } else {
      // Terms m = 2 .. n - 1 in parts, the one with g_{n-2} last.
      constexpr int parts = n > 14 ? 3 : n > 6 ? 2 : 1;
      Five part[3] = {five[n - 1] * g[1], Five::zero(), Five::zero()};
      if constexpr (parts > 1) part[1] = five[n - 2] * g[2];
      if constexpr (parts > 2) part[2] = five[n - 3] * g[3];
#pragma GCC unroll 32
      for (int m = n - 1 - parts; m >= 3; --m)
        part[(n - 1 - m) % parts] = multiply_add(five[m], g[n - m], part[(n - 1 - m) % parts]);
      Five all = part[0];
      if constexpr (parts > 2) part[1] = part[1] + part[2];
      if constexpr (parts > 1) all = all + part[1];
      if constexpr (n > 3) all = multiply_add(five[2], g[n - 2], all);
      const double known = all.fourth() + over(all.fifth(), reciprocal(2 * n));
      g[n] = -Isa::fused(known, f0_inverse, known_late);
      sum = multiply_add(r[1], Four::all(g[n - 1]), all.four());
    }
    next<n>(multiply_add(r[n], Four::all(g[0]), sum));
  }

  /// Orders n to `most_unrolled`, left early at the wanted one.
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
  /// sum_{k>=1} r_k h^k and sum_{k>=2} k r_k h^(k-1), even and odd powers of h each by themselves.
  [[gnu::always_inline]] static Change change(const Coefficients& c, int order, double h) {
    const Four step = Four::all(h), square = step * step;
    int k = order;
    double factor = order;
    Four row = Four::load(c.row[k]), below = Four::load(c.row[k - 1]);
    Four ra = row, rb = below, va = row * Four::all(factor), vb = below * Four::all(factor - 1);
    if (order == 2) vb = Four::all(0);  // row 1 is no part of the second sum
    for (k -= 2, factor -= 2; k >= 3; k -= 2, factor -= 2) {
      row = Four::load(c.row[k]);
      below = Four::load(c.row[k - 1]);
      ra = multiply_add(ra, square, row);
      rb = multiply_add(rb, square, below);
      va = multiply_add(va, square, row * Four::all(factor));
      vb = multiply_add(vb, square, below * Four::all(factor - 1));
    }
    if (k == 2) {
      row = Four::load(c.row[2]);
      ra = multiply_add(ra, square, row);
      rb = multiply_add(rb, square, Four::load(c.row[1]));
      va = multiply_add(va, square, row + row);
    }
    if (order % 2 == 0) return {multiply_add(ra, step, rb) * step, multiply_add(vb, step, va) * step};
    ra = multiply_add(ra, square, Four::load(c.row[1]));
    return {multiply_add(rb, step, ra) * step, multiply_add(va, step, vb) * step};
  }

  static void increments(const Coefficients& c, int order, double h, double* position,
                         double* velocity) noexcept {
    const Change d = change(c, order, h);
    d.position.store(position);
    d.velocity.store(velocity);
  }

  /// high + low + change, exact to the rounding of low + change (D. E. Knuth's sum of two, which asks for no
  /// order).
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

template <class Isa>
inline constexpr Kernel kernel = {Taylor<Isa>::expand, Taylor<Isa>::increments, Taylor<Isa>::advance};

}  // namespace nlmech::orbit::kernels

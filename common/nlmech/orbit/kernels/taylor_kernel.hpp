/// @file
/// The Taylor series of one Kepler orbit, for any instruction set. Internal to the kernels.
#pragma once

#include <cmath>

#include "nlmech/orbit/kernels/kernel.hpp"
#include "nlmech/support/kernels/pack.hpp"

namespace nlmech::orbit::kernels {

// With r_0 = |r|, eta = r.v and l = |r x v| at the start of the step, the orbit is r(t) = r + G v - (mu/r_0)
// H r, and for every conic and for straight lines
//
//     |r(t)| (G' - 1) = -mu H,  |r(t)| H' = (G - eta H)/r_0,  |r(t)| = r_0 + (eta/r_0) G + (l^2/r_0 - mu) H.
//
// With the coefficients D_n = n (G_n, H_n) of (G' - 1, H') and R_n = -(coefficient n of |r(t)|)/r_0 an order
// takes one sum of products of a number and a pair:
//
//     D_n = (-mu H_{n-1}, (G_{n-1} - eta H_{n-1})/r_0)/r_0 + sum_{j=1}^{n-2} R_j D_{n-j}
//     R_n = R_1 G_n + e H_n,  R_1 = -eta/r_0^2,  e = mu/r_0 - (l/r_0)^2
//
// The terms with D_{n-1} are a matrix times D_{n-1}; its rows are, with c = 1/(r_0^2 (n - 1)),
//
//     R_1, -(mu/r_0)/(n - 1)  and  c, R_1 - eta c,
//
// so two multiply-adds lead from one order to the next. That chain limits the speed: all other terms are
// summed before, the newest last. Orders n and n + 1, n even, share a register of four lanes: a product of
// R_j with (D_m, D_{m+1}), m even, adds to them if j is even, and to orders n + 1 and n + 2 if j is odd.

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

/// The parts of reciprocal(n) at [n], each twice, for two and four lanes.
struct Reciprocals {
  double d[most_unrolled + 1][2], high[most_unrolled + 1][2], low[most_unrolled + 1][2];
};
inline constexpr Reciprocals reciprocals = [] {
  Reciprocals all{};
  for (int n = 1; n <= most_unrolled; ++n) {
    for (int i = 0; i < 2; ++i) {
      all.d[n][i] = reciprocal(n).d;
      all.high[n][i] = reciprocal(n).high;
      all.low[n][i] = reciprocal(n).low;
    }
  }
  return all;
}();

/// Sum of the first three lanes.
template <class Set>
[[gnu::always_inline]] inline double sum3(simd::Pack<Set, 4> a) {
  return (a[0] + a[1]) + a[2];
}

template <class Set>
struct Taylor {
  using Two = simd::Pack<Set, 2>;
  using Four = simd::Pack<Set, 4>;

  Series& series;
  double (&ratio)[most_unrolled + 1];  ///< R_n
  double last_ratio, before_ratio;     ///< the latest R_n and the one before
  Two last, before;                    ///< the latest D_n and the one before
  Two value;                           ///< the latest G_n and H_n
  Two carry;                           ///< sum for the next even order
  Two of_ratio, second_ratio;          ///< (R_1, e), and R_2 twice
  Four matrix;                         ///< (1/r_0^2, -mu/r_0), twice
  double eta;

  [[gnu::always_inline]] Taylor(Series& of, double (&ratios)[most_unrolled + 1])
      : series(of), ratio(ratios) {}

  [[gnu::always_inline]] static Two low(Four x) {
    Two half;
    __builtin_memcpy(&half, &x, sizeof half);
    return half;
  }
  [[gnu::always_inline]] static Two high(Four x) {
    Two half;
    __builtin_memcpy(&half, reinterpret_cast<const char*>(&x) + sizeof half, sizeof half);
    return half;
  }
  [[gnu::always_inline]] static Four joined(Two x, Two y) {
    if constexpr (Set::lanes < 4) {
      return {x, y};
    } else {
      return {__builtin_shufflevector(x.v, y.v, 0, 1, 2, 3)};
    }
  }
  /// x_0, y_0, x_2, y_2, or x_1 in the place of x_0 and x_3 in that of x_2.
  template <int first>
  [[gnu::always_inline]] static Four mixed(Four x, Four y) {
    if constexpr (Set::lanes < 4) {
      return {Two{__builtin_shufflevector(x.a.v, y.a.v, first, 2)},
              Two{__builtin_shufflevector(x.b.v, y.b.v, first, 2)}};
    } else {
      return {__builtin_shufflevector(x.v, y.v, first, 4, first + 2, 6)};
    }
  }

  /// x/n in the first two lanes, x/(n + 1) in others.
  template <class V>
  [[gnu::always_inline]] static V over(V x, int n) {
    if constexpr (Set::fuses) {
      return multiply_add(x, V::load(reciprocals.high[n]), x * V::load(reciprocals.low[n]));
    } else {
      return x / V::load(reciprocals.d[n]);
    }
  }

  /// Order n ends with D_n. Pairs of orders are stored by the odd one.
  template <int n>
  [[gnu::always_inline]] void close(Two d) {
    const Two next = over(d, n);
    if constexpr (n % 2 == 1) store(n, joined(value, next), joined(last, d));
    before = last;
    last = d;
    value = next;
    before_ratio = last_ratio;
    const Two parts = value * of_ratio;
    ratio[n] = last_ratio = parts[0] + parts[1];
  }
  [[gnu::always_inline]] void store(int n, Four values, Four rates) {
    values.store(series.value[n / 2]);
    rates.store(series.rate[n / 2]);
  }

  /// Both columns of the matrix for orders n and n + 1, in the lower and upper half. Both quotients by n - 1
  /// are rounded on their own: with the mu/r_0 of `second` they keep F G' - F' G of circles, of which every
  /// step is alike.
  template <int n>
  [[gnu::always_inline]] void columns(Four& first, Four& second) const {
    const Four x = over(matrix, n - 1), ratio_1 = Four::all(ratio[1]);
    first = mixed<0>(ratio_1, x);
    second = mixed<1>(x, subtract_product(Four::all(eta), x, ratio_1));
  }
  /// Order n > 3 from the sum over j = 3 to n - 2.
  template <int n>
  [[gnu::always_inline]] void order(Two sum, Two first, Two second) {
    chain<n>(multiply_add(second_ratio, before, sum), first, second);
  }
  template <int n>
  [[gnu::always_inline]] void chain(Two sum, Two first, Two second) {
    close<n>(multiply_add(Two::all(last[1]), second, multiply_add(Two::all(last[0]), first, sum)));
  }

  /// Everything up to order 3.
  [[gnu::always_inline]] void start(double mu, const Body& body) {
    const Four r = Four::load(body.position), v = Four::load(body.velocity);
    eta = sum3<Set>(r * v);
    const double distance_square = sum3<Set>(r * r);
    const double distance = std::sqrt(distance_square), inverse_square = 1 / distance_square;
    const double circular = mu / distance, first_ratio = -eta * inverse_square;
    // (l/r_0)^2 = v.v - (eta/r_0)^2
    const double transverse = Set::multiply_add(first_ratio, eta, sum3<Set>(v * v));
    v.store(series.first);
    (r * Four::all(-circular)).store(series.second);
    of_ratio = Two::of(first_ratio, circular - transverse);
    matrix = joined(Two::of(inverse_square, -circular), Two::of(inverse_square, -circular));

    last = value = carry = Two::all(0);
    last_ratio = 0;
    close<1>(Two::of(1.0, 0.0));
    last = Two::all(0);  // D_1: of G' - 1
    close<2>(Two::of(0.0, inverse_square));
    second_ratio = Two::all(last_ratio);
    Four first, second;
    columns<2>(first, second);
    chain<3>(Two::all(0), high(first), high(second));
  }

  /// Orders n and n + 1, n even, and all others up to @p wanted.
  template <int n>
  [[gnu::always_inline]] void orders(int wanted) {
    Four first, second;
    columns<n>(first, second);
    // Products of stored pairs are read from memory: kept in registers, which are too few, they would be
    // copied.
    asm("" : "+m"(series.rate), "+m"(ratio));
    const auto pair = [&](int m) __attribute__((always_inline)) { return Four::load(series.rate[m / 2]); };
    const auto even_ratio = [&](int j) __attribute__((always_inline)) {
      return Four::all(j == n - 2 ? before_ratio : ratio[j]);
    };
    const auto odd_ratio = [&](int j) __attribute__((always_inline)) {
      return Four::all(j == n - 1 ? last_ratio : ratio[j]);
    };
    Four even = Four::all(0), odd = Four::all(0);
    if constexpr (n >= 6) {
      // From the middle outwards, so that the newest numbers come last.
      constexpr int middle = ((n + 2) / 2) & ~1;
      even = pair(n - middle) * even_ratio(middle);
      odd = pair(n - middle) * odd_ratio(middle + 1);
#pragma GCC unroll 40
      for (int k = 2; k <= n; ++k) {
        const int j = k % 2 == 0 ? middle - k : middle + k - 1;
        if (j < 4 || j > n - 2) continue;
        even = multiply_add(pair(n - j), even_ratio(j), even);
        odd = multiply_add(pair(n - j), odd_ratio(j + 1), odd);
      }
    }
    odd = multiply_add(joined(before, last), odd_ratio(3), odd);
    order<n>(low(even) + carry, low(first), low(second));
    if (n == wanted) return store(n, joined(value, Two::all(0)), joined(last, Two::all(0)));
    if constexpr (n < most_unrolled) {
      order<n + 1>(high(even) + low(odd), high(first), high(second));
      if (n + 1 == wanted) return;
      carry = high(odd);
      orders<n + 2>(wanted);
    }
  }

  static void expand(double mu, int order, const Body& body, Series& series) noexcept {
    double ratio[most_unrolled + 1];
    Taylor t(series, ratio);
    t.start(mu, body);
    t.template orders<least_unrolled>(order);
  }

  struct Change {
    Four position, velocity;
  };
  /// Changes in the time @p h. Pairs of orders with even and odd index are summed separately, to shorten the
  /// dependency chain of Horner's rule.
  [[gnu::always_inline]] static Change change(const Series& s, int order, double h) {
    const Four square = Four::all(h * h), fourth = square * square;
    const int top = order / 2;
    int i = top | 1;
    Four u0 = Four::load(s.value[i - 1]), u1 = Four::all(0);
    Four d0 = Four::load(s.rate[i - 1]), d1 = Four::all(0);
    if (i == top) u1 = Four::load(s.value[i]), d1 = Four::load(s.rate[i]);
    for (i -= 2; i > 1; i -= 2) {
      u1 = multiply_add(u1, fourth, Four::load(s.value[i]));
      u0 = multiply_add(u0, fourth, Four::load(s.value[i - 1]));
      d1 = multiply_add(d1, fourth, Four::load(s.rate[i]));
      d0 = multiply_add(d0, fourth, Four::load(s.rate[i - 1]));
    }
    const Four u = multiply_add(u0, square, multiply_add(u1, fourth, Four::load(s.value[1])));
    const Four d = multiply_add(d0, square, multiply_add(d1, fourth, Four::load(s.rate[1])));
    // Factors h, not h^2, in the first terms: with a fixed step h^2 has the same rounding error in every
    // step. G_1 = 1; the velocity at the start is not part of the change.
    const Two step = Two::all(h), rate = multiply_add(high(d), step, low(d)) * step,
              value = multiply_add(multiply_add(high(u), step, low(u)) * step, step, Two::of(h, 0.0));
    const Four first = Four::load(s.first), second = Four::load(s.second);
    return {multiply_add(Four::all(value[0]), first, Four::all(value[1]) * second),
            multiply_add(Four::all(rate[0]), first, Four::all(rate[1]) * second)};
  }

  static void increments(const Series& s, int order, double h, double* position, double* velocity) noexcept {
    const Change d = change(s, order, h);
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

  static void advance(const Series& s, int order, double h, bool compensated, Body& body) noexcept {
    const Change d = change(s, order, h);
    const double keep = compensated ? 1 : 0;
    add(body.position, body.position_low, d.position, keep);
    add(body.velocity, body.velocity_low, d.velocity, keep);
  }
};

template <class Set>
inline constexpr Kernel kernel = {Taylor<Set>::expand, Taylor<Set>::increments, Taylor<Set>::advance};

}  // namespace nlmech::orbit::kernels

/// @file
/// Kepler orbits by Taylor series, one per lane, for any instruction set. Internal to the kernels.
#pragma once

#include "nlmech/orbit/kernels/kernel.hpp"
#include "nlmech/orbit/kernels/taylor_kernel.hpp"
#include "nlmech/support/kernels/rough_logarithm.hpp"

namespace nlmech::orbit::kernels {

// In time t from the start of the step, with r_0 = |r|, eta = r.v, beta = 2 mu/r_0 - v.v there and sigma =
// 1/|r|: the universal functions U_1 and U_2 of ds = sigma dt obey
//
//     U_1' = (1 - beta U_2) sigma,  U_2' = U_1 sigma,  |r| = r_0 + eta U_1 + gamma U_2,  gamma = mu - beta
//     r_0,
//
// and r(t) = (1 - (mu/r_0) U_2) r + (r_0 U_1 + eta U_2) v. So Taylor coefficients of a position need, an
// order, the two products a = U_1 sigma and b = U_2 sigma and no other sum:
//
//     sigma_n = -(eta a_n + gamma b_n)/r_0,  U_1,n+1 = (sigma_n - beta b_n)/(n + 1),  U_2,n+1 = a_n/(n + 1),
//
// for every conic and for straight lines. The velocity at the end follows from the same two numbers.

/// Taylor series of Kepler orbits, one per lane. @tparam V one or several registers
template <class Set, class V>
struct EnsembleTaylor {
  static constexpr int size = most_ensemble_order + 1;

  V sigma[size], first[size], second[size];
  V minus_eta, minus_gamma, beta;  ///< -eta/r_0, -gamma/r_0 and beta
  V rate, latest;                  ///< n times the latest coefficients of both

  [[gnu::always_inline]] static V over(V x, Reciprocal d) {
    if constexpr (Set::fuses) {
      return multiply_add(x, V::all(d.high), x * V::all(d.low));
    } else {
      return x / V::all(d.d);
    }
  }

  /// sigma_n, first_{n+1} and second_{n+1} from both products.
  template <int n>
  [[gnu::always_inline]] void close(V a, V b) {
    sigma[n] = multiply_add(minus_eta, a, minus_gamma * b);
    rate = subtract_product(beta, b, sigma[n]);
    latest = a;
    first[n + 1] = over(rate, reciprocal(n + 1));
    second[n + 1] = over(a, reciprocal(n + 1));
  }

  /// Adds the terms with the latest results of close(), through their numerators: the dependency chain from
  /// order to order limits the speed. `a` and `b` are all other terms.
  template <int n>
  [[gnu::always_inline]] void finish(V a, V b) {
    const V share = over(sigma[0], reciprocal(n));
    close<n>(multiply_add(share, rate, multiply_add(first[1], sigma[n - 1], a)),
             multiply_add(share, latest, b));
  }

  /// Orders n and n + 1, which share loads; n is even.
  template <int n>
  [[gnu::always_inline]] void pair() {
    if constexpr (n == 2) {
      finish<2>(V::all(0), V::all(0));
      finish<3>(first[2] * sigma[1], second[2] * sigma[1]);
    } else {
      V f = first[3], g = second[3];
      V a0 = first[2] * sigma[n - 2], a1 = f * sigma[n - 2];
      V b0 = second[2] * sigma[n - 2], b1 = g * sigma[n - 2];
      // Unrolled by 2 only: the fully unrolled code of the higher orders exceeds the first-level instruction
      // cache, and a step takes twice as long.
#pragma GCC unroll 2
      for (int m = 3; m < n; ++m) {
        a0 = multiply_add(f, sigma[n - m], a0);
        b0 = multiply_add(g, sigma[n - m], b0);
        f = first[m + 1];
        g = second[m + 1];
        a1 = multiply_add(f, sigma[n - m], a1);
        b1 = multiply_add(g, sigma[n - m], b1);
      }
      a1 = multiply_add(first[2], sigma[n - 1], a1);
      b1 = multiply_add(second[2], sigma[n - 1], b1);
      finish<n>(a0, b0);
      finish<n + 1>(a1, b1);
    }
  }

  /// Coefficients from order n up to @p wanted.
  template <int n>
  [[gnu::always_inline]] void pairs(int wanted) {
    pair<n>();
    if constexpr (n + 2 < most_ensemble_order) {
      if constexpr (n + 2 >= least_ensemble_order) {
        if (n + 2 == wanted) return;
      }
      pairs<n + 2>(wanted);
    }
  }

  [[gnu::always_inline]] void expand(V sigma_0, int order) {
    sigma[0] = sigma_0;
    first[1] = sigma_0;
    second[1] = V::all(0);
    close<1>(sigma_0 * sigma_0, V::all(0));
    pairs<2>(order);
  }
};

/// high + low + change in the lanes of @p moved, exact to the rounding of low + change (Knuth's two-sum).
template <class V, class M>
[[gnu::always_inline]] inline void add_to(Row& high, Row& low, V change, M moved) {
  const V a = V::load(high.lane), a_low = V::load(low.lane), b = a_low + change;
  const V sum = a + b, virtual_b = sum - a;
  select(moved, sum, a).store(high.lane);
  select(moved, (a - (sum - virtual_b)) + (b - virtual_b), a_low).store(low.lane);
}

template <class V>
[[gnu::always_inline]] inline V load(const Row& row) {
  return V::load(row.lane);
}

/// log2 of the step size for which a term has the wanted size; `square` is the squared coefficient.
template <class V>
[[gnu::always_inline]] inline V step_of(V wanted, V square, double weight, double power) {
  // Rounding may make the sum negative where it cancels: treat it as a very small term.
  const V bits = rough_log2(larger(square, V::all(0x1p-1000)));
  return (wanted - bits - V::all(weight)) * V::all(power);
}

/// Both universal functions at a time; even and odd powers are summed separately.
template <class Set, class V>
struct Universal {
  V one, two;

  [[gnu::always_inline]] Universal(const EnsembleTaylor<Set, V>& t, int order, V time) {
    const V square = time * time;
    V one_even = t.first[order], two_even = t.second[order];
    V one_odd = t.first[order - 1], two_odd = t.second[order - 1];
    for (int k = order - 2; k > 0; k -= 2) {
      one_even = multiply_add(one_even, square, t.first[k]);
      two_even = multiply_add(two_even, square, t.second[k]);
      one_odd = multiply_add(one_odd, square, t.first[k - 1]);
      two_odd = multiply_add(two_odd, square, t.second[k - 1]);
    }
    one = multiply_add(one_even, time, one_odd) * time;
    two = multiply_add(two_even, time, two_odd) * time;
  }
};

/// One step of every lane. @return the events of the lanes
template <class Set, class V>
[[gnu::always_inline]] inline LaneEvents one_step(LaneBlock& block, const LaneSettings& settings) {
  V r[3], v[3];
  for (int i = 0; i < 3; ++i) {
    r[i] = load<V>(block.position[i]);
    v[i] = load<V>(block.velocity[i]);
  }
  const V mu = load<V>(block.mu);
  const V square = multiply_add(r[2], r[2], multiply_add(r[1], r[1], r[0] * r[0]));
  const V speed_square = multiply_add(v[2], v[2], multiply_add(v[1], v[1], v[0] * v[0]));
  const V eta = multiply_add(r[2], v[2], multiply_add(r[1], v[1], r[0] * v[0]));
  const V distance = square_root(square), inverse = V::all(1) / distance;
  const V circular = mu * inverse;  // square of the circular speed

  EnsembleTaylor<Set, V> t;
  const V minus_gamma = subtract_product(distance, speed_square, mu);
  t.beta = subtract_product(V::all(1), speed_square, circular + circular);
  t.minus_eta = (V::all(0) - eta) * inverse;
  t.minus_gamma = minus_gamma * inverse;
  t.expand(inverse, settings.order);

  // Step size from the last two coefficients of the position, F_k r + G_k v.
  const auto square_of = [&](int k) __attribute__((always_inline)) {
    const V f = circular * t.second[k];  // -F_k
    const V g = multiply_add(distance, t.first[k], eta * t.second[k]);
    return multiply_add(subtract_product(eta + eta, g, square * f), f, speed_square * (g * g));
  };
  const V log_speed = rough_log2(larger(speed_square, circular));
  const V wanted = V::all(settings.wanted) + log_speed;
  const V last = step_of(wanted, square_of(settings.order), settings.last_weight, settings.last_power);
  const V before =
      step_of(wanted, square_of(settings.order - 1), settings.before_weight, settings.before_power);
  const V longest = select(speed_square > circular * V::all(1e3), V::all(-1), V::all(settings.longest)) +
                    (rough_log2(square) - log_speed) * V::all(0.5);
  const V h = rough_exp2(smaller(smaller(last, before), longest));

  // The remaining time is a sum of two doubles. If less than two steps remain, take half of it.
  const V to_go = load<V>(block.remaining), to_go_low = load<V>(block.remaining_low);
  const V remaining = to_go + to_go_low;
  const auto inner = remaining > h;
  const V taken = select(inner, select(remaining > h + h, h, remaining * V::all(0.5)), remaining);

  const Universal<Set, V> u(t, settings.order, taken);
  const V end_inverse = V::all(1) / multiply_add(eta, u.one, subtract_product(minus_gamma, u.two, distance));
  const V minus_f = circular * u.two, g = multiply_add(distance, u.one, eta * u.two);
  const V mu_end = mu * end_inverse, minus_f_rate = mu_end * inverse * u.one, minus_g_rate = mu_end * u.two;
  V dr[3], dv[3], sum = V::all(0);
  for (int i = 0; i < 3; ++i) {
    dr[i] = subtract_product(minus_f, r[i], g * v[i]);
    dv[i] = V::all(0) - multiply_add(minus_f_rate, r[i], minus_g_rate * v[i]);
    sum = sum + (dr[i] + dv[i]);
  }
  // Values that are not finite fail the test of 0 times the sum.
  const auto moved = (h > load<V>(block.least_step)) & within(V::all(0), sum * V::all(0), V::all(0));

  LaneEvents events;
  events.row_due = V::bits(moved & within(load<V>(block.next_row), taken, taken));
  if (events.row_due != 0) [[unlikely]] {
    for (int i = 0; i < 3; ++i) {
      r[i].store(block.first_position[i].lane);
      v[i].store(block.first_velocity[i].lane);
    }
    for (int k = 1; k <= settings.order; ++k) {
      t.first[k].store(block.first[k].lane);
      t.second[k].store(block.second[k].lane);
    }
  }
  for (int i = 0; i < 3; ++i) {
    add_to(block.position[i], block.position_low[i], dr[i], moved);
    add_to(block.velocity[i], block.velocity_low[i], dv[i], moved);
  }
  taken.store(block.step.lane);
  h.store(block.chosen.lane);
  const V change = to_go_low - taken, rest = to_go + change, part = rest - to_go;
  const V rest_low = (to_go - (rest - part)) + (change - part);
  select(moved, select(inner, rest, V::all(0)), to_go).store(block.remaining.lane);
  select(moved, select(inner, rest_low, V::all(0)), to_go_low).store(block.remaining_low.lane);
  (load<V>(block.next_row) - taken).store(block.next_row.lane);

  const unsigned all = (1U << V::lanes) - 1;
  events.lost = V::bits(moved) ^ all;
  events.arrived = (V::bits(inner) ^ all) & ~events.lost;
  events.drifted = V::bits(within(V::all(1 / most_lane_drift), h, V::all(most_lane_drift))) ^ all;
  return events;
}

template <class Set, class V>
LaneEvents steps(LaneBlock& block, const LaneSettings& settings, std::int64_t limit) noexcept {
  LaneEvents events;
  std::int64_t made = 0;
  do {
    events = one_step<Set, V>(block, settings);
    ++made;
  } while ((events.lost | events.arrived | events.drifted | events.row_due) == 0 && made < limit);
  events.steps = made;
  return events;
}

/// Kernel of one instruction set. Two registers at a time hide the latency of the chain from order to order,
/// except where quotients are divisions.
template <class Set, class V = simd::Pack<Set, (Set::fuses ? 2 : 1) * Set::lanes>>
inline constexpr EnsembleKernel ensemble_kernel = {V::lanes, steps<Set, V>};

}  // namespace nlmech::orbit::kernels

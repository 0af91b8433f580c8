/// @file
/// Replay of a tape for several solutions in parallel, one per lane, each with the bits of a single replay.
/// Internal to the kernels.
#pragma once

#include "nlmech/program/series_step.hpp"
#include "nlmech/program/tape_program.hpp"

namespace nlmech::tape {

/// @tparam A number type; its name contains the instruction set, so that the linker cannot confuse instances:
///  - `Number`, and `width`, its number of doubles in memory: one, or one per lane;
///  - `load(const double*)`, `store(double*, Number)`, `all(double)`;
///  - `sum(const double* a, const double* b, int n)`, the sum of n products of numbers ascending from a and
///    descending from b;
///  - `constant(double own, const double* constants, int i)`: a constant of the tape, or one per lane.
template <class A>
class Replayer {
 public:
  static void run(const Program& program, const double* constants, double* memory, std::int64_t stride,
                  int order, const double* scale, const double* reciprocals) {
    const Number unit = A::load(scale);
    for (int k = 1; k < order; ++k) {
      const Replayer pass{program, constants, memory, stride, k};
      for (int i = 0; i < program.instruction_count; ++i) pass.execute(i);
      for (int i = 0; i < program.size; ++i) {
        const Output& output = program.outputs[i];
        const Number slope = output.series < 0 ? number(0) : pass.at(output.series)[k];
        pass.at(i + 1).set(k + 1, k < first_reciprocal ? unit * slope / number(k + 1)
                                                       : slope * (unit * number(reciprocals[k])));
      }
    }
  }

 private:
  using Number = typename A::Number;

  /// A series in memory.
  struct Series {
    double* first;
    [[gnu::always_inline]] Number operator[](int k) const { return A::load(first + k * A::width); }
    [[gnu::always_inline]] void set(int k, Number x) const { A::store(first + k * A::width, x); }
  };

  Replayer(const Program& program, const double* constants, double* memory, std::int64_t stride, int k)
      : program_(program), constants_(constants), memory_(memory), stride_(stride), k_(k) {}

  [[gnu::always_inline]] static Number number(double x) { return A::all(x); }
  [[gnu::always_inline]] static Number negative(Number x) { return number(-0.0) - x; }
  [[gnu::always_inline]] Series at(int series) const { return {memory_ + series * stride_}; }
  [[gnu::always_inline]] Number factor(int i) const {
    return A::constant(program_.instructions[i].factor, constants_, factor_of(i));
  }

  // a_1 b_{k-1} + ... + a_{k-1} b_1: the product without the newest coefficients.
  [[gnu::always_inline]] Number middle(Series a, Series b) const {
    return A::sum(a.first + A::width, b.first + (k_ - 1) * A::width, k_ - 1);
  }
  [[gnu::always_inline]] Number middle_square(Series a) const {
    const int pairs = (k_ - 1) / 2;
    const Number half = number(2) * A::sum(a.first + A::width, a.first + (k_ - 1) * A::width, pairs);
    return k_ % 2 == 0 ? half + a[k_ / 2] * a[k_ / 2] : half;
  }
  [[gnu::always_inline]] Number square(Series a) const {
    return middle_square(a) + number(2) * (a[0] * a[k_]);
  }
  // Coefficient k of the slope d times b, whose coefficients below k are known.
  [[gnu::always_inline]] Number slope_times(Series d, Series b, bool line) const {
    if (line) return d[1] * b[k_ - 1];
    return middle(d, b) + d[k_] * b[0];
  }

  [[gnu::always_inline]] Number linear(int j) const {
    const Instruction& i = program_.instructions[j];
    Number sum = term(i.first);
    for (int m = i.first + 1; m < i.first + i.count; ++m) sum = sum + term(m);
    sum = sum * factor(j);
    return i.divisor == 1 ? sum : sum / A::constant(i.divisor, constants_, divisor_of(j));
  }
  [[gnu::always_inline]] Number term(int m) const {
    const Term& term = program_.terms[m];
    return A::constant(term.factor, constants_, term_of(program_, m)) * at(term.series)[k_];
  }

  [[gnu::always_inline]] void execute(int j) const {
    const Instruction& i = program_.instructions[j];
    const Series r = at(i.r), a = at(i.a), b = at(i.b);
    switch (i.operation) {
      case Operation::linear: r.set(k_, linear(j)); return;
      case Operation::product: r.set(k_, middle(a, b) + (a[0] * b[k_] + a[k_] * b[0])); return;
      case Operation::product_by_line: r.set(k_, a[0] * b[k_] + a[1] * b[k_ - 1]); return;
      case Operation::square: r.set(k_, square(a)); return;
      case Operation::quotient: r.set(k_, (a[k_] - middle(b, r) - r[0] * b[k_]) / b[0]); return;
      case Operation::reciprocal: r.set(k_, (negative(middle(b, r)) - r[0] * b[k_]) / b[0]); return;
      case Operation::root: r.set(k_, (a[k_] - middle_square(r)) / (number(2) * r[0])); return;
      case Operation::slope: r.set(k_, number(k_) * a[k_]); return;
      default: execute_function(j);
    }
  }

  // Functions with a differential equation.
  void execute_function(int j) const {
    const Instruction& i = program_.instructions[j];
    const Series r = at(i.r), a = at(i.a), g = at(i.r + 1), d = at(i.extra);
    const Number k = number(k_);
    switch (i.operation) {
      case Operation::exponential: r.set(k_, slope_times(d, r, i.line) / k); return;
      case Operation::circular:
      case Operation::hyperbolic: {
        const Number f = slope_times(d, g, i.line) / k, next = slope_times(d, r, i.line) / k;
        r.set(k_, f);
        g.set(k_, i.operation == Operation::circular ? negative(next) : next);
        return;
      }
      case Operation::tangent:
      case Operation::hyperbolic_tangent:
        r.set(k_, slope_times(d, g, i.line) / k);
        g.set(k_, i.operation == Operation::tangent ? square(r) : negative(square(r)));
        return;
      case Operation::arc_sine:
      case Operation::arc_cosine:
      case Operation::arc_tangent:
      case Operation::angle:
      case Operation::area_sine:
      case Operation::error_function: r.set(k_, d[k_] / k); return;
      case Operation::logarithm:
        g.set(k_, (k * a[k_] - middle(g, a)) / a[0]);
        r.set(k_, g[k_] / k);
        return;
      default:  // power
        g.set(k_, (factor(j) * slope_times(d, r, i.line) - middle(g, a)) / a[0]);
        r.set(k_, g[k_] / k);
    }
  }

  const Program& program_;
  const double* constants_;
  double* memory_;
  std::int64_t stride_;
  int k_;
};

/// One solution at a time. @tparam Sum `static double of(const double* a, const double* b, int n)`: the sum
/// of a[i] b[-i] for i = 0, ..., n - 1
template <class Sum>
struct One {
  using Number = double;
  static constexpr int width = 1;

  [[gnu::always_inline]] static double load(const double* from) { return *from; }
  [[gnu::always_inline]] static void store(double* to, double x) { *to = x; }
  [[gnu::always_inline]] static double all(double x) { return x; }
  [[gnu::always_inline]] static double sum(const double* a, const double* b, int n) {
    return Sum::of(a, b, n);
  }
  [[gnu::always_inline]] static double constant(double own, const double*, int) { return own; }
};

/// One solution per lane. @tparam V simd::Pack
template <class V>
struct Many {
  using Number = V;
  static constexpr int width = V::lanes;

  [[gnu::always_inline]] static V load(const double* from) { return V::load(from); }
  [[gnu::always_inline]] static void store(double* to, V x) { x.store(to); }
  [[gnu::always_inline]] static V all(double x) { return V::all(x); }
  [[gnu::always_inline]] static V constant(double, const double* constants, int i) {
    return V::load(constants + i * width);
  }
};

/// Sums in the order of the AVX2 kernel: eight partial sums, and one of the remainder after fours.
template <class V>
struct ManyInFours : Many<V> {
  using Many<V>::load;
  using Many<V>::width;

  [[gnu::always_inline]] static V sum(const double* a, const double* b, int n) {
    V rest = V::all(0);
    int i = 0;
    if (n < 4) {
      for (; i < n; ++i) rest = product(a, b, i, rest);
      return rest;
    }
    V even[4], odd[4];
    for (int j = 0; j < 4; ++j) even[j] = load(a + j * width) * load(b - j * width);
    for (int j = 0; j < 4; ++j) odd[j] = V::all(0);
    for (i = 4; i + 8 <= n; i += 8) {
      for (int j = 0; j < 4; ++j) odd[j] = product(a, b, i + j, odd[j]);
      for (int j = 0; j < 4; ++j) even[j] = product(a, b, i + 4 + j, even[j]);
    }
    if (i + 4 <= n) {
      for (int j = 0; j < 4; ++j) odd[j] = product(a, b, i + j, odd[j]);
      i += 4;
    }
    for (; i < n; ++i) rest = product(a, b, i, rest);
    for (int j = 0; j < 4; ++j) even[j] = even[j] + odd[j];
    return ((even[0] + even[2]) + (even[1] + even[3])) + rest;
  }

 private:
  [[gnu::always_inline]] static V product(const double* a, const double* b, int i, V sum) {
    return multiply_add(load(a + i * width), load(b - i * width), sum);
  }
};

/// Sums in the order of the baseline kernel: four partial sums, products rounded.
template <class V>
struct ManyRounded : Many<V> {
  using Many<V>::load;
  using Many<V>::width;

  [[gnu::always_inline]] static V sum(const double* a, const double* b, int n) {
    V s[4];
    for (int j = 0; j < 4; ++j) s[j] = V::all(0);
    int i = 0;
    for (; i + 4 <= n; i += 4) {
      for (int j = 0; j < 4; ++j) s[j] = s[j] + load(a + (i + j) * width) * load(b - (i + j) * width);
    }
    for (; i < n; ++i) s[0] = s[0] + load(a + i * width) * load(b - i * width);
    return (s[0] + s[1]) + (s[2] + s[3]);
  }
};

/// See LaneKernel::measure.
template <class V>
void measure_lanes(const double* memory, std::int64_t stride, int size, int order, double absolute,
                   double relative, double* tails) {
  SeriesTail<V> tail;
  for (int i = 0; i < size; ++i) {
    const double* const c = memory + (i + 1) * stride;
    const auto at = [c](int k) __attribute__((always_inline)) { return V::load(c + k * V::lanes); };
    tail.add(at(0), at(1), at(order - 1), at(order), absolute, relative);
  }
  tail.last.store(tails);
  tail.before.store(tails + V::lanes);
  tail.sum.store(tails + 2 * V::lanes);
}

/// See LaneKernel::advance; even and odd powers are summed in parallel.
template <class V>
void advance_lanes(const double* memory, std::int64_t stride, int size, int order, const double* s,
                   const double* carries, double* ends, double* end_carries) {
  const V x = V::load(s), square = x * x;
  for (int i = 0; i < size; ++i) {
    const double* const c = memory + (i + 1) * stride;
    const auto at = [c](int k) __attribute__((always_inline)) { return V::load(c + k * V::lanes); };
    int k = order;
    V high = at(k), low = at(k - 1);
    for (k -= 2; k >= 2; k -= 2) {
      high = high * square + at(k);
      low = low * square + at(k - 1);
    }
    const V sum = k == 1 ? (high * square + at(1)) * x + low * square : high * square + low * x;
    V end, carry;
    add_increment(at(0), V::load(carries + i * V::lanes), sum, end, carry);
    end.store(ends + i * V::lanes);
    carry.store(end_carries + i * V::lanes);
  }
}

/// The kernel of Numbers, ManyInFours or ManyRounded.
template <class Numbers>
inline constexpr LaneKernel lane_kernel = {Numbers::width, Replayer<Numbers>::run,
                                           measure_lanes<typename Numbers::Number>,
                                           advance_lanes<typename Numbers::Number>};

}  // namespace nlmech::tape

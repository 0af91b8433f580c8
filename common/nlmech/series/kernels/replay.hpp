/// @file
/// The replay of a tape over sums of one instruction set. Internal to the kernels.
#pragma once

#include "nlmech/series/tape_program.hpp"

namespace nlmech::tape {

/// @tparam Sum `static double of(const double* a, const double* b, int n)`: the sum of a[i] b[-i] for
/// i = 0, ..., n - 1; its name has the instruction set, so that no instance can be taken for another's
template <class Sum>
class Replayer {
 public:
  static void run(const Program& program, double* memory, std::int64_t stride, int order, double scale,
                  const double* factor) {
    for (int k = 1; k < order; ++k) {
      const Replayer pass{memory, stride, k};
      for (int i = 0; i < program.instruction_count; ++i)
        pass.execute(program.instructions[i], program.terms);
      for (int i = 0; i < program.size; ++i) {
        const Output& output = program.outputs[i];
        const double slope = output.series < 0 ? 0 : pass.at(output.series)[k];
        pass.at(i + 1)[k + 1] = k < first_reciprocal ? scale * slope / (k + 1) : slope * factor[k];
      }
    }
  }

 private:
  Replayer(double* memory, std::int64_t stride, int k) : memory_(memory), stride_(stride), k_(k) {}

  [[gnu::always_inline]] double* at(int series) const { return memory_ + series * stride_; }

  // a_1 b_{k-1} + ... + a_{k-1} b_1, then the two products with the newest coefficients.
  [[gnu::always_inline]] double middle(const double* a, const double* b) const {
    return Sum::of(a + 1, b + k_ - 1, k_ - 1);
  }
  [[gnu::always_inline]] double middle_square(const double* a) const {
    const int pairs = (k_ - 1) / 2;
    const double half = 2 * Sum::of(a + 1, a + k_ - 1, pairs);
    return k_ % 2 == 0 ? half + a[k_ / 2] * a[k_ / 2] : half;
  }
  [[gnu::always_inline]] double square(const double* a) const {
    return middle_square(a) + 2 * (a[0] * a[k_]);
  }
  // Coefficient k of the slope d times b, whose coefficients below k are known.
  [[gnu::always_inline]] double slope_times(const double* d, const double* b, bool line) const {
    if (line) return d[1] * b[k_ - 1];
    return middle(d, b) + d[k_] * b[0];
  }

  [[gnu::always_inline]] double linear(const Instruction& i, const Term* terms) const {
    const Term* term = terms + i.first;
    double sum = term->factor * at(term->series)[k_];
    for (int j = 1; j < i.count; ++j) {
      ++term;
      sum += term->factor * at(term->series)[k_];
    }
    sum *= i.factor;
    return i.divisor == 1 ? sum : sum / i.divisor;
  }

  [[gnu::always_inline]] void execute(const Instruction& i, const Term* terms) const {
    double* const r = at(i.r);
    const double* const a = at(i.a);
    const double* const b = at(i.b);
    switch (i.operation) {
      case Operation::linear: r[k_] = linear(i, terms); return;
      case Operation::product: r[k_] = middle(a, b) + (a[0] * b[k_] + a[k_] * b[0]); return;
      case Operation::product_by_line: r[k_] = a[0] * b[k_] + a[1] * b[k_ - 1]; return;
      case Operation::square: r[k_] = square(a); return;
      case Operation::quotient: r[k_] = (a[k_] - middle(b, r) - r[0] * b[k_]) / b[0]; return;
      case Operation::reciprocal: r[k_] = (-middle(b, r) - r[0] * b[k_]) / b[0]; return;
      case Operation::root: r[k_] = (a[k_] - middle_square(r)) / (2 * r[0]); return;
      case Operation::slope: r[k_] = k_ * a[k_]; return;
      default: execute_function(i, r, a);
    }
  }

  // Functions with a differential equation.
  void execute_function(const Instruction& i, double* r, const double* a) const {
    double* const g = r + stride_;
    const double* const d = at(i.extra);
    switch (i.operation) {
      case Operation::exponential: r[k_] = slope_times(d, r, i.line) / k_; return;
      case Operation::circular:
      case Operation::hyperbolic: {
        const double f = slope_times(d, g, i.line) / k_, next = slope_times(d, r, i.line) / k_;
        r[k_] = f;
        g[k_] = i.operation == Operation::circular ? -next : next;
        return;
      }
      case Operation::tangent:
      case Operation::hyperbolic_tangent:
        r[k_] = slope_times(d, g, i.line) / k_;
        g[k_] = i.operation == Operation::tangent ? square(r) : -square(r);
        return;
      case Operation::arc_sine:
      case Operation::arc_cosine:
      case Operation::arc_tangent:
      case Operation::angle:
      case Operation::error_function: r[k_] = d[k_] / k_; return;
      case Operation::logarithm:
        g[k_] = (k_ * a[k_] - middle(g, a)) / a[0];
        r[k_] = g[k_] / k_;
        return;
      default:  // power
        g[k_] = (i.factor * slope_times(d, r, i.line) - middle(g, a)) / a[0];
        r[k_] = g[k_] / k_;
    }
  }

  double* memory_;
  std::int64_t stride_;
  int k_;
};

}  // namespace nlmech::tape

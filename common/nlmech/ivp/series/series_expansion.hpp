/// @file
/// The Taylor series of one step: its terms, its sum, its length.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "nlmech/ivp/smooth_segment.hpp"
#include "nlmech/ivp/solution.hpp"

namespace nlmech::ivp::taylor_series {

/// Logarithm to the base 2 to 0.01, which is good enough for a step: of 0 below -1000.
[[nodiscard]] inline double rough_log2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const double exponent = static_cast<double>(static_cast<std::int64_t>(bits >> 52U)) - 1023;
  const double mantissa =
      std::bit_cast<double>((bits & 0xfffffffffffffU) | std::bit_cast<std::uint64_t>(1.0)) - 1;
  return exponent + mantissa * (1.3465 - 0.3465 * mantissa);
}

/// 2^x to 0.3 %, x held between -1000 and 1000.
[[nodiscard]] inline double rough_exp2(double x) {
  const double held = std::clamp(x, -1000.0, 1000.0), whole = std::floor(held), part = held - whole;
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023) << 52U;
  return std::bit_cast<double>(exponent) * (1 + part * (0.6565 + 0.3435 * part));
}

/// The power of two next to a length, by the same measure.
[[nodiscard]] inline double power_of_two(double length) {
  return rough_exp2(std::floor(rough_log2(length) + 0.5));
}

/// The sum of c_k s^k for k = 1, ..., order: even and odd powers apart, the two halves side by side.
[[nodiscard]] inline double increment(const double* c, int order, double s) {
  const double square = s * s;
  int k = order;
  double high = c[k], low = c[k - 1];
  for (k -= 2; k >= 2; k -= 2) {
    high = high * square + c[k];
    low = low * square + c[k - 1];
  }
  // high belongs to the power k + 2 or, by now, 2 or 1; low to the one below it.
  if (k == 1) return (high * square + c[1]) * s + low * square;
  return high * square + low * s;
}

/// The derivative of the series with respect to s.
[[nodiscard]] inline double slope(const double* c, int order, double s) {
  double sum = order * c[order];
  for (int k = order - 1; k >= 1; --k) sum = sum * s + k * c[k];
  return sum;
}

/// The last two terms in the norm max_i |e_i| / (atol + rtol |x_i|), and what tells whether all are finite.
struct Tail {
  double last = 0;    ///< of the order N
  double before = 0;  ///< of the order N - 1
  double sum = 0;     ///< of the absolute values of the first and the last coefficients

  /// Takes in a component by its coefficients 0, 1, N - 1 and N.
  void add(double x, double first, double previous, double end, double atol, double rtol) {
    const double unit = 1 / (atol + rtol * std::abs(x));
    last = std::max(last, unit * std::abs(end));
    before = std::max(before, unit * std::abs(previous));
    sum += std::abs(end) + std::abs(first);
  }
  /// Are all coefficients finite? The last ones tell: they are made of the others.
  [[nodiscard]] bool is_finite() const { return sum <= std::numeric_limits<double>::max(); }
  /// The length at which the last two terms are 1, times @p log2_safety as a power of two; positive.
  [[nodiscard]] double length(int order, double scale, double log2_safety) const {
    const double log2 = std::max(rough_log2(last) / order, rough_log2(before) / (order - 1));
    return scale * rough_exp2(log2_safety - log2);
  }
};

/// x1 = x0 + carry + @p increment of one component, and what rounding cuts off.
inline void add_increment(double x0, double carry, double increment, double& x1, double& next_carry) {
  const double term = carry + increment;
  x1 = x0 + term;
  const double taken = x1 - x0;
  next_carry = (x0 - (x1 - taken)) + (term - taken);
}

/// The series of a step: coefficients in powers of tau = (t - t0)/T with a power of two for T.
template <class S>
class Expansion : public DenseOutputOf<S> {
 public:
  using State = typename S::State;  ///< all components

  /// @param system outlives the expansion
  Expansion(const S& system, int order)
      : taylor_(system.taylor(order)), size_(system.size()), order_(order), carry_(State::Zero(size_)) {}

  /// Starts a stretch on which the right-hand side is smooth.
  void begin_segment(double begin, double end, const State& x) {
    segment_ = SmoothSegment(begin, end);
    taylor_.begin_segment(segment_(begin), x);
  }
  /// Computes the coefficients at (t, x) with T = @p scale.
  void expand(double t, const State& x, double scale) {
    t0_ = t;
    scale_ = scale;
    taylor_.expand(segment_(t), x, scale);
  }
  /// Its last terms. @param x the state at its begin
  [[nodiscard]] Tail tail(const State& x, double atol, double rtol) const {
    Tail tail;
    for (int i = 0; i < size_; ++i) {
      const double* const c = taylor_.coefficients(i);
      tail.add(x[i], c[1], c[order_ - 1], c[order_], atol, rtol);
    }
    return tail;
  }
  /// Coefficient @p k of component @p i, times T^k.
  [[nodiscard]] double coefficient(int i, int k) const { return taylor_.coefficients(i)[k]; }
  /// Where f is asked for when @p t is meant.
  [[nodiscard]] double inside(double t) const { return segment_(t); }

  /// The state @p x1 at t0 + @p h. What rounding cuts off goes to a place that accept() takes over.
  void advance(double h, const State& x0, State& x1) {
    const double s = h / scale_;
    if constexpr (S::dimension == Eigen::Dynamic) next_carry_.resize(size_);
    for (int i = 0; i < size_; ++i) {
      add_increment(x0[i], carry_[i], increment(taylor_.coefficients(i), order_, s), x1[i], next_carry_[i]);
    }
  }
  /// Goes on from the end of the latest advance().
  void accept() { carry_ = next_carry_; }
  /// dx/dt of the series at t0 + @p h, component @p i.
  [[nodiscard]] double slope_at(double h, int i) const {
    return slope(taylor_.coefficients(i), order_, h / scale_) / scale_;
  }

  /// Within the latest step.
  void at(double t, State& x) const override {
    x.resize(size_);
    const double s = (t - t0_) / scale_;
    for (int i = 0; i < size_; ++i) {
      const double* const c = taylor_.coefficients(i);
      x[i] = c[0] + increment(c, order_, s);
    }
  }

 private:
  decltype(std::declval<const S&>().taylor(1)) taylor_;
  int size_, order_;
  SmoothSegment segment_;
  State carry_, next_carry_;
  double t0_ = 0, scale_ = 1;
};

}  // namespace nlmech::ivp::taylor_series

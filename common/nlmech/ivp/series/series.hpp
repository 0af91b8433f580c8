/// @file
/// Integration by Taylor series of the solution: fixed step size and order as in the paper, or an adaptive
/// step size by the decay of the terms.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>

#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/step_control.hpp"
#include "nlmech/program/series_step.hpp"

namespace nlmech::ivp {

namespace taylor_series {

/// Logarithm to the base 2 with an error of 0.01, enough for a step size; below -1000 for 0.
[[nodiscard]] inline double rough_log2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const double exponent = static_cast<double>(static_cast<std::int64_t>(bits >> 52U)) - 1023;
  const double mantissa =
      std::bit_cast<double>((bits & 0xfffffffffffffU) | std::bit_cast<std::uint64_t>(1.0)) - 1;
  return exponent + mantissa * (1.3465 - 0.3465 * mantissa);
}

/// 2^x to 0.3 %, x clamped to [-1000, 1000].
[[nodiscard]] inline double rough_exp2(double x) {
  const double held = std::clamp(x, -1000.0, 1000.0), whole = std::floor(held), part = held - whole;
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023) << 52U;
  return std::bit_cast<double>(exponent) * (1 + part * (0.6565 + 0.3435 * part));
}

/// The power of two nearest to a step size, by rough_log2().
[[nodiscard]] inline double power_of_two(double length) {
  return rough_exp2(std::floor(rough_log2(length) + 0.5));
}

/// The sum of c_k s^k for k = 1, ..., order, or of @p of (c_k) s^k; even and odd powers are summed in
/// parallel.
template <class Function = std::identity>
[[nodiscard]] double increment(const double* c, int order, double s, const Function& of = {}) {
  const double square = s * s;
  int k = order;
  double high = of(c[k]), low = of(c[k - 1]);
  for (k -= 2; k >= 2; k -= 2) {
    high = high * square + of(c[k]);
    low = low * square + of(c[k - 1]);
  }
  // high has the power k + 2, that is 3 or 2; low has the power below it.
  if (k == 1) return (high * square + of(c[1])) * s + low * square;
  return high * square + low * s;
}
/// The sum of |c_k s^k| for k = 1, ..., order.
[[nodiscard]] inline double largest_increment(const double* c, int order, double s) {
  return increment(c, order, std::abs(s), [](double term) { return std::abs(term); });
}

/// The derivative of the series with respect to s.
[[nodiscard]] inline double slope(const double* c, int order, double s) {
  double sum = order * c[order];
  for (int k = order - 1; k >= 1; --k) sum = sum * s + k * c[k];
  return sum;
}

/// The last two terms of a series, for the step size.
struct Tail : SeriesTail<double> {
  /// Are all coefficients finite? The last ones are computed from the others.
  [[nodiscard]] bool is_finite() const { return sum <= std::numeric_limits<double>::max(); }
  /// The step size at which the last two terms are 1, times 2 to the power @p log2_safety; positive.
  [[nodiscard]] double length(int order, double scale, double log2_safety) const {
    const double log2 = std::max(rough_log2(last) / order, rough_log2(before) / (order - 1));
    return scale * rough_exp2(log2_safety - log2);
  }
};

/// Tolerances, order, and the formulas of step-size control; see Series.
struct Rule {
  double relative_tolerance;  ///< rtol of the last terms
  double absolute_tolerance;  ///< atol of the last terms
  double largest_step;        ///< 0: no bound
  int order;                  ///< order of the series, the same in all steps

  /// Constants of step-size control.
  static constexpr StepRule steps = {.shortest = 0, .stretch = 1, .measured = true};
  /// Number of reductions of the unit of time if coefficients are not finite.
  static constexpr int attempts = 24;

  /// exp(-0.7/(N - 1)), as a power of two.
  [[nodiscard]] double log2_safety() const { return -0.7 / (order - 1) * 1.4426950408889634; }

  /// The unit of time of the first step: the time in which the state changes by its own size, at most @p
  /// interval.
  template <class X>
  [[nodiscard]] double first_scale(const X& x, const X& f, double interval) const {
    const double size = x.template lpNorm<Eigen::Infinity>() + absolute_tolerance;
    const double rate = f.template lpNorm<Eigen::Infinity>();
    return power_of_two(rate * interval > size ? size / rate : interval);
  }
  /// The unit of time of the next attempt. Coefficients that overflow with T do not overflow with a small
  /// fraction of T.
  [[nodiscard]] static double smaller(double scale) { return std::ldexp(scale, -16); }
  /// The unit of time of the step after one of size @p taken.
  [[nodiscard]] static double next_scale(double scale, double taken) {
    const double ratio = taken / scale;
    return ratio < 0.25 || ratio > 4 ? power_of_two(taken) : scale;
  }
  /// The step size.
  [[nodiscard]] double length(const Tail& tail, double scale, double log2_safety) const {
    const double h = tail.length(order, scale, log2_safety);
    return largest_step > 0 ? std::min(h, largest_step) : h;
  }

  /// Does the slope of the series at the end @p x1 of a step of size @p h agree with the right-hand side @p
  /// f? The first omitted term is about a tenth of the tolerance, its slope N + 1 times that; the bound is
  /// wider for stiff equations. @param slope_at slope of component i
  template <class X, class Slope>
  [[nodiscard]] bool slope_agrees(const X& x1, const X& f, double h, const Slope& slope_at) const {
    const double room = 100.0 * (order + 1), size = x1.template lpNorm<Eigen::Infinity>();
    for (int i = 0; i < static_cast<int>(x1.size()); ++i) {
      const double tolerance = absolute_tolerance + relative_tolerance * std::abs(x1[i]);
      const double rounding = 1000 * std::numeric_limits<double>::epsilon() * (size + std::abs(h * f[i]));
      const double difference = std::abs(h * (f[i] - slope_at(i)));
      if (!(difference <= room * tolerance + rounding)) return false;
    }
    return true;
  }
};

}  // namespace taylor_series

/// Each step sums the Taylor series of the solution about its start.
///
/// With a `step` T and an order N this is the scheme of C. P. Filipich and M. B. Rosales, A straightforward
/// approach to solve ordinary nonlinear differential systems, section 3.2: steps of equal size, N terms
/// beyond the first, without an error estimate. It converges if T is below the radius of convergence at every
/// step; otherwise the result is wrong without a warning.
///
/// Without a `step`, the step size is adaptive after A. Jorba and M. Zou, A software package for the
/// numerical integration of ODEs by means of high-order Taylor methods, Experimental Mathematics 14 (2005)
/// 99-117: the step size at which the last two terms, in the norm max_i |e_i| / (atol + rtol |x_i|), are 1,
/// times exp(-0.7/(N - 1)); the order follows from the tolerance. A first step, or one more than twice as
/// large as the last, is tested: if the slope of the series at its end does not agree with the equation, the
/// step is halved (the last terms of a series with gaps may vanish). Steps stay within the radius of
/// convergence.
///
/// Steps end on the problem's discontinuities. The step size is the difference of the doubles at its ends, so
/// errors of time do not accumulate; the sum of the state is compensated.
///
/// Dense output: the series of the step, as accurate as its end. Statistics::right_hand_sides counts orders:
/// N per step, each as much work as an evaluation with all products replaced by sums.
///
/// Tests assert the order N of fixed steps (observed within 0.25); for adaptive steps an error of 20
/// tolerances and 40 eps of a damped motion over ten units of time, and Lorenz's equations at t = 20 to 1e-8
/// against 70 digits.
struct Series {
  static constexpr std::string_view name = "series";  ///< on command lines and in tables
  double relative_tolerance = 1e-9;                   ///< rtol of the last terms, from 1e-18 to 0.1
  double absolute_tolerance = 1e-9;                   ///< atol of the last terms, positive
  int order = 0;                                      ///< N, from 2 to 100; 0: series_order() of rtol
  double step = 0;                                    ///< T, fixed step size; 0: adaptive
  double largest_step = 0;                            ///< largest step size; 0: no bound
};

/// The default order for a relative tolerance: least work for problems of a few products, whose cost per step
/// is proportional to the order rather than to its square.
[[nodiscard]] int series_order(double relative_tolerance);

/// @throws std::invalid_argument naming an option out of range and its value
void check_options(const Series& method);

/// Rule of @p method with its order or the default order.
[[nodiscard]] inline taylor_series::Rule rule_of(const Series& method) {
  return {method.relative_tolerance, method.absolute_tolerance, method.largest_step,
          method.order > 0 ? method.order : series_order(method.relative_tolerance)};
}

/// See integrate(). @throws std::invalid_argument also for a problem that cannot be expanded: in double only,
/// or with a branch for which it gives no discontinuities
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Series& method);

}  // namespace nlmech::ivp

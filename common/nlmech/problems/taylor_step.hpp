/// @file
/// One step of a Taylor series of high order in any precision: its coefficients, its length, its sum.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "nlmech/program/growing_series.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech::problems {

/// A step by Taylor series: from `start` on, the state is the sum of `coefficient[k] * s^k` at start + s.
template <class Real, int n>
struct TaylorStep {
  Real start{};                              ///< time at the beginning
  Real length{};                             ///< as far as the series is used
  std::vector<Vector<Real, n>> coefficient;  ///< by power

  /// The sum of the series at start + @p s without its first term, which is the greater by far: added last,
  /// it is rounded once.
  [[nodiscard]] Vector<Real, n> increment(const Real& s) const {
    Vector<Real, n> sum = coefficient.back();
    for (std::size_t k = coefficient.size() - 1; k-- > 1;) sum = (sum * s + coefficient[k]).eval();
    return sum * s;
  }
  /// The derivative of the sum at start + @p s.
  [[nodiscard]] Vector<Real, n> rate(const Real& s) const {
    Vector<Real, n> sum = Vector<Real, n>::Zero(coefficient[0].size());
    for (std::size_t k = coefficient.size() - 1; k > 0; --k)
      sum = (sum * s + coefficient[k] * Real(static_cast<int>(k))).eval();
    return sum;
  }
  /// The state at start + @p s.
  [[nodiscard]] Vector<Real, n> at(const Real& s) const { return coefficient[0] + increment(s); }
};

/// The Taylor coefficients of the solution through @p x at time @p t: coefficient k + 1 is coefficient k of
/// the right-hand side over k + 1, which in turn depends on the coefficients up to k of the state.
/// @param memory is used and left with rubbish; keeping it from step to step saves its allocation
template <class Real, class Problem>
void taylor_coefficients(const Problem& problem, const Real& t, const Vector<Real, Problem::dimension>& x,
                         int order, std::vector<Vector<Real, Problem::dimension>>& coefficient,
                         SeriesMemory<Real>& memory) {
  const auto size = static_cast<int>(x.size());
  using Series = GrowingSeries<Real>;
  memory.start(static_cast<std::size_t>(order));
  Series time = Series::variable(memory);
  Vector<Series, Problem::dimension> state(size), slope(size);
  for (int i = 0; i < size; ++i) state[i] = Series::variable(memory);
  time.set(0, t);
  time.set(1, Real(1));
  coefficient.assign(static_cast<std::size_t>(order) + 1, x);
  for (int i = 0; i < size; ++i) state[i].set(0, x[i]);
  for (std::size_t k = 0; k < static_cast<std::size_t>(order); ++k) {
    memory.begin_pass(k);
    problem(time, state, slope);
    for (int i = 0; i < size; ++i) {
      coefficient[k + 1][i] = slope[i][k] / static_cast<int>(k + 1);
      state[i].set(k + 1, coefficient[k + 1][i]);
    }
  }
}

namespace detail {

/// Beyond every logarithm: the step of a solution that is a polynomial.
inline constexpr double polynomial = 1e9;

/// Logarithm to the base 2 of |x|; far below everything for 0.
template <class Real>
[[nodiscard]] double log2_of(const Real& x) {
  using std::abs;
  using std::frexp;
  int exponent = 0;
  const double mantissa = static_cast<double>(frexp(Real(abs(x)), &exponent));
  return mantissa > 0 ? std::log2(mantissa) + exponent : -polynomial;
}

/// Logarithm to the base 2 of the step at which the last two terms of the series are the tolerance relative
/// to the state's scale, after Jorba and Zou, A software package for the numerical integration of ODEs by
/// means of high-order Taylor methods, Experimental Mathematics 14 (2005) 99-117. The scale of a component is
/// its greatest value so far. What lies beyond @p most, the logarithm of the longest step, says nothing.
/// Logarithms, because the coefficients of a stiff problem leave the range of double.
template <class Real, int n>
[[nodiscard]] double log2_step(const std::vector<Vector<Real, n>>& c, double tolerance,
                               std::vector<double>& log2_scale, double most) {
  const std::size_t order = c.size() - 1;
  const auto size = static_cast<int>(c[0].size());
  const auto root = [&](int i, double log2_size) {
    const double last = (log2_size - log2_of(c[order][i])) / static_cast<double>(order);
    const double before = (log2_size - log2_of(c[order - 1][i])) / static_cast<double>(order - 1);
    return std::min(last, before);
  };
  double radius = polynomial, step = polynomial;
  for (int i = 0; i < size; ++i) radius = std::min(radius, root(i, 0));
  if (radius > polynomial / static_cast<double>(2 * order)) return polynomial;
  radius = std::min(radius, most);
  for (int i = 0; i < size; ++i) {
    // A component that starts at 0 gets the size of its terms well within the disc of convergence.
    double& scale = log2_scale[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < order; ++k) {
      scale = std::max(scale, log2_of(c[k][i]) + static_cast<double>(k) * (radius - 3));
    }
    step = std::min(step, root(i, scale + std::log2(tolerance)));
  }
  return step;
}

/// Does the sum of a series solve the equations within its step, which its coefficients alone do not show?
/// Those of tanh(100 (t - 5)) at t = 0 are zero but for the first, in any precision. Asked for beside the
/// end, where the equations may change; by a millionth of the state, or what is far more than truncation
/// leaves.
/// @param tolerance of the step, as of log2_step() @param log2_scale of the components, as of log2_step()
template <class Real, int n, class Problem>
[[nodiscard]] bool is_solution(const Problem& problem, const TaylorStep<Real, n>& step, double tolerance,
                               const std::vector<double>& log2_scale) {
  using std::isfinite;
  const double log2_share = std::max(-20.0, std::log2(tolerance) + 20);
  Vector<Real, n> slope(step.coefficient[0].size());
  for (const double part : {0.618, 0.999}) {
    const Real s = step.length * part;
    problem(Real(step.start + s), step.at(s), slope);
    const Vector<Real, n> rate = step.rate(s);
    for (Eigen::Index i = 0; i < slope.size(); ++i) {
      const double most =
          std::max({log2_of(Real(step.length * slope[i])), log2_of(Real(step.length * rate[i])),
                    log2_scale[static_cast<std::size_t>(i)]});
      const Real defect = step.length * (slope[i] - rate[i]);
      const bool is_small = defect == 0 || log2_of(defect) <= most + log2_share;
      if (!is_small || !isfinite(defect)) return false;
    }
  }
  return true;
}

/// 2^x rounded down to eight binary digits: sums of such steps are exact, and time carries no rounding.
template <class Real>
[[nodiscard]] Real short_step(double log2) {
  using std::ldexp;
  const double whole = std::floor(log2);
  return ldexp(Real(std::floor(256 * std::exp2(log2 - whole))), static_cast<int>(whole) - 8);
}

}  // namespace detail
}  // namespace nlmech::problems

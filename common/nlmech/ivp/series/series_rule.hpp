/// @file
/// What chosen steps of series go by: for a run alone and for runs side by side, which have the same bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "nlmech/ivp/series/series_expansion.hpp"
#include "nlmech/ivp/state.hpp"
#include "nlmech/ivp/step_control.hpp"

namespace nlmech::ivp::taylor_series {

/// Tolerances and order, and the formulas with them; see Series.
struct Rule {
  double relative_tolerance;  ///< of the last terms
  double absolute_tolerance;  ///< of the last terms
  double largest_step;        ///< 0: no bound
  int order;                  ///< of all steps

  /// Of the lengths of steps.
  static constexpr StepRule steps = {.shortest = 0, .stretch = 1, .measured = true};
  /// So often the unit of time is made smaller where coefficients are not finite.
  static constexpr int attempts = 24;

  /// exp(-0.7/(N - 1)), as a power of two.
  [[nodiscard]] double log2_safety() const { return -0.7 / (order - 1) * 1.4426950408889634; }

  /// The unit of time of the first step over @p interval: in which the state would change by its own size.
  template <class X>
  [[nodiscard]] double first_scale(const X& x, const X& f, double interval) const {
    const double size = x.template lpNorm<Eigen::Infinity>() + absolute_tolerance;
    const double rate = f.template lpNorm<Eigen::Infinity>();
    return power_of_two(rate * interval > size ? size / rate : interval);
  }
  /// That of the next attempt. Coefficients that leave the range of double with T leave it no more with a
  /// small part of T.
  [[nodiscard]] static double smaller(double scale) { return std::ldexp(scale, -16); }
  /// That of the step after one of length @p taken.
  [[nodiscard]] static double next_scale(double scale, double taken) {
    const double ratio = taken / scale;
    return ratio < 0.25 || ratio > 4 ? power_of_two(taken) : scale;
  }
  /// How long a step is to be.
  [[nodiscard]] double length(const Tail& tail, double scale, double log2_safety) const {
    const double h = tail.length(order, scale, log2_safety);
    return largest_step > 0 ? std::min(h, largest_step) : h;
  }

  /// Is the slope of the series at the end @p x1 of a step of length @p h that of the equation, @p f? The
  /// term after the last one is some tenth of the tolerance and its slope N + 1 times that; the bound leaves
  /// room for a stiff equation. @param slope_at of component i
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

}  // namespace nlmech::ivp::taylor_series

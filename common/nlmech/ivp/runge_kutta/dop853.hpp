/// @file
/// The Runge-Kutta method of order 8(5,3) of Dormand and Prince, Hairer and Wanner.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "nlmech/ivp/runge_kutta/dop853_coefficients.hpp"
#include "nlmech/ivp/runge_kutta/embedded_runge_kutta.hpp"

namespace nlmech::ivp {

namespace dop853 {
struct Pair;
}

/// Order 8 in 12 stages, with estimates of orders 5 and 3 (J. R. Dormand, P. J. Prince; E. Hairer, S. P.
/// Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd edition, 1993, sections II.5 and II.10;
/// their code is DOP853).
///  - e5 and e3, the differences of the new state from the formulas of orders 5 and 3, have the norms
///    E = max_i |e_i|/(atol + rtol max(|x0_i|, |x1_i|)); a step is accepted if
///    err = E5 E5/sqrt(E5^2 + E3^2/100) <= 1. err is proportional to h^8. Hairer's code has root mean squares
///    in place of the maximum; with the maximum the tolerance applies to each component, as in the other
///    methods of nlmech, also if many others are at rest;
///  - the factor to the next step size is 0.8 err^(-1/8), or less if errors grow (StepControl::change()),
///    from 1/5 to 10: over thirteen smooth problems and tolerances from 1e-3 to 1e-13 these constants need 4
///    % fewer evaluations than the usual 0.9 and 6, and half as many rejections;
///  - the first step changes the state by (atol + rtol)^(1/8) of its size and is at most a tenth of the
///    segment.
/// A trial takes 11 evaluations, an accepted one another, of f at its end, which is the first of the next
/// step. A trial whose values are not finite is rejected. The method restarts at each discontinuity.
///
/// Dense output: the polynomial of degree 7 (section II.6), of order 7, continuously differentiable. It takes
/// three more evaluations, at the first request within a step only.
///
/// Tests assert all 200 order conditions of the formula and those of both estimates and the dense output for
/// the 26 to 30 digits of the coefficients, an error of one step of h^9 at its end and h^8 inside (exponents
/// within 0.3), and an error of ten tolerances for an oscillator at tolerances from 1e-6 to 1e-13.
struct Dop853 {
  static constexpr std::string_view name = "dop853";  ///< on command lines and in tables
  using Pair = dop853::Pair;                          ///< coefficients, error and step control
  double relative_tolerance = 1e-9;                   ///< rtol, from 0 to 0.1
  double absolute_tolerance = 1e-9;                   ///< atol, positive
  double initial_step = 0;  ///< first step of each segment; 0: chosen from f(t0, x0)
  double largest_step = 0;  ///< 0: the interval
};

namespace dop853 {

/// Rows of the dense output, each as an object for weighted().
template <std::size_t i>
inline constexpr auto dense_row = dense[i];

/// Coefficients and step-size control of the method.
struct Pair : EmbeddedPair<Pair> {
  static constexpr const auto& c = dop853::c;          ///< abscissae
  static constexpr const auto& a = dop853::a;          ///< rows
  static constexpr const auto& error_weights = fifth;  ///< weights of the first estimate
  static constexpr int order = 8;                      ///< of the combined estimate
  static constexpr std::size_t dense_stages = 3;       ///< evaluations for dense output
  static constexpr std::size_t coefficients = 7;       ///< vectors of the polynomial
  static constexpr double safety = 0.8;                ///< instead of the usual 0.9
  static constexpr double most_growth = 10;            ///< instead of the usual 6

  /// error^(1/8).
  [[nodiscard]] static double root(double error) { return std::sqrt(std::sqrt(std::sqrt(error))); }
  /// Writes the state at the end. @return E5 E5/sqrt(E5^2 + E3^2/100); NaN if a component is NaN
  template <class S>
  [[nodiscard]] static double finish(TrialStep<S, Pair>& step, const Dop853& method) {
    auto &slopes = step.r[0], &fifths = step.r[1], &thirds = step.r[2];
    weighted<stage_weights<Pair, stages>, stages>(step.k, slopes);
    weighted<fifth, stages>(step.k, fifths);
    weighted<third, stages>(step.k, thirds);
    const double h = step.h, absolute = method.absolute_tolerance, relative = method.relative_tolerance;
    double fifth_norm = 0, third_norm = 0;
    for (Eigen::Index d = 0; d < slopes.size(); ++d) {
      const double slope = slopes.data()[d], before = step.x0.data()[d], after = before + h * slope;
      step.x1.data()[d] = after;
      const double unit = 1 / (absolute + relative * std::max(std::abs(before), std::abs(after)));
      enlarge(fifth_norm, std::abs(unit * fifths.data()[d]));
      enlarge(third_norm, std::abs(unit * (slope - thirds.data()[d])));
    }
    const double square = fifth_norm * fifth_norm + 0.01 * (third_norm * third_norm);
    if (!std::isfinite(square)) return square;
    return square > 0 ? std::abs(h) * (fifth_norm * fifth_norm) / std::sqrt(square) : 0;
  }
  /// Computes the coefficients of the dense output.
  template <class S>
  static void expand(TrialStep<S, Pair>& step) {
    const double h = step.h;
    const auto& k = step.k;
    for (Eigen::Index d = 0; d < step.x0.size(); ++d) {
      const double change = step.x1[d] - step.x0[d], begin = h * k[0][d] - change;
      step.r[0][d] = change;
      step.r[1][d] = begin;
      step.r[2][d] = change - h * k[stages][d] - begin;
      step.r[3][d] = h * weighted<dense_row<0>, all_stages>(k, d);
      step.r[4][d] = h * weighted<dense_row<1>, all_stages>(k, d);
      step.r[5][d] = h * weighted<dense_row<2>, all_stages>(k, d);
      step.r[6][d] = h * weighted<dense_row<3>, all_stages>(k, d);
    }
  }
  /// Bounds on x - x0 of the dense output: at() for all s and 1 - s from 0 to 1.
  template <class S>
  [[nodiscard]] static program::Interval change(const TrialStep<S, Pair>& step, Eigen::Index i) {
    program::Interval x(0);
    for (std::size_t k = coefficients; k-- > 0;) x = plus_part(step.r[k].data()[i], x);
    return plus_part(0, x);
  }
  /// The polynomial of degree 7; order 7.
  template <class S>
  static void at(const TrialStep<S, Pair>& step, double t, typename S::State& x) {
    x.resize(step.x0.size());
    const double s = (t - step.t0) / step.h, u = 1 - s;
    for (Eigen::Index d = 0; d < x.size(); ++d) {
      const auto r = [&](std::size_t i) { return step.r[i].data()[d]; };
      const double inner = r(3) + s * (r(4) + u * (r(5) + s * r(6)));
      x.data()[d] = step.x0.data()[d] + s * (r(0) + u * (r(1) + s * (r(2) + u * inner)));
    }
  }
};

}  // namespace dop853

/// Overload for System, compiled in the library.
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Dop853& method);

}  // namespace nlmech::ivp

/// @file
/// The Runge-Kutta pair of Dormand and Prince with the step-size control of MATLAB's ode45.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "nlmech/ivp/runge_kutta/embedded_runge_kutta.hpp"

namespace nlmech::ivp {

namespace dormand_prince {
struct Pair;
}

/// Orders 5 and 4 in 7 stages, the last of which is the first of the next step (J. R. Dormand, P. J. Prince,
/// A family of embedded Runge-Kutta formulae, J. Comput. Appl. Math. 6 (1980) 19-26), continued with the
/// fifth-order value (local extrapolation). Step-size control is that of MATLAB's ode45 (L. F. Shampine, M.
/// W. Reichelt, The MATLAB ODE suite, SIAM J. Sci. Comput. 18 (1997) 1-22):
///  - a step is accepted if max_i |e_i| / max(|x0_i|, |x1_i|, atol/rtol) <= rtol, e the difference of both
///    orders;
///  - after a rejection the step size is multiplied by max(0.1, 0.8 (rtol/err)^(1/5)), after further ones
///    it is halved; after a step that is accepted at once the factor is (rtol/err)^(1/5)/1.25, at most 5;
///  - the last step is stretched by up to 10 %; no step is below 16 spacings of doubles at t.
/// A trial whose values are not finite is rejected. The method restarts at each discontinuity.
///
/// Dense output: the quartic of order 4 (Dormand, Prince, Runge-Kutta triples, Comput. Math. Appl. 12 A
/// (1986) 1007-1017), continuously differentiable. Observers receive `refine` equally spaced values of it per
/// step.
///
/// Tests assert the order conditions of the pair and its dense output (about ten eps), an error of one step
/// of h^6 at its end and h^5 inside (exponents within 0.3), and the errors 1.175e-4 and 1.142e-6 of Table
/// 4.2.
struct Ode45 {
  static constexpr std::string_view name = "ode45";  ///< on command lines and in tables
  using Pair = dormand_prince::Pair;                 ///< coefficients and step control
  double relative_tolerance = 1e-9;                  ///< rtol, from 100 eps = 2.22e-14 to 0.1
  double absolute_tolerance = 1e-9;                  ///< atol, positive
  double initial_step = 0;                           ///< first step of each segment; 0: chosen from f(t0, x0)
  double largest_step = 0;                           ///< 0: a tenth of the interval
  int refine = 4;                                    ///< output points per step for observers, from 1 to 1000
};

namespace dormand_prince {

inline constexpr int stages = 7;  ///< the last is the first of the next step

/// Abscissae.
inline constexpr std::array<double, stages> c = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};

/// Row i: weights of the stages before i. The last row is the fifth-order formula.
inline constexpr std::array<std::array<double, stages - 1>, stages> a = {
    {{},
     {1. / 5},
     {3. / 40, 9. / 40},
     {44. / 45, -56. / 15, 32. / 9},
     {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
     {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
     {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}}};

/// Fifth-order minus fourth-order weights.
inline constexpr std::array<double, stages> difference = {
    71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};

/// Row i: coefficients of s, s^2, s^3, s^4 in the weight of stage i at the fraction s of the step.
inline constexpr std::array<std::array<double, 4>, stages> dense = {
    {{1, -183. / 64, 37. / 12, -145. / 128},
     {},
     {0, 1500. / 371, -1000. / 159, 1000. / 371},
     {0, -125. / 32, 125. / 12, -375. / 64},
     {0, 9477. / 3392, -729. / 106, 25515. / 6784},
     {0, -11. / 7, 11. / 3, -55. / 28},
     {0, 3. / 2, -4, 5. / 2}}};

/// Weights of the stages in the coefficient of s^(j + 1), as an object for weighted().
template <std::size_t j>
inline constexpr std::array<double, stages> of_power = {dense[0][j], dense[1][j], dense[2][j], dense[3][j],
                                                        dense[4][j], dense[5][j], dense[6][j]};

/// Coefficients, and the step-size control of MATLAB.
struct Pair : EmbeddedPair<Pair> {
  static constexpr const auto& c = dormand_prince::c;       ///< abscissae
  static constexpr const auto& a = dormand_prince::a;       ///< rows
  static constexpr const auto& error_weights = difference;  ///< against the fourth-order formula
  static constexpr int order = 5;                           ///< of the estimate
  static constexpr bool step_times_weights = true;          ///< as in MATLAB
  /// As in MATLAB.
  static constexpr double least_relative_tolerance = 100 * std::numeric_limits<double>::epsilon();

  /// Step sizes of at most a tenth of the interval, stretched at the end, halved after repeated rejections.
  [[nodiscard]] static StepRule step_rule(const Ode45& method, double t0, double t1) {
    const double interval = std::abs(t1 - t0);
    // A tenth of a very short interval may be below the smallest step size.
    const double largest = method.largest_step > 0
                               ? std::min(interval, method.largest_step)
                               : std::max(interval / 10, 16 * spacing(std::max(std::abs(t0), std::abs(t1))));
    return {.largest = largest, .stretch = 1.1, .again = 0.5, .least_change = 1, .measured = true};
  }
  /// Relative to the larger of the state and atol/rtol, 0.8 rtol^(1/5).
  [[nodiscard]] static FirstStep first_step(const Ode45& method) {
    return {method.absolute_tolerance / method.relative_tolerance,
            0.8 * std::pow(method.relative_tolerance, 0.2)};
  }
  /// Step size after an accepted step, at most five times as large.
  [[nodiscard]] static double next_length(const StepControl& control, double error) {
    return control.taken() / std::max(0.2, 1.25 * std::pow(error, 0.2));
  }
  /// Step size after the first rejection; a tenth for an error that is NaN.
  [[nodiscard]] static double shorter_length(double taken, double error) {
    return taken * std::max(0.1, 0.8 * std::pow(error, -0.2));
  }
  /// max_i |e_i| / max(|x0_i|, |x1_i|, atol/rtol) / rtol; NaN if a component is NaN.
  template <class S>
  [[nodiscard]] static double finish(const TrialStep<S, Pair>& step, const Ode45& method) {
    const double threshold = method.absolute_tolerance / method.relative_tolerance;
    double largest = 0;
    for (int i = 0; i < step.x0.size(); ++i) {
      const double e = weighted<difference, stages>(step.k, i);
      enlarge(largest,
              std::abs(step.h * e) / std::max({std::abs(step.x0[i]), std::abs(step.x1[i]), threshold}));
    }
    return largest / method.relative_tolerance;
  }
  /// Bounds on x - x0 of the quartic: Horner's rule for all s from 0 to 1.
  template <class S>
  [[nodiscard]] static program::Interval change(const TrialStep<S, Pair>& step, Eigen::Index i) {
    program::Interval x(step.h * weighted<of_power<3>, stages>(step.k, i));
    x = plus_part(step.h * weighted<of_power<2>, stages>(step.k, i), x);
    x = plus_part(step.h * weighted<of_power<1>, stages>(step.k, i), x);
    x = plus_part(step.h * weighted<of_power<0>, stages>(step.k, i), x);
    return plus_part(0, x);
  }
  /// The quartic; order 4.
  template <class S>
  static void at(const TrialStep<S, Pair>& step, double t, typename S::State& x) {
    const double s = (t - step.t0) / step.h;
    std::array<double, stages> b;
    for (std::size_t i = 0; i < stages; ++i)
      b[i] = step.h * (s * (dense[i][0] + s * (dense[i][1] + s * (dense[i][2] + s * dense[i][3]))));
    x.resize(step.x0.size());
    add_stages(step.x0, b, step.k, x);
  }
};

}  // namespace dormand_prince

/// Overload for System, compiled in the library.
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Ode45& method);

}  // namespace nlmech::ivp

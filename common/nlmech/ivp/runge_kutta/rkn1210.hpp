/// @file
/// The Runge-Kutta-Nystroem pair of orders 12 and 10 for accelerations that do not depend on velocities.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "nlmech/ivp/runge_kutta/nystrom_pair.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210_coefficients.hpp"

namespace nlmech::ivp {

namespace rkn1210 {
struct Pair;
}

/// Orders 12 and 10 in 17 stages for q'' = a(t, q) (J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince,
/// High-order embedded Runge-Kutta-Nystroem formulae, IMA J. Numer. Anal. 7 (1987) 423-430), RKN12(10) of the
/// dissertation; continued with the values of order 12. A step is accepted if max_i |e_i|/(atol + rtol
/// max(|x0_i|, |x1_i|)) <= 1, e the difference of both orders in positions and velocities. The factor to the
/// next step size is 0.9 err^(-1/11), reduced if errors grow by the factor (h/h') (err'/err)^(1/11) (K.
/// Gustafsson, Control-theoretic techniques for stepsize selection in implicit Runge-Kutta methods, ACM
/// Trans. Math. Software 20 (1994) 496-517), from 0.2 to 4. A trial whose values are not finite is rejected.
/// The method restarts at each discontinuity.
///
/// Accelerations that depend on velocities are detected by evaluations with other velocities: before the
/// first step (std::invalid_argument) and after it (`outside_validity`).
///
/// Dense output: a shorter step, of the same order.
///
/// Tests assert the quadrature conditions of both orders for the 30 digits of the coefficients, and the
/// observed orders 12 and 10 within 0.6.
struct Rkn1210 {
  static constexpr std::string_view name = "rkn1210";  ///< on command lines and in tables
  using Pair = rkn1210::Pair;                          ///< coefficients and step control
  double relative_tolerance = 1e-9;                    ///< rtol, from 0 to 0.1
  double absolute_tolerance = 1e-9;                    ///< atol, positive
  double initial_step = 0;  ///< first step of each segment; 0: chosen from q, v and a
  double largest_step = 0;  ///< 0: the interval
};

namespace rkn1210 {

/// Weights of the high order minus those of the low order.
[[nodiscard]] constexpr Column difference(const Column& high, const Column& low) {
  Column d = {};
  for (std::size_t i = 0; i < stages; ++i) d[i] = high[i] - low[i];
  return d;
}

/// Coefficients and step control.
struct Pair : NystromPair<Pair> {
  static constexpr const auto& c = rkn1210::c;                                 ///< abscissae
  static constexpr const auto& a = rkn1210::a;                                 ///< rows
  static constexpr const auto& position = rkn1210::position;                   ///< of order 12
  static constexpr const auto& velocity = rkn1210::velocity;                   ///< of order 12
  static constexpr Column error_weights = difference(position, low_position);  ///< error weights of positions
  /// Error weights of velocities.
  static constexpr Column velocity_error_weights = difference(velocity, low_velocity);
  static constexpr int order = 11;          ///< of the error estimate
  static constexpr double most_growth = 4;  ///< largest factor on the step size

  /// Positions and velocities change by 2 (atol + rtol)^(1/12) of their size in the first step.
  [[nodiscard]] static FirstStep first_step(const Rkn1210& method) {
    const double tolerance = method.absolute_tolerance + method.relative_tolerance;
    return {method.absolute_tolerance / tolerance, 2 * std::pow(std::min(1.0, tolerance), 1. / 12)};
  }
  /// Step size after a rejection, at least a fifth.
  [[nodiscard]] static double shorter_length(double taken, double error) {
    return taken * std::min(0.9, std::max(0.2, 0.9 * std::pow(error, -1. / order)));
  }
};

}  // namespace rkn1210

/// Overload for System, compiled in the library.
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Rkn1210& method);

}  // namespace nlmech::ivp

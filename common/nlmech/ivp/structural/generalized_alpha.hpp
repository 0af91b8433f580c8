/// @file
/// The generalised alpha method for accelerations.
#pragma once

#include <string_view>

#include "nlmech/ivp/structural/alpha_stepper.hpp"

namespace nlmech::ivp {

/// The generalised alpha method (J. Chung, G. M. Hulbert, A time integration algorithm for structural
/// dynamics with improved numerical dissipation: the generalized-alpha method, J. Appl. Mech. 60 (1993)
/// 371-375), for q'' = g(t, q, v):
///
///     q1 = q0 + h v0 + h^2/2 [(1 - 2 beta) a0 + 2 beta a1],   v1 = v0 + h [(1 - gamma) a0 + gamma a1],
///     (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) g1 + alpha_f g0,
///     alpha_m = (2 rho - 1)/(rho + 1),   alpha_f = rho/(rho + 1),
///     gamma = 1/2 - alpha_m + alpha_f,   beta = (1 - alpha_m + alpha_f)^2/4.
///
/// The paper is linear; here forces are averaged, not their arguments, as the method of Hilber, Hughes and
/// Taylor does. Order 2; linear problems: unconditionally stable, and the spectral radius tends to rho for
/// h omega -> infinity with the least damping of low frequencies that this allows. a starts as g(t0, q0, v0),
/// also at each discontinuity. Implicit; solved by Newton's iteration with the exact Jacobian. Dense output:
/// the cubic Hermite interpolant.
///
/// Tests hold it to its difference equation in 50 digits (1e-13 a step), to order 2 (observed within 0.1),
/// and to what rho promises at h omega = 1e6 (2 %).
struct GeneralizedAlpha {
  static constexpr std::string_view name = "generalized-alpha";  ///< on command lines and in tables
  double step = 0.01;                                            ///< length of a step, positive
  /// rho: what is left of the highest frequencies after a step, from 0 (nothing) to 1 (all).
  double rho_inf = 0.8;
  algebraic::Newton newton = {};  ///< solves each step's equations for a1
};

/// The numbers of the family. @throws std::invalid_argument for rho_inf out of range
[[nodiscard]] AlphaScheme alpha_scheme(const GeneralizedAlpha& method);

/// Runs the generalised alpha method.
template <SystemLike S>
struct Integrator<S, GeneralizedAlpha> {
  /// See integrate(). @throws std::invalid_argument also for a problem without accelerations
  static Solution<S::dimension> run(const Task<S>& task, const GeneralizedAlpha& method) {
    return walk_by_alpha(task, method.name, method.step, alpha_scheme(method), method.newton);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<GeneralizedAlpha> = InLibrary::even;
/// @endcond

}  // namespace nlmech::ivp

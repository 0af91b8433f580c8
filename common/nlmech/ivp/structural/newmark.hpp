/// @file
/// Newmark's method for accelerations.
#pragma once

#include <string_view>

#include "nlmech/ivp/structural/alpha_stepper.hpp"

namespace nlmech::ivp {

/// Newmark's method (N. M. Newmark, A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE
/// 85 (1959) 67-94; Elgohary 2015, Eq. 4.6), for q'' = g(t, q, v):
///
///     q1 = q0 + h v0 + h^2/2 [(1 - 2 beta) g0 + 2 beta g1],   v1 = v0 + h [(1 - gamma) g0 + gamma g1].
///
/// Implicit; solved by Newton's iteration with the exact Jacobian. Order 2 for gamma = 1/2, else 1. Linear
/// problems: unconditionally stable if 2 beta >= gamma >= 1/2. The default (constant average acceleration)
/// keeps the energy of a linear oscillator. Dense output: the cubic Hermite interpolant.
///
/// Tests hold it to the rotation by 2 arctan(h/2) on the linear oscillator (16 eps (1 + h^2/4) a step, h
/// omega up to 50), to order 2 (observed within 0.1), and to the errors that
/// tools/oracles/rbf_ivp_methods.py has for Tables 4.2, 4.4 and 4.6.
struct Newmark {
  static constexpr std::string_view name = "newmark";  ///< on command lines and in tables
  double step = 0.01;                                  ///< length of a step, positive
  double beta = 0.25;                                  ///< from 0 (explicit positions) to 1/2
  double gamma = 0.5;                                  ///< from 0 to 1; above 1/2 it damps
  algebraic::Newton newton = {};                       ///< solves each step's equations for g1
};

/// The numbers of the family. @throws std::invalid_argument for beta or gamma out of range
[[nodiscard]] AlphaScheme alpha_scheme(const Newmark& method);

/// Runs Newmark's method.
template <SystemLike S>
struct Integrator<S, Newmark> {
  /// See integrate(). @throws std::invalid_argument also for a problem without accelerations
  static Solution<S::dimension> run(const Task<S>& task, const Newmark& method) {
    return walk_by_alpha(task, method.name, method.step, alpha_scheme(method), method.newton);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<Newmark> = InLibrary::even;
/// @endcond

}  // namespace nlmech::ivp

/// @file
/// The method of Hilber, Hughes and Taylor for accelerations.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/ivp/structural/alpha_stepper.hpp"

namespace nlmech::ivp {

/// The method of Hilber, Hughes and Taylor (Improved numerical dissipation for time integration algorithms in
/// structural dynamics, Earthq. Eng. Struct. Dyn. 5 (1977) 283-292; Elgohary 2015, Eq. 4.7 corrected), for
/// q'' = g(t, q, v):
///
///     q1 = q0 + h v0 + h^2/2 [(1 - 2 beta) a0 + 2 beta a1],   v1 = v0 + h [(1 - gamma) a0 + gamma a1],
///     a1 = (1 + alpha) g1 - alpha g0,   beta = (1 - alpha)^2/4,   gamma = 1/2 - alpha.
///
/// The acceleration a is carried from step to step; it starts as g(t0, q0, v0), also at each discontinuity.
/// Order 2; linear problems: unconditionally stable, high frequencies are damped for alpha < 0. Implicit;
/// solved by Newton's iteration with the exact Jacobian. Dense output: the cubic Hermite interpolant.
///
/// Tests hold both forms to their difference equations in 50 digits (1e-13 a step), the usual one to order 2
/// and the printed one to order 1 (observed within 0.1), and the former to the errors that
/// tools/oracles/rbf_ivp_methods.py has for Tables 4.2, 4.4 and 4.6.
struct Hht {
  static constexpr std::string_view name = "hht";  ///< on command lines and in tables
  /// Which equations.
  enum class Form : std::uint8_t {
    corrected,  ///< the method of 1977
    as_printed  ///< Eq. 4.7 to the letter: g(t0, q0, v0) where a0 belongs; order 1 unless alpha = 0
  };
  double step = 0.01;             ///< length of a step, positive
  double alpha = -0.1;            ///< from -1/3 (most dissipation) to 0 (Newmark's method)
  Form form = Form::corrected;    ///< as_printed: for the errata only
  algebraic::Newton newton = {};  ///< solves each step's equations for a1
};

/// The numbers of the family. @throws std::invalid_argument for alpha out of range
[[nodiscard]] AlphaScheme alpha_scheme(const Hht& method);

/// Runs the method of Hilber, Hughes and Taylor.
template <SystemLike S>
struct Integrator<S, Hht> {
  /// See integrate(). @throws std::invalid_argument also for a problem without accelerations
  static Solution<S::dimension> run(const Task<S>& task, const Hht& method) {
    return walk_by_alpha(task, method.name, method.step, alpha_scheme(method), method.newton);
  }
};

/// @cond
template <>
inline constexpr InLibrary in_library<Hht> = InLibrary::even;
/// @endcond

}  // namespace nlmech::ivp

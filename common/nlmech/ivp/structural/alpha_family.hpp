/// @file
/// The alpha family of implicit methods for second-order problems: Newmark, Hilber-Hughes-Taylor, generalised
/// alpha.
#pragma once

#include <cstdint>
#include <string_view>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/ivp/integrate.hpp"

namespace nlmech::ivp {

/// Parameters of the family for q'' = g(t, q, v):
///
///     q1 = q0 + h v0 + h^2/2 [(1 - 2 beta) a0 + 2 beta a1],   v1 = v0 + h [(1 - gamma) a0 + gamma a1],
///     (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) g1 + alpha_f g0.
///
/// The accelerations a are variables of the method: they start as g(t0, q0, v0) and are then passed from step
/// to step. Order 2 if and only if gamma = 1/2 - alpha_m + alpha_f.
struct AlphaScheme {
  double alpha_m = 0;    ///< weight of the old acceleration
  double alpha_f = 0;    ///< weight of the old force
  double beta = 0.25;    ///< weight of the new acceleration in positions
  double gamma = 0.5;    ///< weight of the new acceleration in velocities
  bool forgets = false;  ///< is a0 replaced by g0 in every step?
};

/// Newmark's method (N. M. Newmark, A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE
/// 85 (1959) 67-94; Elgohary 2015, Eq. 4.6), for q'' = g(t, q, v):
///
///     q1 = q0 + h v0 + h^2/2 [(1 - 2 beta) g0 + 2 beta g1],   v1 = v0 + h [(1 - gamma) g0 + gamma g1].
///
/// Implicit; solved by Newton's iteration with the exact Jacobian. Order 2 for gamma = 1/2, otherwise 1.
/// Linear problems: unconditionally stable if 2 beta >= gamma >= 1/2. The default (constant average
/// acceleration) conserves the energy of a linear oscillator. Dense output: the cubic Hermite interpolant.
///
/// Tests assert the rotation by 2 arctan(h/2) on the linear oscillator (16 eps (1 + h^2/4) per step, h omega
/// up to 50), order 2 (observed within 0.1), and the errors of tools/oracles/rbf_ivp_methods.py for Tables
/// 4.2, 4.4 and 4.6.
struct Newmark {
  static constexpr std::string_view name = "newmark";  ///< on command lines and in tables
  double step = 0.01;                                  ///< step size, positive
  double beta = 0.25;                                  ///< from 0 (explicit positions) to 1/2
  double gamma = 0.5;                                  ///< from 0 to 1; numerical damping above 1/2
  algebraic::Newton newton = {};                       ///< solves each step's equations for g1
};

/// Parameters of the family. @throws std::invalid_argument for beta or gamma out of range
[[nodiscard]] AlphaScheme alpha_scheme(const Newmark& method);

/// See integrate(). @throws std::invalid_argument also for a problem without accelerations
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Newmark& method);

/// The method of Hilber, Hughes and Taylor (Improved numerical dissipation for time integration algorithms in
/// structural dynamics, Earthq. Eng. Struct. Dyn. 5 (1977) 283-292; Elgohary 2015, Eq. 4.7 corrected), for
/// q'' = g(t, q, v):
///
///     q1 = q0 + h v0 + h^2/2 [(1 - 2 beta) a0 + 2 beta a1],   v1 = v0 + h [(1 - gamma) a0 + gamma a1],
///     a1 = (1 + alpha) g1 - alpha g0,   beta = (1 - alpha)^2/4,   gamma = 1/2 - alpha.
///
/// The acceleration a is passed from step to step; it starts as g(t0, q0, v0), also at each discontinuity.
/// Order 2; linear problems: unconditionally stable, with damping of high frequencies for alpha < 0.
/// Implicit; solved by Newton's iteration with the exact Jacobian. Dense output: the cubic Hermite
/// interpolant.
///
/// Tests assert the difference equations of both forms in 50 digits (1e-13 per step), order 2 of the
/// corrected form and order 1 of the printed one (observed within 0.1), and the errors of
/// tools/oracles/rbf_ivp_methods.py for Tables 4.2, 4.4 and 4.6 for the corrected form.
struct Hht {
  static constexpr std::string_view name = "hht";  ///< on command lines and in tables
  /// Form of the equations.
  enum class Form : std::uint8_t {
    corrected,  ///< the method of 1977
    as_printed  ///< Eq. 4.7 as printed: g(t0, q0, v0) in place of a0; order 1 unless alpha = 0
  };
  double step = 0.01;             ///< step size, positive
  double alpha = -0.1;            ///< from -1/3 (most dissipation) to 0 (Newmark's method)
  Form form = Form::corrected;    ///< as_printed is for the errata only
  algebraic::Newton newton = {};  ///< solves each step's equations for a1
};

/// Parameters of the family. @throws std::invalid_argument for alpha out of range
[[nodiscard]] AlphaScheme alpha_scheme(const Hht& method);

/// See integrate(). @throws std::invalid_argument also for a problem without accelerations
[[nodiscard]] Solution run(const InitialValueProblem& problem, const Hht& method);

/// The generalised alpha method (J. Chung, G. M. Hulbert, A time integration algorithm for structural
/// dynamics with improved numerical dissipation: the generalized-alpha method, J. Appl. Mech. 60 (1993)
/// 371-375), for q'' = g(t, q, v):
///
///     q1 = q0 + h v0 + h^2/2 [(1 - 2 beta) a0 + 2 beta a1],   v1 = v0 + h [(1 - gamma) a0 + gamma a1],
///     (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) g1 + alpha_f g0,
///     alpha_m = (2 rho - 1)/(rho + 1),   alpha_f = rho/(rho + 1),
///     gamma = 1/2 - alpha_m + alpha_f,   beta = (1 - alpha_m + alpha_f)^2/4.
///
/// The paper treats linear problems; here the forces are averaged, not their arguments, as in the method of
/// Hilber, Hughes and Taylor. Order 2; linear problems: unconditionally stable, and the spectral radius tends
/// to rho for h omega -> infinity, with the least possible damping of low frequencies. a starts as g(t0, q0,
/// v0), also at each discontinuity. Implicit; solved by Newton's iteration with the exact Jacobian. Dense
/// output: the cubic Hermite interpolant.
///
/// Tests assert its difference equation in 50 digits (1e-13 per step), order 2 (observed within 0.1), and the
/// spectral radius rho at h omega = 1e6 (2 %).
struct GeneralizedAlpha {
  static constexpr std::string_view name = "generalized-alpha";  ///< on command lines and in tables
  double step = 0.01;                                            ///< step size, positive
  /// rho: spectral radius at infinite frequency, from 0 (full damping in one step) to 1 (no damping).
  double rho_inf = 0.8;
  algebraic::Newton newton = {};  ///< solves each step's equations for a1
};

/// Parameters of the family. @throws std::invalid_argument for rho_inf out of range
[[nodiscard]] AlphaScheme alpha_scheme(const GeneralizedAlpha& method);

/// See integrate(). @throws std::invalid_argument also for a problem without accelerations
[[nodiscard]] Solution run(const InitialValueProblem& problem, const GeneralizedAlpha& method);

}  // namespace nlmech::ivp

/// @file
/// Hermitian one-step difference operators with accelerations and jerks: Laier's Table 1, corrected, and the
/// stability function of a pair.
#pragma once

#include <array>
#include <string_view>

namespace nlmech::ivp {

/// A linear relation between the two ends of a step of size h,
///
///     A q0 + B q1 + h (C v0 + D v1) + h^2 (E a0 + F a1) + h^3 (G j0 + H j1) = 0,
///
/// with positions q, velocities v, accelerations a and their derivatives, the jerks j (J. E. Laier,
/// High-order algorithm for non-linear dynamics, Eq. 1 with all signs positive, as its Eq. 6 uses it).
struct HermitianOperator {
  double A;  ///< coefficient of q0
  double B;  ///< coefficient of q1
  double C;  ///< coefficient of h v0
  double D;  ///< coefficient of h v1
  double E;  ///< coefficient of h^2 a0
  double F;  ///< coefficient of h^2 a1
  double G;  ///< coefficient of h^3 j0
  double H;  ///< coefficient of h^3 j1
};

/// Two operators, for the two unknowns of a step.
struct HermitianPair {
  std::string_view name;     ///< on command lines and in tables
  HermitianOperator first;   ///< coefficients A to H
  HermitianOperator second;  ///< coefficients A1 to H1
};

/// Laier's pair: order 4. Its step of a linear oscillator is the Pade approximation (2, 2) of the
/// exponential.
inline constexpr HermitianPair laier = {"laier", {12, -12, 6, 6, 1, -1, 0, 0}, {0, 0, 12, -12, 6, 6, 1, -1}};
/// Newmark's method with constant average acceleration: order 2. A1 and B1 are printed with the wrong sign.
inline constexpr HermitianPair newmark_pair = {
    "newmark", {0, 0, -1, 1, -1. / 2, -1. / 2, 0, 0}, {-1, 1, -1, 0, -1. / 4, -1. / 4, 0, 0}};
/// Hoff and Pahl's method without dissipation: the same as Newmark's. F is printed with the wrong sign.
inline constexpr HermitianPair hoff = {
    "hoff", {0, 0, 1, -1, 1. / 2, 1. / 2, 0, 0}, {1, -1, 1, 0, 1. / 4, 1. / 4, 0, 0}};
/// Bazzi and Anderheggen's method without dissipation: the same as Newmark's.
inline constexpr HermitianPair bazzi = {"bazzi", {-2, 2, -1, -1, 0, 0, 0, 0}, {-4, 4, -4, 0, -1, -1, 0, 0}};
/// Argyris and Mlejnek's cubic method: order 4, conditionally stable: see amplification().
inline constexpr HermitianPair argyris = {"argyris",
                                          {1, -1, 1, 0, 21. / 60, 9. / 60, 3. / 60, -2. / 60},
                                          {0, 0, 1, -1, 6. / 12, 6. / 12, 1. / 12, -1. / 12}};

/// Laier's Table 1 with corrected misprints, in the order of its rows.
inline constexpr std::array hermitian_table = {laier, newmark_pair, hoff, bazzi, argyris};

/// The row with the name @p name. @throws std::invalid_argument with the known names
[[nodiscard]] const HermitianPair& hermitian_pair(std::string_view name);

/// Residual of an operator for the motion q = t^k over the step from 0 to 1, k from 0 to 20. Zero for all k
/// up to the degree of the operator.
[[nodiscard]] double residual_on_power(const HermitianOperator& op, int k);

/// A pair solved for the end of the step:
///
///     q1 = q0 + h v0 + h^2 (qa0 a0 + qa1 a1) + h^3 (qj0 j0 + qj1 j1),
///     v1 =           v0 + h (va0 a0 + va1 a1) + h^2 (vj0 j0 + vj1 j1).
struct HermitianStep {
  double qa0;  ///< weight of a0 in q1
  double qa1;  ///< weight of a1 in q1
  double qj0;  ///< weight of j0 in q1
  double qj1;  ///< weight of j1 in q1
  double va0;  ///< weight of a0 in v1
  double va1;  ///< weight of a1 in v1
  double vj0;  ///< weight of j0 in v1
  double vj1;  ///< weight of j1 in v1
};

/// The pair solved for q1 and v1. @throws std::invalid_argument naming the pair, if its operators are not
/// independent or not exact for uniform motion q = q0 + v0 t (the printed rows of Newmark and Hoff)
[[nodiscard]] HermitianStep solved_for_end(const HermitianPair& pair);

/// The order of convergence, from 0 to 5; the error of a step is one order higher in q and in v.
[[nodiscard]] int order_of(const HermitianStep& step);

/// Amplification matrix of a step of the linear oscillator q'' + 2 xi omega q' + omega^2 q = 0.
struct Amplification {
  double determinant;      ///< of the matrix from (q0, h v0) to (q1, h v1)
  double half_trace;       ///< half of its trace
  double spectral_radius;  ///< largest modulus of its eigenvalues; above 1 the step is unstable
  double phase;            ///< argument of its eigenvalues, rad, 0 to pi; exact: z sqrt(1 - xi^2)
};

/// The stability function. For xi = 0 the determinant of every row is 1. Laier's half trace is (z^4 - 60 z^2
/// + 144) / (z^4 + 12 z^2 + 144), within [-1, 1] for every z; Newmark's (4 - z^2)/(4 + z^2); that of Argyris,
/// (3 z^4 - 104 z^2 + 240) / (z^4 + 16 z^2 + 240), exceeds [-1, 1] for sqrt(10) < z < sqrt(12) and z >
/// sqrt(60). Computed in long double; eigenvalues that agree within 2^-58 count as a double eigenvalue.
/// @param step a pair solved for the end
/// @param z h omega, not negative
/// @param xi damping ratio (fraction of critical damping), 0 <= xi < 1
/// @throws std::invalid_argument for z or xi out of range
[[nodiscard]] Amplification amplification(const HermitianStep& step, double z, double xi = 0);

}  // namespace nlmech::ivp

/// @file
/// Pollution of the air: 25 reactions of 20 species, with rates from 1e-3 to 1e12 a minute.
#pragma once

#include <array>
#include <string_view>

#include "nlmech/problems/concentrations.hpp"
#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// The chemistry of an air pollution model (J. G. Verwer, Gauss-Seidel iteration for stiff ODEs from chemical
/// kinetics, SIAM J. Sci. Comput. 15 (1994) 1243-1259; Test Set for IVP Solvers, University of Bari, problem
/// pollu). Concentrations in ppm, time in minutes.
struct Pollution {
  static constexpr int dimension = 20;                   ///< concentrations
  using compiled_once = Pollution;                       ///< its System is compiled in the library
  static constexpr std::string_view name = "pollution";  ///< on command lines and in tables
  static constexpr double initial_time = 0;              ///< t_0
  static constexpr double final_time = 60;               ///< of the test set
  double light = 1;                                      ///< factor of the rates k1 and k16, 1 by day

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "y' = S r(y): 25 reactions of 20 species (Verwer 1994); light multiplies the rates of 1 and 16";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<Pollution>{"light", &Pollution::light, Range::not_negative}};

  /// Concentrations are not negative.
  [[nodiscard]] Vector<double, 20> lower_bounds() const {
    return concentrations_lower_bounds<20>(light >= 0);
  }

  /// Sulphur: what the dioxide loses the sulphate gains.
  template <class T>
  [[nodiscard]] Vector<T, 1> invariants(const T& /*t*/, const Vector<T, 20>& y) const {
    return Vector<T, 1>(T(y[16] + y[17]));
  }

  /// Of the test set.
  [[nodiscard]] static Vector<double, 20> initial_state() {
    Vector<double, 20> y = Vector<double, 20>::Zero();
    y[1] = 0.2;
    y[3] = 0.04;
    y[6] = 0.1;
    y[7] = 0.3;
    y[8] = 0.01;
    y[16] = 0.007;
    return y;
  }

  /// dy/dt. Reactions are numbered from 1, as in the publication.
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 20>& y, Vector<T, 20>& dydt) const {
    const T r1 = (0.35 * light) * y[0], r2 = 26.6 * (y[1] * y[3]), r3 = 12300 * (y[4] * y[1]);
    const T r4 = 0.00086 * y[6], r5 = 0.00082 * y[6], r6 = 15000 * (y[6] * y[5]), r7 = 0.00013 * y[8];
    const T r8 = 24000 * (y[8] * y[5]), r9 = 16500 * (y[10] * y[1]), r10 = 9000 * (y[10] * y[0]);
    const T r11 = 0.022 * y[12], r12 = 12000 * (y[9] * y[1]), r13 = 1.88 * y[13];
    const T r14 = 16300 * (y[0] * y[5]), r15 = 4.8e6 * y[2], r16 = (0.00035 * light) * y[3];
    const T r17 = 0.0175 * y[3], r18 = 1e8 * y[15], r19 = 4.44e11 * y[15], r20 = 1240 * (y[16] * y[5]);
    const T r21 = 2.1 * y[18], r22 = 5.78 * y[18], r23 = 0.0474 * (y[0] * y[3]);
    const T r24 = 1780 * (y[18] * y[0]), r25 = 3.12 * y[19];
    dydt[0] = r2 + r3 + r9 + r11 + r12 + r22 + r25 - r1 - r10 - r14 - r23 - r24;
    dydt[1] = r1 + r21 - r2 - r3 - r9 - r12;
    dydt[2] = r1 + r17 + r19 + r22 - r15;
    dydt[3] = r15 - r2 - r16 - r17 - r23;
    dydt[4] = 2 * r4 + r6 + r7 + r13 + r20 - r3;
    dydt[5] = r3 + 2 * r18 - r6 - r8 - r14 - r20;
    dydt[6] = r13 - r4 - r5 - r6;
    dydt[7] = r4 + r5 + r6 + r7;
    dydt[8] = -r7 - r8;
    dydt[9] = r7 + r9 - r12;
    dydt[10] = r8 + r11 - r9 - r10;
    dydt[11] = r9;
    dydt[12] = r10 - r11;
    dydt[13] = r12 - r13;
    dydt[14] = r14;
    dydt[15] = r16 - r18 - r19;
    dydt[16] = -r20;
    dydt[17] = r20;
    dydt[18] = r23 + r25 - r21 - r22 - r24;
    dydt[19] = r24 - r25;
  }
};

}  // namespace nlmech::problems

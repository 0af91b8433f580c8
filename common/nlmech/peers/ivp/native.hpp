/// @file
/// GSL and CVODE as in their manuals, for benchmarks: the library's own loop over steps and state, without
/// checks of the result and without status, observers and discontinuities, which would add to the cost.
#pragma once

#include "nlmech/peers/ivp/gsl/gsl.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"

namespace nlmech::peers {

/// Equations for C libraries; each function returns 0 for success.
struct NativeEquations {
  int size = 0;                                                       ///< number of components
  int (*rhs)(double t, const double* x, double* f, void* data) = {};  ///< dx/dt
  /// df/dx by rows and df/dt; null for explicit formulas.
  int (*jacobian)(double t, const double* x, double* dfdx, double* dfdt, void* data) = {};
  void* data = nullptr;  ///< argument of both functions
};

/// `gsl_odeiv2_driver_apply` from @p t0 to @p t1, as in section "Driver" of its manual.
/// @param x initial state; replaced by the final one @return true on success; false also without GSL
[[nodiscard]] bool gsl_natively(const Gsl& method, const NativeEquations& equations, double t0, double t1,
                                double* x);

/// One call of `CVode` in normal mode from @p t0 to @p t1, with a serial vector, dense factorisation and the
/// end as stop time, as in its examples.
/// @param x initial state; replaced by the final one @return true on success; false also without CVODE
[[nodiscard]] bool cvode_natively(const Cvode& method, const NativeEquations& equations, double t0, double t1,
                                  double* x);

}  // namespace nlmech::peers

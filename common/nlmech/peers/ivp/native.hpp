/// @file
/// GSL and CVODE as their manuals run them, for benchmarks: the library's own loop over steps, its own state,
/// no check of what comes out. What our interface adds to a library (a status, observers, discontinuities) is
/// left out, and with it what that costs.
#pragma once

#include "nlmech/peers/ivp/gsl/gsl.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"

namespace nlmech::peers {

/// Equations as C libraries take them; each function returns 0 for success.
struct NativeEquations {
  int size = 0;                                                       ///< number of components
  int (*rhs)(double t, const double* x, double* f, void* data) = {};  ///< dx/dt
  /// df/dx by rows and df/dt; null for explicit formulas.
  int (*jacobian)(double t, const double* x, double* dfdx, double* dfdt, void* data) = {};
  void* data = nullptr;  ///< handed to both
};

/// `gsl_odeiv2_driver_apply` from @p t0 to @p t1, as in section "Driver" of its manual.
/// @param x the state, to the end in place @return did GSL get there? False also without GSL
[[nodiscard]] bool gsl_natively(const Gsl& method, const NativeEquations& equations, double t0, double t1,
                                double* x);

/// One call of `CVode` in normal mode from @p t0 to @p t1, with a serial vector, dense factors and the
/// end as its stop time, as in its examples.
/// @param x the state, to the end in place @return did CVODE get there? False also without CVODE
[[nodiscard]] bool cvode_natively(const Cvode& method, const NativeEquations& equations, double t0, double t1,
                                  double* x);

}  // namespace nlmech::peers

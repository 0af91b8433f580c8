#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "nlmech/peers/ivp/native.hpp"

namespace nlmech::peers {
namespace {

const gsl_odeiv2_step_type* step_type(Gsl::Formula formula) {
  switch (formula) {
    case Gsl::Formula::rkf45: return gsl_odeiv2_step_rkf45;
    case Gsl::Formula::bsimp: return gsl_odeiv2_step_bsimp;
    case Gsl::Formula::msadams: return gsl_odeiv2_step_msadams;
    case Gsl::Formula::msbdf: return gsl_odeiv2_step_msbdf;
    case Gsl::Formula::rk8pd: break;
  }
  return gsl_odeiv2_step_rk8pd;
}

}  // namespace

bool gsl_natively(const Gsl& method, const NativeEquations& equations, double t0, double t1, double* x) {
  gsl_error_handler_t* before = gsl_set_error_handler_off();  // it would end the program
  gsl_odeiv2_system system = {equations.rhs, equations.jacobian, static_cast<std::size_t>(equations.size),
                              equations.data};
  gsl_odeiv2_driver* driver = gsl_odeiv2_driver_alloc_y_new(
      &system, step_type(method.formula), 1e-6, method.absolute_tolerance, method.relative_tolerance);
  double t = t0;
  const bool there = driver != nullptr && gsl_odeiv2_driver_apply(driver, &t, t1, x) == GSL_SUCCESS;
  if (driver != nullptr) gsl_odeiv2_driver_free(driver);
  gsl_set_error_handler(before);
  return there;
}

}  // namespace nlmech::peers

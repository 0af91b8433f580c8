/// @file
/// What CVODE and ARKODE share: callbacks, and the meaning of return flags. Only sources that are compiled
/// with SUNDIALS include this.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/peers/ivp/peer_stepper.hpp"
#include "nlmech/peers/sundials_objects.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::peers {

/// What callbacks get as their user data.
struct SundialsCallbacks {
  Equations& equations;  ///< to evaluate
  Rethrower exceptions;  ///< of the equations

  /// f; 1, "try a shorter step", if it is not finite. SUNDIALS itself would take a NaN for a number.
  static int rhs(realtype t, N_Vector x, N_Vector f, void* data) noexcept {
    auto& self = *static_cast<SundialsCallbacks*>(data);
    return self.exceptions.keep(-1, [&] {
      double* out = N_VGetArrayPointer(f);
      self.equations.rhs(t, N_VGetArrayPointer(x), out);
      return self.equations.check(out) ? 0 : 1;
    });
  }
  /// df/dx, likewise.
  static int jacobian(realtype t, N_Vector x, N_Vector /*f*/, SUNMatrix j, void* data, N_Vector, N_Vector,
                      N_Vector) noexcept {
    auto& self = *static_cast<SundialsCallbacks*>(data);
    return self.exceptions.keep(-1, [&] {
      double* out = SUNDenseMatrix_Data(j);
      const int size = self.equations.size();
      self.equations.jacobian(t, N_VGetArrayPointer(x), out);
      return all_finite(out, size * size) ? 0 : 1;
    });
  }
};

/// SUNDIALS interpolates within the latest step alone, and leaves the vector as it is elsewhere.
[[noreturn]] inline void refuse_dense_output(std::string_view method, double t) {
  throw invalid_argument("{}: t = {:.17g} is not within the latest step", method, t);
}

/// The status of a negative return flag of CVode() or ARKStepEvolve(), which number them alike.
[[nodiscard]] inline Status sundials_failure(std::string_view method, int flag, double t, double step) {
  const auto sentence = [&](std::string_view what) {
    return fmt::format("{}: at t = {:.17g}, with a step of {:.6g}, {} (flag {})", method, t, step, what,
                       flag);
  };
  switch (flag) {
    case -2:
      return Status::failure(
          Outcome::step_underflow,
          sentence("the tolerance asks for more digits than double precision has; loosen it"));
    case -3:
      return Status::failure(Outcome::step_underflow,
                             sentence("the error stays above the tolerance however short the step is; the "
                                      "solution may be singular there, else loosen the tolerance"));
    case -4:
      return Status::failure(Outcome::newton_diverged,
                             sentence("the equations of the step were not solved however short it is; the "
                                      "solution may be singular there, else loosen the tolerance"));
    case -6:
    case -7:
      return Status::failure(Outcome::singular_matrix,
                             sentence("the Newton matrix could not be formed or factorised; loosen the "
                                      "tolerance or take an explicit method"));
    case -8:
    case -9:
    case -10:
    case -11: return non_finite_rhs(method, t, step);
    case -27: return ivp::step_underflow(method, t, step);
    default:
      return Status::failure(Outcome::not_converged,
                             sentence("the library gave up; loosen the tolerance or take another method"));
  }
}

}  // namespace nlmech::peers

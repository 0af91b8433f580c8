/// @file
/// Common code of CVODE and ARKODE: callbacks, return flags, and the stepper. Only for sources that are
/// compiled with SUNDIALS.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/peers/ivp/peer_stepper.hpp"
#include "nlmech/peers/sundials_objects.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::peers {

/// User data of the callbacks.
struct SundialsCallbacks {
  Equations& equations;  ///< equations to evaluate
  Rethrower exceptions;  ///< exceptions of the equations

  /// Evaluates f. @returns 1, "try a shorter step", if f is not finite, which SUNDIALS does not check
  static int rhs(realtype t, N_Vector x, N_Vector f, void* data) noexcept {
    auto& self = *static_cast<SundialsCallbacks*>(data);
    return self.exceptions.keep(-1, [&] {
      double* out = N_VGetArrayPointer(f);
      self.equations.rhs(t, N_VGetArrayPointer(x), out);
      return self.equations.check(out) ? 0 : 1;
    });
  }
  /// Evaluates df/dx. @returns 1 if it is not finite
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

/// Throws for a time outside the latest step, where SUNDIALS does not interpolate and leaves the vector
/// unchanged.
[[noreturn]] inline void refuse_dense_output(std::string_view method, double t) {
  throw invalid_argument("{}: t = {:.17g} is not within the latest step", method, t);
}

/// Status of a negative return flag, which CVode() and ARKStepEvolve() number alike.
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
                             sentence("the library failed; loosen the tolerance or take another method"));
  }
}

/// Type of SUNDIALS callbacks for df/dx.
using SundialsJacobian = int (*)(realtype, N_Vector, N_Vector, SUNMatrix, void*, N_Vector, N_Vector,
                                 N_Vector);

/// Functions of an integrator of SUNDIALS, with the same arguments for CVODE and ARKODE.
struct SundialsFunctions {
  int (*evolve)(void*, realtype, N_Vector, realtype*, int);     ///< integrates to a time, or by one step
  int one_step;                                                 ///< last argument of evolve for one step
  int (*interpolate)(void*, realtype, int, N_Vector);           ///< interpolates within the latest step
  int (*set_stop_time)(void*, realtype);                        ///< sets a time that no step passes
  int (*current_step)(void*, realtype*);                        ///< size of the next step
  int (*last_step)(void*, realtype*);                           ///< size of the latest step
  int (*newton_iterations)(void*, long*);                       ///< number of Newton iterations
  int (*factorisations)(void*, long*);                          ///< number of factorisations
  int (*set_linear_solver)(void*, SUNLinearSolver, SUNMatrix);  ///< sets the linear solver of Newton's method
  int (*set_jacobian)(void*, SundialsJacobian);                 ///< sets the callback for df/dx
};

/// An integrator of SUNDIALS as a peer stepper.
class SundialsStepper : public PeerStepper {
 public:
  Status begin(double t, const double* x, double end) override {
    std::copy_n(x, size_, N_VGetArrayPointer(state_.get()));
    restart(t);
    functions_.set_stop_time(memory(), end);
    t_ = t;
    end_ = end;
    rejected_ = 0;
    return {};
  }

  Attempt attempt(double* x, Statistics& statistics) override {
    double t = t_, step = 0;
    const int flag = functions_.evolve(memory(), end_, state_.get(), &t, functions_.one_step);
    callbacks_.exceptions.rethrow();
    const long rejected = rejected_steps();
    statistics.rejected += rejected - rejected_;
    rejected_ = rejected;
    if (flag < 0) {
      functions_.current_step(memory(), &step);
      return {Attempt::Result::failed, t_, step, sundials_failure(name_, flag, t_, step)};
    }
    functions_.last_step(memory(), &step);
    std::copy_n(N_VGetArrayPointer(state_.get()), size_, x);
    t_ = t;
    return {Attempt::Result::accepted, t, step, {}};
  }

  void at(double t, double* x) override {
    const Uncounted uncounted(callbacks_.equations);  // ARKODE evaluates f for its interpolant
    const int flag = functions_.interpolate(memory(), t, 0, dense_.get());
    callbacks_.exceptions.rethrow();
    if (flag != 0) refuse_dense_output(name_, t);
    std::copy_n(N_VGetArrayPointer(dense_.get()), size_, x);
  }

  void add_counters(Statistics& statistics) const override {
    if (!solver_) return;
    long iterations = 0, factorisations = 0;
    functions_.newton_iterations(memory(), &iterations);
    functions_.factorisations(memory(), &factorisations);
    statistics.newton_iterations += iterations;
    statistics.factorisations += factorisations;
  }

 protected:
  /// Allocates the state and its interpolant for @p equations; @p name stands in messages, @p functions are
  /// those of the integrator.
  SundialsStepper(Equations& equations, std::string_view name, const SundialsFunctions& functions)
      : callbacks_{equations, {}},
        state_(N_VNew_Serial(equations.size(), context_.get())),
        dense_(N_VNew_Serial(equations.size(), context_.get())),
        name_(name),
        functions_(functions),
        size_(equations.size()) {}
  /// The integrator's memory.
  [[nodiscard]] virtual void* memory() const = 0;
  /// Restarts the integrator at (@p t, state_).
  virtual void restart(double t) = 0;
  /// Number of rejected steps since restart().
  [[nodiscard]] virtual long rejected_steps() const = 0;
  /// Selects Newton's method with the exact Jacobian and dense factorisation.
  void use_newton() {
    matrix_.emplace(SUNDenseMatrix(size_, size_, context_.get()));
    solver_.emplace(SUNLinSol_Dense(state_.get(), matrix_->get(), context_.get()));
    functions_.set_linear_solver(memory(), solver_->get(), matrix_->get());
    functions_.set_jacobian(memory(), &SundialsCallbacks::jacobian);
  }

  SundialsCallbacks callbacks_;  ///< user data of the callbacks
  SundialsContext context_;      ///< context of all objects
  SundialsVector state_;         ///< latest state

 private:
  SundialsVector dense_;
  std::optional<SundialsMatrix> matrix_;
  std::optional<SundialsLinearSolver> solver_;
  std::string_view name_;
  const SundialsFunctions& functions_;
  int size_;
  double t_ = 0, end_ = 0;
  long rejected_ = 0;
};

}  // namespace nlmech::peers

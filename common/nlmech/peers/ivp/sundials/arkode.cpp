#include "nlmech/peers/ivp/sundials/arkode.hpp"

#include <arkode/arkode_arkstep.h>

#include "nlmech/peers/ivp/sundials/sundials_handles.hpp"

namespace nlmech::peers {
namespace {

void free_arkode(void* memory) { ARKStepFree(&memory); }
using Memory = SundialsObject<void*, &free_arkode>;

constexpr SundialsFunctions functions = {.evolve = &ARKStepEvolve,
                                         .one_step = ARK_ONE_STEP,
                                         .interpolate = &ARKStepGetDky,
                                         .set_stop_time = &ARKStepSetStopTime,
                                         .current_step = &ARKStepGetCurrentStep,
                                         .last_step = &ARKStepGetLastStep,
                                         .newton_iterations = &ARKStepGetNumNonlinSolvIters,
                                         .factorisations = &ARKStepGetNumLinSolvSetups,
                                         .set_linear_solver = &ARKStepSetLinearSolver,
                                         .set_jacobian = &ARKStepSetJacFn};

class ArkodeStepper final : public SundialsStepper {
 public:
  ArkodeStepper(Equations& equations, const Arkode& method, double largest_step)
      : SundialsStepper(equations, method.name(), functions),
        explicit_(method.formula == Arkode::Formula::erk ? &SundialsCallbacks::rhs : nullptr),
        implicit_(method.formula == Arkode::Formula::erk ? nullptr : &SundialsCallbacks::rhs),
        arkode_(ARKStepCreate(explicit_, implicit_, 0, state_.get(), context_.get())) {
    void* memory = arkode_.get();
    ARKStepSetErrHandlerFn(memory, &silence_sundials, nullptr);
    ARKStepSetUserData(memory, &callbacks_);
    ARKStepSStolerances(memory, method.relative_tolerance, method.absolute_tolerance);
    ARKStepSetMaxNumSteps(memory, -1);  // no limit of its own (500): integrate_steps() has the limit
    if (implicit_) {
      use_newton();
      // One factorisation per step. By default ARKODE keeps the factorisation while the step size changes by
      // up to a fifth, and with it the estimated rate of convergence. After steps that converged at once it
      // then accepts the first iterate, with an unreported error of up to a thousand tolerances.
      ARKStepSetLSetupFrequency(memory, 1);
    }
    if (std::isfinite(largest_step)) ARKStepSetMaxStep(memory, largest_step);
  }

 private:
  [[nodiscard]] void* memory() const override { return arkode_.get(); }
  void restart(double t) override { ARKStepReInit(arkode_.get(), explicit_, implicit_, t, state_.get()); }
  [[nodiscard]] long rejected_steps() const override {
    long attempts = 0, steps = 0;
    ARKStepGetNumStepAttempts(arkode_.get(), &attempts);
    ARKStepGetNumSteps(arkode_.get(), &steps);
    return attempts - steps;
  }

  ARKRhsFn explicit_, implicit_;
  Memory arkode_;
};

}  // namespace

bool arkode_available() noexcept { return true; }

Status integrate_by(Run& run, const Arkode& method) {
  require_tolerances(method.name(), {method.relative_tolerance, method.absolute_tolerance});
  ArkodeStepper stepper(run.equations, method, run.limits.largest_step);
  return integrate_steps(method.name(), stepper, run);
}

}  // namespace nlmech::peers

#include "nlmech/peers/ivp/sundials/arkode.hpp"

#include <arkode/arkode_arkstep.h>

#include <optional>

#include "nlmech/peers/ivp/sundials/sundials_handles.hpp"

namespace nlmech::peers {
namespace {

void free_arkode(void* memory) { ARKStepFree(&memory); }
using Memory = SundialsObject<void*, &free_arkode>;

class ArkodeStepper final : public PeerStepper {
 public:
  ArkodeStepper(Equations& equations, const Arkode& method, double largest_step)
      : name_(method.name()),
        callbacks_{equations, {}},
        explicit_(method.formula == Arkode::Formula::erk ? &SundialsCallbacks::rhs : nullptr),
        implicit_(method.formula == Arkode::Formula::erk ? nullptr : &SundialsCallbacks::rhs),
        state_(N_VNew_Serial(equations.size(), context_.get())),
        dense_(N_VNew_Serial(equations.size(), context_.get())),
        arkode_(ARKStepCreate(explicit_, implicit_, 0, state_.get(), context_.get())),
        size_(equations.size()) {
    set_up(method);
    if (std::isfinite(largest_step)) ARKStepSetMaxStep(arkode_.get(), largest_step);
  }

  Status begin(double t, const double* x, double end) override {
    std::copy_n(x, size_, N_VGetArrayPointer(state_.get()));
    ARKStepReInit(arkode_.get(), explicit_, implicit_, t, state_.get());
    ARKStepSetStopTime(arkode_.get(), end);
    t_ = t;
    end_ = end;
    rejected_ = 0;
    return {};
  }

  Attempt attempt(double* x, Statistics& statistics) override {
    double t = t_, step = 0;
    const int flag = ARKStepEvolve(arkode_.get(), end_, state_.get(), &t, ARK_ONE_STEP);
    callbacks_.exceptions.rethrow();
    long attempts = 0, steps = 0;
    ARKStepGetNumStepAttempts(arkode_.get(), &attempts);
    ARKStepGetNumSteps(arkode_.get(), &steps);
    statistics.rejected += attempts - steps - rejected_;
    rejected_ = attempts - steps;
    if (flag < 0) {
      ARKStepGetCurrentStep(arkode_.get(), &step);
      return {Attempt::Result::failed, t_, step, sundials_failure(name_, flag, t_, step)};
    }
    ARKStepGetLastStep(arkode_.get(), &step);
    std::copy_n(N_VGetArrayPointer(state_.get()), size_, x);
    t_ = t;
    return {Attempt::Result::accepted, t, step, {}};
  }

  void at(double t, double* x) override {
    const Uncounted uncounted(callbacks_.equations);
    const int flag = ARKStepGetDky(arkode_.get(), t, 0, dense_.get());
    callbacks_.exceptions.rethrow();
    if (flag != ARK_SUCCESS) refuse_dense_output(name_, t);
    std::copy_n(N_VGetArrayPointer(dense_.get()), size_, x);
  }

  void add_counters(Statistics& statistics) const override {
    if (!implicit_) return;
    long iterations = 0, factorisations = 0;
    ARKStepGetNumNonlinSolvIters(arkode_.get(), &iterations);
    ARKStepGetNumLinSolvSetups(arkode_.get(), &factorisations);
    statistics.newton_iterations += iterations;
    statistics.factorisations += factorisations;
  }

 private:
  void set_up(const Arkode& method) {
    void* memory = arkode_.get();
    ARKStepSetErrHandlerFn(memory, &silence_sundials, nullptr);
    ARKStepSetUserData(memory, &callbacks_);
    ARKStepSStolerances(memory, method.relative_tolerance, method.absolute_tolerance);
    ARKStepSetMaxNumSteps(memory, -1);  // no limit of its own (500): the walk counts
    if (!implicit_) return;
    matrix_.emplace(SUNDenseMatrix(size_, size_, context_.get()));
    solver_.emplace(SUNLinSol_Dense(state_.get(), matrix_->get(), context_.get()));
    ARKStepSetLinearSolver(memory, solver_->get(), matrix_->get());
    ARKStepSetJacFn(memory, &SundialsCallbacks::jacobian);
    // A factorisation for each step. By default ARKODE keeps one while the step length changes by up to a
    // fifth, and with it the rate of convergence that it has seen: after steps that converged at once it then
    // takes the first iterate for the solution, with an error of up to a thousand tolerances that nothing
    // reports.
    ARKStepSetLSetupFrequency(memory, 1);
  }

  std::string_view name_;
  SundialsCallbacks callbacks_;
  ARKRhsFn explicit_, implicit_;
  SundialsContext context_;
  SundialsVector state_, dense_;
  std::optional<SundialsMatrix> matrix_;
  std::optional<SundialsLinearSolver> solver_;
  Memory arkode_;
  int size_;
  double t_ = 0, end_ = 0;
  long rejected_ = 0;
};

}  // namespace

bool arkode_available() noexcept { return true; }

Status integrate_by(Run& run, const Arkode& method) {
  require_tolerances(method.name(), {method.relative_tolerance, method.absolute_tolerance});
  ArkodeStepper stepper(run.equations, method, run.limits.largest_step);
  return walk(method.name(), stepper, run);
}

}  // namespace nlmech::peers

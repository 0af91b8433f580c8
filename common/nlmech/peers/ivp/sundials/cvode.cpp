#include <cvodes/cvodes.h>  // CVODE and its sensitivities: one library has both
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <optional>

#include "nlmech/peers/ivp/native.hpp"
#include "nlmech/peers/ivp/sundials/sundials_handles.hpp"

namespace nlmech::peers {
namespace {

void free_cvode(void* memory) { CVodeFree(&memory); }
using Memory = SundialsObject<void*, &free_cvode>;
using FixedPoint = SundialsObject<SUNNonlinearSolver, &SUNNonlinSolFree>;

constexpr SundialsFunctions functions = {.evolve = &CVode,
                                         .one_step = CV_ONE_STEP,
                                         .interpolate = &CVodeGetDky,
                                         .set_stop_time = &CVodeSetStopTime,
                                         .current_step = &CVodeGetCurrentStep,
                                         .last_step = &CVodeGetLastStep,
                                         .newton_iterations = &CVodeGetNumNonlinSolvIters,
                                         .factorisations = &CVodeGetNumLinSolvSetups,
                                         .set_linear_solver = &CVodeSetLinearSolver,
                                         .set_jacobian = &CVodeSetJacFn};

class CvodeStepper final : public SundialsStepper {
 public:
  CvodeStepper(Equations& equations, const Cvode& method, double largest_step)
      : SundialsStepper(equations, method.name(), functions),
        cvode_(CVodeCreate(method.formula == Cvode::Formula::adams ? CV_ADAMS : CV_BDF, context_.get())) {
    void* memory = cvode_.get();
    N_VConst(0, state_.get());
    CVodeSetErrHandlerFn(memory, &silence_sundials, nullptr);
    CVodeInit(memory, &SundialsCallbacks::rhs, 0, state_.get());
    CVodeSetUserData(memory, &callbacks_);
    CVodeSStolerances(memory, method.relative_tolerance, method.absolute_tolerance);
    CVodeSetMaxNumSteps(memory, -1);  // no limit of its own (500): integrate_steps() has the limit
    if (method.formula == Cvode::Formula::adams) {
      fixed_point_.emplace(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()));
      CVodeSetNonlinearSolver(memory, fixed_point_->get());
    } else {
      use_newton();
    }
    if (std::isfinite(largest_step)) CVodeSetMaxStep(memory, largest_step);
  }

 private:
  [[nodiscard]] void* memory() const override { return cvode_.get(); }
  void restart(double t) override { CVodeReInit(cvode_.get(), t, state_.get()); }
  [[nodiscard]] long rejected_steps() const override {
    long errors = 0, unsolved = 0;
    CVodeGetNumErrTestFails(cvode_.get(), &errors);
    CVodeGetNumStepSolveFails(cvode_.get(), &unsolved);
    return errors + unsolved;
  }

  std::optional<FixedPoint> fixed_point_;
  Memory cvode_;
};

const NativeEquations& equations_of(void* data) { return *static_cast<const NativeEquations*>(data); }

int rhs(realtype t, N_Vector x, N_Vector f, void* data) {
  const NativeEquations& e = equations_of(data);
  return e.rhs(t, NV_DATA_S(x), NV_DATA_S(f), e.data);
}

/// df/dx for SUNDIALS, whose matrices are stored by columns.
int jacobian(realtype t, N_Vector x, N_Vector /*f*/, SUNMatrix matrix, void* data, N_Vector dfdt, N_Vector,
             N_Vector) {
  const NativeEquations& e = equations_of(data);
  double* entries = SM_DATA_D(matrix);
  const int failed = e.jacobian(t, NV_DATA_S(x), entries, NV_DATA_S(dfdt), e.data);
  for (int i = 0; i < e.size; ++i) {
    for (int k = 0; k < i; ++k) std::swap(entries[i * e.size + k], entries[k * e.size + i]);
  }
  return failed;
}

}  // namespace

bool cvode_available() noexcept { return true; }

Status integrate_by(Run& run, const Cvode& method) {
  require_tolerances(method.name(), {method.relative_tolerance, method.absolute_tolerance});
  CvodeStepper stepper(run.equations, method, run.limits.largest_step);
  return integrate_steps(method.name(), stepper, run);
}

bool cvode_natively(const Cvode& method, const NativeEquations& equations, double t0, double t1, double* x) {
  const bool adams = method.formula == Cvode::Formula::adams;
  const SundialsContext context;
  const SundialsVector state(N_VMake_Serial(equations.size, x, context.get()));
  const Memory cvode(CVodeCreate(adams ? CV_ADAMS : CV_BDF, context.get()));
  std::optional<FixedPoint> fixed_point;
  std::optional<SundialsMatrix> matrix;
  std::optional<SundialsLinearSolver> solver;
  NativeEquations copy = equations;
  CVodeSetErrHandlerFn(cvode.get(), &silence_sundials, nullptr);
  CVodeInit(cvode.get(), &rhs, t0, state.get());
  CVodeSetUserData(cvode.get(), &copy);
  CVodeSStolerances(cvode.get(), method.relative_tolerance, method.absolute_tolerance);
  CVodeSetMaxNumSteps(cvode.get(), 10'000'000);
  if (adams) {
    fixed_point.emplace(SUNNonlinSol_FixedPoint(state.get(), 0, context.get()));
    CVodeSetNonlinearSolver(cvode.get(), fixed_point->get());
  } else {
    matrix.emplace(SUNDenseMatrix(equations.size, equations.size, context.get()));
    solver.emplace(SUNLinSol_Dense(state.get(), matrix->get(), context.get()));
    CVodeSetLinearSolver(cvode.get(), solver->get(), matrix->get());
    CVodeSetJacFn(cvode.get(), &jacobian);
  }
  CVodeSetStopTime(cvode.get(), t1);  // ends a step at t1, which is more accurate than interpolation
  double t = t0;
  return CVode(cvode.get(), t1, state.get(), &t, CV_NORMAL) >= 0;
}

}  // namespace nlmech::peers

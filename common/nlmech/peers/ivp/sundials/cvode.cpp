#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <optional>

#include "nlmech/peers/ivp/native.hpp"
#include "nlmech/peers/ivp/sundials/sundials_handles.hpp"

namespace nlmech::peers {
namespace {

void free_cvode(void* memory) { CVodeFree(&memory); }
using Memory = SundialsObject<void*, &free_cvode>;
using FixedPoint = SundialsObject<SUNNonlinearSolver, &SUNNonlinSolFree>;

class CvodeStepper final : public PeerStepper {
 public:
  CvodeStepper(Equations& equations, const Cvode& method, double largest_step)
      : name_(method.name()),
        callbacks_{equations, {}},
        state_(N_VNew_Serial(equations.size(), context_.get())),
        dense_(N_VNew_Serial(equations.size(), context_.get())),
        cvode_(CVodeCreate(method.formula == Cvode::Formula::adams ? CV_ADAMS : CV_BDF, context_.get())),
        size_(equations.size()) {
    set_up(method);
    if (std::isfinite(largest_step)) CVodeSetMaxStep(cvode_.get(), largest_step);
  }

  Status begin(double t, const double* x, double end) override {
    std::copy_n(x, size_, N_VGetArrayPointer(state_.get()));
    CVodeReInit(cvode_.get(), t, state_.get());
    CVodeSetStopTime(cvode_.get(), end);
    t_ = t;
    end_ = end;
    rejected_ = 0;
    return {};
  }

  Attempt attempt(double* x, Statistics& statistics) override {
    double t = t_, step = 0;
    const int flag = CVode(cvode_.get(), end_, state_.get(), &t, CV_ONE_STEP);
    callbacks_.exceptions.rethrow();
    long errors = 0, unsolved = 0;
    CVodeGetNumErrTestFails(cvode_.get(), &errors);
    CVodeGetNumStepSolveFails(cvode_.get(), &unsolved);
    statistics.rejected += errors + unsolved - rejected_;
    rejected_ = errors + unsolved;
    if (flag < 0) {
      CVodeGetCurrentStep(cvode_.get(), &step);
      return {Attempt::Result::failed, t_, step, sundials_failure(name_, flag, t_, step)};
    }
    CVodeGetLastStep(cvode_.get(), &step);
    std::copy_n(N_VGetArrayPointer(state_.get()), size_, x);
    t_ = t;
    return {Attempt::Result::accepted, t, step, {}};
  }

  void at(double t, double* x) override {
    if (CVodeGetDky(cvode_.get(), t, 0, dense_.get()) != CV_SUCCESS) refuse_dense_output(name_, t);
    std::copy_n(N_VGetArrayPointer(dense_.get()), size_, x);
  }

  void add_counters(Statistics& statistics) const override {
    if (!newton_) return;
    long iterations = 0, factorisations = 0;
    CVodeGetNumNonlinSolvIters(cvode_.get(), &iterations);
    CVodeGetNumLinSolvSetups(cvode_.get(), &factorisations);
    statistics.newton_iterations += iterations;
    statistics.factorisations += factorisations;
  }

 private:
  void set_up(const Cvode& method) {
    void* memory = cvode_.get();
    N_VConst(0, state_.get());
    CVodeSetErrHandlerFn(memory, &silence_sundials, nullptr);
    CVodeInit(memory, &SundialsCallbacks::rhs, 0, state_.get());
    CVodeSetUserData(memory, &callbacks_);
    CVodeSStolerances(memory, method.relative_tolerance, method.absolute_tolerance);
    CVodeSetMaxNumSteps(memory, -1);  // no limit of its own (500): the walk counts
    if (method.formula == Cvode::Formula::adams) {
      fixed_point_.emplace(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()));
      CVodeSetNonlinearSolver(memory, fixed_point_->get());
    } else {
      newton_ = true;
      matrix_.emplace(SUNDenseMatrix(size_, size_, context_.get()));
      solver_.emplace(SUNLinSol_Dense(state_.get(), matrix_->get(), context_.get()));
      CVodeSetLinearSolver(memory, solver_->get(), matrix_->get());
      CVodeSetJacFn(memory, &SundialsCallbacks::jacobian);
    }
  }

  std::string_view name_;
  SundialsCallbacks callbacks_;
  SundialsContext context_;
  SundialsVector state_, dense_;
  std::optional<FixedPoint> fixed_point_;
  std::optional<SundialsMatrix> matrix_;
  std::optional<SundialsLinearSolver> solver_;
  Memory cvode_;
  int size_;
  bool newton_ = false;
  double t_ = 0, end_ = 0;
  long rejected_ = 0;
};

const NativeEquations& equations_of(void* data) { return *static_cast<const NativeEquations*>(data); }

int rhs(realtype t, N_Vector x, N_Vector f, void* data) {
  const NativeEquations& e = equations_of(data);
  return e.rhs(t, NV_DATA_S(x), NV_DATA_S(f), e.data);
}

/// SUNDIALS keeps matrices by columns.
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
  return walk(method.name(), stepper, run);
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
  CVodeSetStopTime(cvode.get(), t1);  // the end of a step, more accurate than what lies between
  double t = t0;
  return CVode(cvode.get(), t1, state.get(), &t, CV_NORMAL) >= 0;
}

}  // namespace nlmech::peers

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "nlmech/peers/ivp/native.hpp"
#include "nlmech/peers/sundials_objects.hpp"

namespace nlmech::peers {
namespace {

void free_cvode(void* memory) { CVodeFree(&memory); }
using Memory = SundialsObject<void*, &free_cvode>;
using FixedPoint = SundialsObject<SUNNonlinearSolver, &SUNNonlinSolFree>;

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

#include "nlmech/peers/ivp/sundials/cvodes.hpp"

#include <cvodes/cvodes.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <optional>

#include "nlmech/peers/sundials_objects.hpp"

namespace nlmech::peers {
namespace {

void free_cvodes(void* memory) { CVodeFree(&memory); }
using CvodesMemory = SundialsObject<void*, &free_cvodes>;
using NonlinearSolver = SundialsObject<SUNNonlinearSolver, &SUNNonlinSolFree>;

/// The equations, and memory for their arguments and values.
struct Data {
  const ivp::System& system;
  const ivp::System& extended;
  program::VariationalLayout layout;
  ivp::State x, f, all, slopes;
  ivp::Jacobian j;
};
Data& data_of(void* data) { return *static_cast<Data*>(data); }

int state_rhs(realtype t, N_Vector x, N_Vector f, void* user) {
  Data& d = data_of(user);
  std::copy_n(NV_DATA_S(x), d.x.size(), d.x.data());
  d.system.rhs(t, d.x, d.f);
  std::copy_n(d.f.data(), d.f.size(), NV_DATA_S(f));
  return 0;
}

int state_jacobian(realtype t, N_Vector x, N_Vector /*f*/, SUNMatrix matrix, void* user, N_Vector, N_Vector,
                   N_Vector) {
  Data& d = data_of(user);
  std::copy_n(NV_DATA_S(x), d.x.size(), d.x.data());
  d.system.jacobian(t, d.x, d.j);
  std::copy_n(d.j.data(), d.j.size(), SM_DATA_D(matrix));
  return 0;
}

int sensitivity_rhs(int columns, realtype t, N_Vector x, N_Vector /*f*/, N_Vector* s, N_Vector* dsdt,
                    void* user, N_Vector, N_Vector) {
  Data& d = data_of(user);
  for (int k = 0; k <= columns; ++k) {
    const double* from = NV_DATA_S(k == 0 ? x : s[k - 1]);
    for (int i = 0; i < d.layout.size; ++i) d.all[d.layout.place(i, k)] = from[i];
  }
  d.extended.rhs(t, d.all, d.slopes);
  for (int k = 1; k <= columns; ++k) {
    for (int i = 0; i < d.layout.size; ++i) NV_DATA_S(dsdt[k - 1])[i] = d.slopes[d.layout.place(i, k)];
  }
  return 0;
}

}  // namespace

bool cvodes_available() noexcept { return true; }

bool cvodes_natively(const Cvode& method, const ivp::System& system, const ivp::System& extended,
                     const std::vector<double>& sizes, double t0, double t1, ivp::State& x) {
  const program::VariationalLayout layout = extended.layout();
  const int n = layout.size, columns = layout.columns;
  Data data{system, extended, layout, ivp::State(n), ivp::State(n), x, x, ivp::Jacobian(n, n)};
  const SundialsContext context;
  const SundialsVector state(N_VNew_Serial(n, context.get()));
  N_Vector* const s = N_VCloneVectorArray(columns, state.get());
  const auto column = [&](int k) { return NV_DATA_S(k == 0 ? state.get() : s[k - 1]); };
  for (int k = 0; k <= columns; ++k) {
    for (int i = 0; i < n; ++i) column(k)[i] = x[layout.place(i, k)];
  }
  const bool adams = method.formula == Cvode::Formula::adams;
  const CvodesMemory memory(CVodeCreate(adams ? CV_ADAMS : CV_BDF, context.get()));
  void* const cvodes = memory.get();
  CVodeSetErrHandlerFn(cvodes, &silence_sundials, nullptr);
  CVodeInit(cvodes, &state_rhs, t0, state.get());
  CVodeSetUserData(cvodes, &data);
  CVodeSStolerances(cvodes, method.relative_tolerance, method.absolute_tolerance);
  CVodeSetMaxNumSteps(cvodes, 10'000'000);
  CVodeSensInit(cvodes, columns, CV_STAGGERED, &sensitivity_rhs, s);
  CVodeSetSensErrCon(cvodes, SUNTRUE);
  std::vector<double> scales = sizes;
  CVodeSetSensParams(cvodes, nullptr, scales.data(), nullptr);
  CVodeSensEEtolerances(cvodes);
  std::optional<NonlinearSolver> solver, sensitivity_solver;
  std::optional<SundialsMatrix> matrix;
  std::optional<SundialsLinearSolver> linear;
  if (adams) {
    solver.emplace(SUNNonlinSol_FixedPoint(state.get(), 0, context.get()));
    sensitivity_solver.emplace(SUNNonlinSol_FixedPointSens(columns, state.get(), 0, context.get()));
    CVodeSetNonlinearSolver(cvodes, solver->get());
    CVodeSetNonlinearSolverSensStg(cvodes, sensitivity_solver->get());
  } else {
    matrix.emplace(SUNDenseMatrix(n, n, context.get()));
    linear.emplace(SUNLinSol_Dense(state.get(), matrix->get(), context.get()));
    CVodeSetLinearSolver(cvodes, linear->get(), matrix->get());
    CVodeSetJacFn(cvodes, &state_jacobian);
  }
  CVodeSetStopTime(cvodes, t1);
  double t = t0;
  const bool ok = CVode(cvodes, t1, state.get(), &t, CV_NORMAL) >= 0 && CVodeGetSens(cvodes, &t, s) >= 0;
  for (int k = 0; k <= columns; ++k) {
    for (int i = 0; i < n; ++i) x[layout.place(i, k)] = column(k)[i];
  }
  N_VDestroyVectorArray(s, columns);
  return ok && x.allFinite();
}

}  // namespace nlmech::peers

#include "nlmech/peers/ivp/sundials/cvodes.hpp"

#include <cvodes/cvodes.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "nlmech/peers/sundials_objects.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::peers {
namespace {

void free_cvodes(void* memory) { CVodeFree(&memory); }
using CvodesMemory = SundialsObject<void*, &free_cvodes>;
using NonlinearSolver = SundialsObject<SUNNonlinearSolver, &SUNNonlinSolFree>;

/// The state @p x and its sensitivities @p s as one extended state.
void gather(N_Vector x, N_Vector* s, const program::VariationalLayout& layout, ivp::State& all) {
  for (int k = 0; k <= layout.columns; ++k) {
    const double* const from = N_VGetArrayPointer(k == 0 ? x : s[k - 1]);
    for (int i = 0; i < layout.size; ++i) all[layout.place(i, k)] = from[i];
  }
}
/// The inverse of gather(). @param x null: sensitivities alone
void spread(const ivp::State& all, const program::VariationalLayout& layout, N_Vector x, N_Vector* s) {
  for (int k = x == nullptr ? 1 : 0; k <= layout.columns; ++k) {
    double* const to = N_VGetArrayPointer(k == 0 ? x : s[k - 1]);
    for (int i = 0; i < layout.size; ++i) to[i] = all[layout.place(i, k)];
  }
}

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

int sensitivity_rhs(int /*columns*/, realtype t, N_Vector x, N_Vector /*f*/, N_Vector* s, N_Vector* dsdt,
                    void* user, N_Vector, N_Vector) {
  Data& d = data_of(user);
  gather(x, s, d.layout, d.all);
  d.extended.rhs(t, d.all, d.slopes);
  spread(d.slopes, d.layout, nullptr, dsdt);
  return 0;
}

}  // namespace

ivp::Solution integrate_by_cvodes(const Cvode& method, const ivp::System& system, const ivp::System& extended,
                                  std::vector<double> sizes, const ivp::State& x0, double t0, double t1,
                                  const std::function<void(double t, const ivp::State& x)>& observe) {
  const Stopwatch watch;
  const program::VariationalLayout layout = extended.layout();
  const int n = layout.size, columns = layout.columns;
  Data data{system, extended, layout, ivp::State(n), ivp::State(n), x0, x0, ivp::Jacobian(n, n)};
  const SundialsContext context;
  const SundialsVector state(N_VNew_Serial(n, context.get()));
  const auto destroy = [columns](N_Vector* all) { N_VDestroyVectorArray(all, columns); };
  const std::unique_ptr<N_Vector, decltype(destroy)> sensitivities(N_VCloneVectorArray(columns, state.get()),
                                                                   destroy);
  N_Vector* const s = sensitivities.get();
  spread(x0, layout, state.get(), s);
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
  CVodeSetSensParams(cvodes, nullptr, sizes.data(), nullptr);
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
  ivp::Solution end{t0, x0, {}, {}};
  bool ok = true;
  while (ok && end.t != t1) {
    ok = CVode(cvodes, t1, state.get(), &end.t, observe ? CV_ONE_STEP : CV_NORMAL) >= 0 &&
         CVodeGetSens(cvodes, &end.t, s) >= 0;
    gather(state.get(), s, layout, end.x);
    if (ok && observe) observe(end.t, end.x);
  }
  long steps = 0, of_state = 0, of_sensitivities = 0;
  CVodeGetNumSteps(cvodes, &steps);
  CVodeGetNumRhsEvals(cvodes, &of_state);
  CVodeGetSensNumRhsEvals(cvodes, &of_sensitivities);
  end.statistics.steps = steps;
  end.statistics.right_hand_sides = of_state + of_sensitivities;
  end.statistics.seconds = watch.seconds();
  if (!ok || !end.x.allFinite())
    end.status = Status::failure(Outcome::not_converged, "CVODES: a step fails; ask for another tolerance");
  return end;
}

}  // namespace nlmech::peers

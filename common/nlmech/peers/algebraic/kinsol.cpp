#include "nlmech/peers/algebraic/kinsol.hpp"

#include <kinsol/kinsol.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "nlmech/peers/sundials_objects.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::peers {
namespace {

using algebraic::Report;
using Eigen::Index;
using Eigen::VectorXd;

void free_kinsol(void* memory) { KINFree(&memory); }
using Memory = SundialsObject<void*, &free_kinsol>;

/// User data of the callbacks.
struct Calls {
  Calls(algebraic::Equations& of, const algebraic::Observer& by)
      : equations(of), observer(by), x(of.size()), f(of.size()), b(of.size(), of.size()) {}

  algebraic::Equations& equations;
  const algebraic::Observer& observer;
  VectorXd x, f;
  Eigen::MatrixXd b;
  Report report;
  std::exception_ptr exception;
  bool is_interrupted = false, is_bad_matrix = false;

  int residual(N_Vector at, N_Vector out) {
    std::copy_n(N_VGetArrayPointer(at), x.size(), x.data());
    equations.residual(x, f);
    const std::int64_t index = report.statistics.right_hand_sides++;
    const double norm = f.norm();
    if (index == 0) report.first = report.least = norm;
    report.least = std::min(report.least, norm);
    if (!std::isfinite(norm)) return 1;  // try a shorter step
    std::copy_n(f.data(), f.size(), N_VGetArrayPointer(out));
    is_interrupted = observer && !observer({index, static_cast<double>(index), x, f, norm});
    return is_interrupted ? -1 : 0;
  }

  int matrix(N_Vector at, SUNMatrix out) {
    std::copy_n(N_VGetArrayPointer(at), x.size(), x.data());
    equations.linearise(x);
    ++report.statistics.jacobians;
    equations.matrix(b);
    is_bad_matrix = !b.allFinite();
    if (is_bad_matrix) return -1;
    std::copy_n(b.data(), b.size(), SUNDenseMatrix_Data(out));
    return 0;
  }

  template <class Work>
  int keep(Work&& work) noexcept {
    try {
      return work();
    } catch (...) {
      exception = std::current_exception();
      return -1;
    }
  }

  static int call_residual(N_Vector at, N_Vector out, void* data) noexcept {
    auto& self = *static_cast<Calls*>(data);
    return self.keep([&] { return self.residual(at, out); });
  }
  static int call_matrix(N_Vector at, N_Vector, SUNMatrix out, void* data, N_Vector, N_Vector) noexcept {
    auto& self = *static_cast<Calls*>(data);
    return self.keep([&] { return self.matrix(at, out); });
  }
};

void check(const Kinsol& method) {
  const auto require = [&](bool good, const char* option, double value, const char* range) {
    if (!good) throw invalid_argument("{}: {} = {}; it must be {}", method.name(), option, value, range);
  };
  require(method.tolerance > 0 && std::isfinite(method.tolerance), "tolerance", method.tolerance, "positive");
  require(method.step_tolerance > 0 && std::isfinite(method.step_tolerance), "step_tolerance",
          method.step_tolerance, "positive");
  require(method.iterations >= 1, "iterations", static_cast<double>(method.iterations), "at least 1");
}

class Session {
 public:
  Session(const Kinsol& method, Calls& calls)
      : state_(N_VNew_Serial(calls.x.size(), context_.get())),
        scale_(N_VNew_Serial(calls.x.size(), context_.get())),
        matrix_(SUNDenseMatrix(calls.x.size(), calls.x.size(), context_.get())),
        solver_(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get())),
        memory_(KINCreate(context_.get())) {
    void* const m = memory_.get();
    N_VConst(1, scale_.get());
    KINSetErrHandlerFn(m, &silence_sundials, nullptr);
    KINInit(m, &Calls::call_residual, state_.get());
    KINSetUserData(m, &calls);
    KINSetLinearSolver(m, solver_.get(), matrix_.get());
    KINSetJacFn(m, &Calls::call_matrix);
    KINSetMaxSetupCalls(m, 1);  // a new Jacobian for every step
    KINSetFuncNormTol(m, method.tolerance);
    KINSetScaledStepTol(m, method.step_tolerance);
    KINSetNumMaxIters(m, static_cast<long>(method.iterations));
    KINSetMaxNewtonStep(m, 1e100);  // its default is about |x(0)|
  }

  int solve(const Kinsol& method, VectorXd& x) {
    std::copy_n(x.data(), x.size(), N_VGetArrayPointer(state_.get()));
    const int flag = KINSol(memory_.get(), state_.get(),
                            method.strategy == Kinsol::Strategy::none ? KIN_NONE : KIN_LINESEARCH,
                            scale_.get(), scale_.get());
    std::copy_n(N_VGetArrayPointer(state_.get()), x.size(), x.data());
    return flag;
  }

  void count(Statistics& statistics) const {
    long steps = 0, shortened = 0;
    KINGetNumNonlinSolvIters(memory_.get(), &steps);
    KINGetNumBacktrackOps(memory_.get(), &shortened);
    statistics.steps = statistics.newton_iterations = steps;
    statistics.rejected = shortened;
    statistics.factorisations = statistics.jacobians;
  }

 private:
  SundialsContext context_;
  SundialsVector state_, scale_;
  SundialsMatrix matrix_;
  SundialsLinearSolver solver_;
  Memory memory_;
};

struct Ending {
  Outcome outcome;
  const char* what;
};

Ending ending(int flag, const Calls& calls) {
  if (calls.is_interrupted) return {Outcome::interrupted, "stopped by the observer"};
  if (calls.is_bad_matrix) return {Outcome::non_finite, "dF/dx is not finite; start elsewhere"};
  switch (flag) {
    case KIN_STEP_LT_STPTOL:
    case KIN_LINESEARCH_NONCONV:
    case KIN_LINESEARCH_BCFAIL:
      return {Outcome::not_converged,
              "no step makes |F| smaller: a minimum that is no root, or rounding; start elsewhere or loosen "
              "the tolerance"};
    case KIN_MAXITER_REACHED:
    case KIN_MXNEWT_5X_EXCEEDED:
      return {Outcome::step_limit,
              "the allowed iterations are used up; allow more or start closer to a root"};
    case KIN_LSETUP_FAIL:
    case KIN_LINSOLV_NO_RECOVERY:
    case KIN_LSOLVE_FAIL: return {Outcome::singular_matrix, "the matrix dF/dx is singular; start elsewhere"};
    case KIN_SYSFUNC_FAIL:
    case KIN_FIRST_SYSFUNC_ERR:
    case KIN_REPTD_SYSFUNC_ERR: return {Outcome::non_finite, "F is not finite; start elsewhere"};
    default: return {Outcome::not_converged, "the library failed; start elsewhere or take another method"};
  }
}

}  // namespace

bool kinsol_available() noexcept { return true; }

Report find_root(const Kinsol& method, algebraic::Equations& equations, VectorXd& x,
                 const algebraic::Observer& observer) {
  check(method);
  algebraic::require_size(method.name().data(), equations, x);
  Calls calls(equations, observer);
  Session session(method, calls);
  const int flag = session.solve(method, x);
  if (calls.exception) std::rethrow_exception(calls.exception);
  session.count(calls.report.statistics);
  equations.residual(x, calls.f);  // final check, not counted
  const double norm = calls.f.norm(), greatest = calls.f.lpNorm<Eigen::Infinity>();
  calls.report.last = norm;
  // lpNorm may ignore a NaN component.
  const bool is_done = std::isfinite(norm) && x.allFinite() && greatest <= method.tolerance;
  if (!(flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK) || !is_done) {
    const Ending end = ending(flag, calls);
    calls.report.status = failed_with(end.outcome, "{}: at iteration {}, with |F| = {:.3g}: {} (flag {})",
                                      method.name(), calls.report.statistics.steps, norm, end.what, flag);
  }
  return std::move(calls.report);
}

}  // namespace nlmech::peers

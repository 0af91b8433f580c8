#include "nlmech/peers/algebraic/gsl_hybrid.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multiroots.h>

#include <cmath>
#include <exception>
#include <memory>

#include "nlmech/support/sentences.hpp"

namespace nlmech::peers {
namespace {

using algebraic::Report;
using Eigen::VectorXd;

/// A vector of GSL without gaps, as those that it allocates.
Eigen::Map<VectorXd> of(const gsl_vector* v) { return {v->data, static_cast<Eigen::Index>(v->size)}; }

/// User data of the callbacks.
struct RootCalls {
  algebraic::Equations& equations;
  VectorXd x, f;
  Eigen::MatrixXd b;
  Report report;
  std::exception_ptr exception;

  int residual(const gsl_vector* at, gsl_vector* out) {
    x = of(at);
    equations.residual(x, f);
    ++report.statistics.right_hand_sides;
    of(out) = f;
    return f.allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
  }
  int matrix(const gsl_vector* at, gsl_matrix* out) {
    x = of(at);
    equations.linearise(x);
    equations.matrix(b);
    ++report.statistics.jacobians;
    // By rows, without gaps.
    Eigen::Map<Eigen::MatrixXd>(out->data, b.rows(), b.cols()) = b.transpose();
    return b.allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
  }

  /// An exception must not pass through GSL.
  template <class Call>
  int guarded(const Call& call) {
    try {
      return call();
    } catch (...) {
      exception = std::current_exception();
      return GSL_EBADFUNC;
    }
  }
  static int call_residual(const gsl_vector* at, void* data, gsl_vector* out) {
    auto& calls = *static_cast<RootCalls*>(data);
    return calls.guarded([&] { return calls.residual(at, out); });
  }
  static int call_matrix(const gsl_vector* at, void* data, gsl_matrix* out) {
    auto& calls = *static_cast<RootCalls*>(data);
    return calls.guarded([&] { return calls.matrix(at, out); });
  }
  static int call_both(const gsl_vector* at, void* data, gsl_vector* f, gsl_matrix* j) {
    const int status = call_residual(at, data, f);
    return status == GSL_SUCCESS ? call_matrix(at, data, j) : status;
  }
};

Status failure_of(int status, std::int64_t steps, double norm) {
  const char* const what = status == GSL_EBADFUNC ? "F or dF/dx is not finite; start elsewhere"
                           : status == GSL_CONTINUE
                               ? "the allowed iterations are used up; allow more or start closer to a root"
                               : "the iteration makes no progress; start elsewhere";
  return failed_with(status == GSL_EBADFUNC   ? Outcome::non_finite
                     : status == GSL_CONTINUE ? Outcome::step_limit
                                              : Outcome::not_converged,
                     "gsl-hybrid: at iteration {}, with |F| = {:.3g}: {}", steps, norm, what);
}

}  // namespace

bool gsl_hybrid_available() noexcept { return true; }

Report find_root(const GslHybrid& method, algebraic::Equations& equations, VectorXd& x) {
  if (!(method.tolerance > 0) || method.iterations < 1)
    throw invalid_argument("gsl-hybrid: tolerance = {}, iterations = {}; both must be positive",
                           method.tolerance, method.iterations);
  algebraic::require_size("gsl-hybrid", equations, x);
  const auto n = static_cast<std::size_t>(x.size());
  gsl_error_handler_t* const before = gsl_set_error_handler_off();
  RootCalls calls{equations, x, VectorXd(x.size()), {}, {}, {}};
  gsl_multiroot_function_fdf function{&RootCalls::call_residual, &RootCalls::call_matrix,
                                      &RootCalls::call_both, n, &calls};
  const std::unique_ptr<gsl_vector, void (*)(gsl_vector*)> start(gsl_vector_alloc(n), gsl_vector_free);
  const std::unique_ptr<gsl_multiroot_fdfsolver, void (*)(gsl_multiroot_fdfsolver*)> solver(
      gsl_multiroot_fdfsolver_alloc(gsl_multiroot_fdfsolver_hybridsj, n), gsl_multiroot_fdfsolver_free);
  of(start.get()) = x;
  const auto norm = [&] { return of(gsl_multiroot_fdfsolver_f(solver.get())).stableNorm(); };
  int status = gsl_multiroot_fdfsolver_set(solver.get(), &function, start.get());
  double last = status == GSL_SUCCESS ? norm() : NAN;
  const double first = last;
  std::int64_t steps = 0;
  while (status == GSL_SUCCESS && !(last <= method.tolerance) && steps < method.iterations) {
    status = gsl_multiroot_fdfsolver_iterate(solver.get());
    ++steps;
    last = norm();
  }
  x = of(gsl_multiroot_fdfsolver_root(solver.get()));
  gsl_set_error_handler(before);
  if (calls.exception) std::rethrow_exception(calls.exception);
  Report report = std::move(calls.report);
  report.statistics.steps = steps;
  report.first = first;
  report.last = report.least = last;
  if (!(last <= method.tolerance))
    report.status = failure_of(status == GSL_SUCCESS ? GSL_CONTINUE : status, steps, last);
  return report;
}

}  // namespace nlmech::peers

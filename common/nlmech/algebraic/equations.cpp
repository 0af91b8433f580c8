#include "nlmech/algebraic/equations.hpp"

#include <fmt/format.h>

#include <utility>

#include "nlmech/algebraic/linear_solver.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
namespace {

/// Thrown by the residual when the observer stops the iteration.
struct Interrupted {};

/// Newton's workspace with dense or sparse factors, as the equations store B.
struct Work {
  explicit Work(const Equations& of)
      : equations(of), residual(of.size()), update(of.size()), trial(of.size()), lu(of) {}
  template <class Derivative>
  [[nodiscard]] Outcome factorise(Derivative& derivative, const Eigen::VectorXd& x) {
    derivative(x);
    return lu.factorise(equations);
  }
  [[nodiscard]] Outcome solve() { return lu.solve(residual, update); }

  const Equations& equations;
  Eigen::VectorXd residual, update, trial;
  LinearSolver lu;
};

std::string sentence(const char* name, Outcome outcome, const Report& report, int iterations) {
  switch (outcome) {
    case Outcome::singular_matrix:
      return fmt::format("{}: the matrix dF/dx is singular at iteration {}, |F| = {:.3g}; start elsewhere",
                         name, report.statistics.newton_iterations, report.last);
    case Outcome::non_finite:
      return fmt::format("{}: F or dF/dx is not finite at iteration {}; start elsewhere", name,
                         report.statistics.newton_iterations);
    case Outcome::interrupted:
      return fmt::format("{}: stopped by the observer at iteration {}", name,
                         report.statistics.newton_iterations);
    case Outcome::not_converged:
      if (report.statistics.newton_iterations < iterations)
        return fmt::format(
            "{}: at iteration {}, with |F| = {:.3g}: no shorter step makes |F| smaller: a minimum that is no "
            "root, or rounding; start elsewhere or loosen the tolerance",
            name, report.statistics.newton_iterations, report.last);
      [[fallthrough]];
    default:
      return fmt::format(
          "{}: not converged after {} of {} iterations, |F| = {:.3g}; allow "
          "more, damp them, or start closer",
          name, report.statistics.newton_iterations, iterations, report.last);
  }
}

template <class Method>
Report run(const char* name, const Method& method, Equations& equations, Eigen::VectorXd& x,
           const Observer& observer) {
  require_size(name, equations, x);
  Report report;
  Work work(equations);
  Outcome outcome = Outcome::interrupted;
  const auto residual = [&](const Eigen::VectorXd& at, Eigen::VectorXd& f) {
    equations.residual(at, f);
    const double norm = f.norm();
    const std::int64_t index = report.statistics.right_hand_sides++;
    report.last = norm;
    if (index == 0) report.first = report.least = norm;
    report.least = std::min(report.least, norm);
    if (observer && !observer({index, static_cast<double>(index), at, f, norm})) throw Interrupted{};
  };
  const auto derivative = [&](const Eigen::VectorXd& at) { equations.linearise(at); };
  try {
    outcome = solve(method, residual, derivative, x, work, report.statistics);
  } catch (const Interrupted&) {
    outcome = Outcome::interrupted;
  }
  report.statistics.steps = report.statistics.newton_iterations;
  if (outcome != Outcome::success)
    report.status = Status::failure(outcome, sentence(name, outcome, report, method.iterations));
  return report;
}

}  // namespace

void Equations::matrix(Eigen::MatrixXd& b) const {
  static_cast<void>(b);
  throw std::logic_error(
      "algebraic: these equations offer products with dF/dx only; the method needs its "
      "matrix");
}

DenseEquations::DenseEquations(Eigen::Index n, Residual residual, Derivative derivative)
    : residual_(std::move(residual)), derivative_(std::move(derivative)) {
  if (n < 1) throw invalid_argument("DenseEquations: {} unknowns; at least 1 is needed", n);
  if (!residual_ || !derivative_)
    throw std::invalid_argument("DenseEquations: residual or derivative is empty");
  b_.setZero(n, n);
}

void DenseEquations::apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const { out.noalias() = b_ * v; }

void DenseEquations::apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
  out.resize(b_.cols());
  for (Eigen::Index j = 0; j < b_.cols(); ++j) out[j] = b_.col(j).dot(v);
}

void require_size(const char* what, const Equations& equations, const Eigen::VectorXd& x) {
  if (x.size() == equations.size()) return;
  throw invalid_argument("{}: the start has {} components, the equations {}", what, x.size(),
                         equations.size());
}

Report find_root(const Newton& method, Equations& equations, Eigen::VectorXd& x, const Observer& observer) {
  return run("newton", method, equations, x, observer);
}

Report find_root(const DampedNewton& method, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  return run("damped-newton", method, equations, x, observer);
}

}  // namespace nlmech::algebraic

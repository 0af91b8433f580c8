#include "chapters/homotopy/paths/limit_point.hpp"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "nlmech/algebraic/linear_solver.hpp"
#include "nlmech/algebraic/newton/energy_trust_region.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::homotopy {

using Eigen::Index;

LimitPoint::LimitPoint(const frames::Frame& frame, Eigen::VectorXd load, double stiffness)
    : frame_(frame), load_(std::move(load)), stiffness_(stiffness) {
  linearise(Eigen::VectorXd::Zero(size()));  // the pattern
}

template <class T>
Status LimitPoint::put(const Column<T>& z, Column<T>& f) const {
  const Index n = frame_.size();
  const Column<T> x = z.head(n), phi = z.segment(n, n);
  Column<T> force;
  Eigen::SparseMatrix<T> k;
  Status status = frame_.force<T>(x, force);
  if (frames::has_values(status)) status = frame_.tangent<T>(x, k);
  f.resize(2 * n + 1);
  if (!frames::has_values(status)) {
    f.setConstant(T(HUGE_VAL));
    return status;
  }
  f.head(n) = (force - z[2 * n] * load_.cast<T>()) / T(load_.norm());
  f.segment(n, n) = k * phi / T(stiffness_);
  f[2 * n] = (phi.squaredNorm() - 1) / 2;
  return status;
}

/// The columns one after another, each from its top: those by x have K and dK/dx phi, those by phi K and
/// phi^T, that by W the loads.
template <class T>
Status LimitPoint::put_derivative(const Column<T>& z, Eigen::SparseMatrix<T>& b) const {
  using D = Dual<T, 1>;
  const Index n = frame_.size();
  Column<D> x(n);
  for (Index i = 0; i < n; ++i) {
    x[i].value = z[i];
    x[i].partial[0] = z[n + i];
  }
  Eigen::SparseMatrix<D> k;
  Status status = frame_.tangent<D>(x, k);
  const T unit(load_.norm()), stiffness(stiffness_);
  const auto add_column = [&](Index column, Index top, const auto& value) {
    for (typename Eigen::SparseMatrix<D>::InnerIterator it(k, column % n); it; ++it)
      b.insertBack(top + it.row(), column) = value(it.value());
  };
  b.resize(2 * n + 1, 2 * n + 1);
  b.reserve(3 * k.nonZeros() + 2 * n);
  for (Index column = 0; column < 2 * n; ++column) {
    b.startVec(column);
    if (column < n) {
      add_column(column, 0, [&](const D& v) { return v.value / unit; });
      add_column(column, n, [&](const D& v) { return v.partial[0] / stiffness; });
    } else {
      add_column(column, n, [&](const D& v) { return v.value / stiffness; });
      b.insertBack(2 * n, column) = z[column];
    }
  }
  b.startVec(2 * n);
  for (Index i = 0; i < n; ++i) {
    if (load_[i] != 0) b.insertBack(i, 2 * n) = -load_[i] / unit;
  }
  b.finalize();
  if (!frames::has_values(status)) b.coeffs().setConstant(T(HUGE_VAL));
  return status;
}

long double LimitPoint::refined(const Eigen::VectorXd& z) const {
  using T = long double;
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  Column<T> root = z.cast<T>(), f;
  Eigen::SparseMatrix<T> b;
  for (int i = 0; i < 4; ++i) {
    if (!frames::has_values(put<T>(root, f)) || !frames::has_values(put_derivative<T>(root, b)))
      throw Failure("the reference of the limit point has no stiffness");
    root -= Eigen::PartialPivLU<Matrix>(Matrix(b)).solve(f);
  }
  return root[root.size() - 1];
}

LimitPointStart limit_point_start(const frames::Frame& frame, const Eigen::VectorXd& load, double factor) {
  const Index n = frame.size();
  frames::Equilibrium equations(frame, load, factor);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), tangent(n);
  const algebraic::Report report = find_root(algebraic::EnergyTrustRegion{}, equations, x);
  if (!report.status.ok()) throw Failure(report.status);
  equations.linearise(x);
  algebraic::LinearSolver solver(equations);
  if (solver.factorise(equations) != Outcome::success || solver.solve(load, tangent) != Outcome::success)
    throw Failure("the start has no tangent");
  LimitPointStart start{Eigen::VectorXd(2 * n + 1), load.norm() / tangent.norm(), report.statistics};
  ++start.statistics.factorisations;
  start.z << x, tangent.normalized(), factor;
  return start;
}

}  // namespace nlmech::chapters::homotopy

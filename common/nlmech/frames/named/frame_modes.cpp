#include "nlmech/frames/named/frame_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "nlmech/algebraic/symmetric_solver.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// The greatest positive eigenvalues mu of A v = mu K v, descending, with vectors as columns.
struct Pairs {
  VectorXd values;
  MatrixXd vectors;
};

/// Eigenpairs of A v = mu K v for a positive definite K and a symmetric A, both with the scales S.
class Pencil {
 public:
  Pencil(const Sparse& k, const Sparse& a) : k_(k), a_(a), scale_(algebraic::scale_of(k.diagonal())) {
    solver_.take(k_, scale_);
    is_definite_ = solver_.is_finite() && solver_.factorise().is_positive();
  }

  [[nodiscard]] bool is_definite() const { return is_definite_; }

  /// The @p count greatest positive values, or all if there are fewer; empty without convergence. Small
  /// matrices are diagonalised.
  [[nodiscard]] std::optional<Pairs> greatest(Index count) const {
    constexpr Index small = 200;
    const Index n = k_.rows();
    for (Index columns = std::max(2 * count, count + 8); n > small && 2 * columns < n; columns *= 2) {
      std::optional<Pairs> found = iterate(count, columns);
      if (!found || (found->values.minCoeff() > 0 && misses_none(found->values))) return found;
    }
    const auto dense = [&](const Sparse& m) { return apply(m, MatrixXd::Identity(n, n)); };
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> all(symmetric(dense(a_)), symmetric(dense(k_)));
    const double least = 1e-14 * all.eigenvalues().cwiseAbs().maxCoeff();
    const Index positive = std::min(count, static_cast<Index>((all.eigenvalues().array() > least).count()));
    return pairs(all, positive, MatrixXd::Identity(n, n));
  }

 private:
  /// S^-1 M S^-1 v for each column.
  [[nodiscard]] MatrixXd apply(const Sparse& m, const MatrixXd& v) const {
    const VectorXd inverse = scale_.cwiseInverse();
    return inverse.asDiagonal() * (m * MatrixXd(inverse.asDiagonal() * v));
  }

  /// The greatest @p count values of a solver whose vectors are in the basis @p basis.
  template <class Solver>
  [[nodiscard]] Pairs pairs(const Solver& solver, Index count, const MatrixXd& basis) const {
    return {solver.eigenvalues().tail(count).reverse(),
            scale_.cwiseInverse().asDiagonal() *
                MatrixXd(basis * solver.eigenvectors().rightCols(count).rowwise().reverse())};
  }

  /// Subspace iteration (Bathe): each step solves with K and diagonalises A in the space of the columns. Its
  /// basis is orthonormal in K; directions without a share of A fall out.
  [[nodiscard]] std::optional<Pairs> iterate(Index count, Index columns) const {
    constexpr int most = 200;
    MatrixXd x(k_.rows(), columns);
    for (Index j = 0; j < columns; ++j) {
      for (Index i = 0; i < x.rows(); ++i) x(i, j) = std::sin(1. + static_cast<double>(i * (2 * j + 1)));
    }
    VectorXd before;
    for (int step = 0; step < most; ++step) {
      const MatrixXd forces = apply(a_, x);
      MatrixXd y(x.rows(), x.cols());
      VectorXd column(x.rows());
      for (Index j = 0; j < x.cols(); ++j) {
        solver_.solve(forces.col(j), column);
        y.col(j) = column;
      }
      const Eigen::SelfAdjointEigenSolver<MatrixXd> gram(symmetric(y.transpose() * forces));
      const Index rank = (gram.eigenvalues().array() > 1e-14 * gram.eigenvalues().maxCoeff()).count();
      if (rank < count) return Pairs{VectorXd::Zero(1), {}};  // few modes: diagonalise
      const MatrixXd basis = y * gram.eigenvectors().rightCols(rank) *
                             gram.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
      const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(symmetric(basis.transpose() * apply(a_, basis)));
      const VectorXd now = ritz.eigenvalues().tail(count);
      if (before.size() > 0 &&
          ((now - before).array().abs() <=
           (1e-12 * now.array().abs()).max(4e-15 * ritz.eigenvalues().cwiseAbs().maxCoeff()))
              .all())
        return pairs(ritz, count, basis);
      before = now;
      x = basis * ritz.eigenvectors();
    }
    return std::nullopt;
  }

  static MatrixXd symmetric(const MatrixXd& m) { return (m + m.transpose()) / 2; }

  /// Is the number of negative eigenvalues of K - s A, with s just below the last 1/mu, that of the values
  /// above?
  [[nodiscard]] bool misses_none(const VectorXd& values) const {
    const double last = values[values.size() - 1] * (1 + 1e-6);
    algebraic::SymmetricSolver shifted;
    shifted.take(Sparse(k_ - a_ / last), scale_);
    return shifted.factorise().negative == (values.array() > last).count();
  }

  const Sparse &k_, &a_;
  VectorXd scale_;
  algebraic::SymmetricSolver solver_;
  bool is_definite_ = false;
};

/// The shape of all unknowns, scaled as FrameMode says.
VectorXd scaled(const Frame& frame, const VectorXd& shape) {
  if (const double factor = factor_of(frame, shape); std::isfinite(factor)) return factor * shape;
  const double most = shape.cwiseAbs().maxCoeff();
  Index first = 0;
  while (first + 1 < shape.size() && !(std::abs(shape[first]) >= (1 - 1e-6) * most)) ++first;
  return shape / shape[first];
}

}  // namespace

std::string_view to_string(FrameMode::Kind kind) noexcept {
  return kind == FrameMode::Kind::buckling ? "buckling" : "vibration";
}

FrameModes frame_modes(const NamedFrame& frame, const VectorXd& x, double load, int count) {
  if (count < 1) throw invalid_argument("frame_modes: {} modes", count);
  FrameModes out;
  LoadedFrame equations(frame);
  const VectorXd free = equations.free(x);
  equations.linearise(free, load);
  const Sparse k = *equations.sparse();
  const auto add = [&](FrameMode::Kind kind, const Sparse& a, const auto& value_of) {
    const Pencil pencil(k, a);
    if (!pencil.is_definite()) {
      out.status =
          failed_with(Outcome::wrong_branch,
                      "frame: at the load factor {:.10g} the equilibrium is not stable, and has no modes; "
                      "take a smaller load factor",
                      load);
      return;
    }
    const std::optional<Pairs> pairs = pencil.greatest(count);
    if (!pairs) {
      out.status =
          failed_with(Outcome::not_converged,
                      "frame: {} {} modes at the load factor {:.10g} do not converge; take fewer modes",
                      count, to_string(kind), load);
      return;
    }
    for (Index i = 0; i < pairs->values.size(); ++i)
      out.modes.push_back({kind, value_of(1 / pairs->values[i]),
                           scaled(frame.frame, equations.shape(pairs->vectors.col(i)))});
  };
  if (frame.load.cwiseAbs().maxCoeff() > 0 || frame.displacement.cwiseAbs().maxCoeff() > 0) {
    const std::optional<Sparse> geometric = equations.geometric(free, load);
    if (!geometric) {
      out.status = equations.status().ok()
                       ? failed_with(Outcome::singular_matrix,
                                     "frame: the stiffness is singular at the load factor {:.10g}", load)
                       : equations.status();
      return out;
    }
    add(FrameMode::Kind::buckling, Sparse(-*geometric), [&](double value) { return load + value; });
  }
  const VectorXd mass = equations.free(frame.mass);
  if (out.status.ok() && mass.maxCoeff() > 0) {
    Sparse m(mass.size(), mass.size());
    for (Index i = 0; i < mass.size(); ++i) m.insert(i, i) = mass[i];
    m.makeCompressed();
    add(FrameMode::Kind::vibration, m,
        [](double value) { return std::sqrt(value) / (2 * std::numbers::pi); });
  }
  return out;
}

}  // namespace nlmech::frames

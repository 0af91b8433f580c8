#include "nlmech/algebraic/newton/least_squares.hpp"

#include <Eigen/QR>
#include <Eigen/SparseQR>
#include <cmath>

#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

class GaussNewton {
 public:
  GaussNewton(const LeastSquares& method, SolverRun& run)
      : method_(method), run_(run), update_(run.x.size()), image_(run.x.size()) {
    if (!run.equations().sparse()) matrix_.resize(run.x.size(), run.x.size());
  }

  Outcome step() {
    run_.linearise(run_.x);
    ++run_.statistics().factorisations;
    ++run_.statistics().newton_iterations;
    const Outcome outcome = solve();
    if (outcome != Outcome::success) return outcome;
    run_.equations().apply(update_, image_);  // its norm is that of the component of F in the range of B
    const double cosine = image_.norm() / run_.norm;
    if (!(cosine * cosine >= least_cosine_squared)) return Outcome::not_converged;
    run_.trial = run_.x - update_;
    run_.evaluate_trial();
    return run_.trial_norm < HUGE_VAL ? run_.accept() : Outcome::non_finite;
  }

 private:
  // The update, to be subtracted.
  Outcome solve() {
    const SparseMatrix* const sparse = run_.equations().sparse();
    if (!sparse) {
      run_.equations().matrix(matrix_);
      return matrix_.allFinite() ? solve_dense() : Outcome::non_finite;
    }
    if (!sparse->coeffs().allFinite()) return Outcome::non_finite;
    Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>> qr;
    // Columns with a shorter remainder count as linearly dependent.
    qr.setPivotThreshold(method_.rank * sparse->norm());
    qr.compute(*sparse);
    if (qr.info() == Eigen::Success && qr.rank() == sparse->cols()) {
      update_ = qr.solve(run_.f);
      if (update_.allFinite()) return Outcome::success;
    }
    ++run_.statistics().fallbacks;
    matrix_ = *sparse;
    return solve_dense();
  }

  Outcome solve_dense() {
    decomposition_.setThreshold(method_.rank);
    decomposition_.compute(matrix_);
    update_ = decomposition_.solve(run_.f);
    return update_.allFinite() ? Outcome::success : Outcome::non_finite;
  }

  const LeastSquares& method_;
  SolverRun& run_;
  VectorXd update_, image_;
  MatrixXd matrix_;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition_;
};

}  // namespace

Report find_root(const LeastSquares& method, Equations& equations, VectorXd& x, const Observer& observer) {
  constexpr const char* name = "least-squares";
  require_option(name, method.rank > 0 && method.rank < 1, "rank", method.rank, "positive and below 1");
  return iterate<GaussNewton>(name, method, equations, x, observer);
}

}  // namespace nlmech::algebraic

#include <Eigen/QR>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "nlmech/algebraic/newton/least_squares.hpp"
#include "nlmech/algebraic/solver_run.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

/// The minimiser of |F + B d|^2 + mu |d|^2.
class DampedSystem {
 public:
  explicit DampedSystem(const Equations& equations) {
    const Eigen::Index n = equations.size();
    if (equations.sparse()) return;
    stacked_.resize(2 * n, n);
    qr_ = Eigen::HouseholderQR<MatrixXd>(2 * n, n);
    side_.resize(2 * n);
    matrix_.resize(n, n);
  }

  /// Loads B. @return the greatest squared column norm; NaN or infinite if an entry is
  double load(const Equations& equations) {
    if (!equations.sparse()) {
      equations.matrix(matrix_);
      return matrix_.allFinite() ? matrix_.colwise().squaredNorm().maxCoeff() : HUGE_VAL;
    }
    const SparseMatrix& b = *equations.sparse();
    if (!b.coeffs().allFinite()) return HUGE_VAL;
    double greatest = 0;
    for (Eigen::Index j = 0; j < b.cols(); ++j) greatest = std::max(greatest, b.col(j).squaredNorm());
    return greatest;
  }

  bool solve(const Equations& equations, const VectorXd& f, double mu, VectorXd& d) {
    if (equations.sparse()) return solve_sparse(*equations.sparse(), f, mu, d);
    const Eigen::Index n = f.size();
    stacked_.topRows(n) = matrix_;
    stacked_.bottomRows(n).setZero();
    stacked_.bottomRows(n).diagonal().setConstant(std::sqrt(mu));
    qr_.compute(stacked_);
    side_ << -f, VectorXd::Zero(n);
    side_.applyOnTheLeft(qr_.householderQ().adjoint());
    d = qr_.matrixQR().topRows(n).triangularView<Eigen::Upper>().solve(side_.head(n));
    return d.allFinite();
  }

 private:
  // s r + B d = -F and B^T r - s d = 0 with s = sqrt(mu): this scaling keeps the condition number that of QR.
  bool solve_sparse(const SparseMatrix& b, const VectorXd& f, double mu, VectorXd& d) {
    const Eigen::Index n = f.size();
    const double s = std::sqrt(mu);
    entries_.clear();
    for (Eigen::Index j = 0; j < n; ++j) {
      entries_.emplace_back(j, j, s);
      entries_.emplace_back(n + j, n + j, -s);
      for (SparseMatrix::InnerIterator it(b, j); it; ++it) {
        entries_.emplace_back(it.row(), n + j, it.value());
        entries_.emplace_back(n + j, it.row(), it.value());
      }
    }
    augmented_.resize(2 * n, 2 * n);
    augmented_.setFromTriplets(entries_.begin(), entries_.end());
    if (!is_analysed_) lu_.analyzePattern(augmented_);
    is_analysed_ = true;
    lu_.factorize(augmented_);
    if (lu_.info() != Eigen::Success) return false;
    side_.resize(2 * n);
    side_ << -f, VectorXd::Zero(n);
    d = lu_.solve(side_).tail(n);
    return d.allFinite();
  }

  MatrixXd matrix_, stacked_;
  Eigen::HouseholderQR<MatrixXd> qr_;
  VectorXd side_;
  SparseMatrix augmented_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SparseLU<SparseMatrix> lu_;
  bool is_analysed_ = false;
};

class Marquardt {
 public:
  Marquardt(const LevenbergMarquardt& method, SolverRun& run)
      : method_(method),
        run_(run),
        system_(run.equations()),
        update_(run.x.size()),
        image_(run.x.size()),
        gradient_(run.x.size()) {}

  Outcome step() {
    if (!is_loaded_) {
      const Outcome outcome = load();
      if (outcome != Outcome::success) return outcome;
    }
    ++run_.statistics().factorisations;
    ++run_.statistics().newton_iterations;
    if (!system_.solve(run_.equations(), run_.f, mu_, update_)) return refuse();
    if (update_.norm() <= 1e-16 * run_.x.norm()) return Outcome::not_converged;
    run_.trial = run_.x + update_;
    run_.equations().apply(update_, image_);
    run_.evaluate_trial();
    const double trial = run_.trial_norm / run_.norm;
    const double model = (run_.f + image_).squaredNorm() / run_.norm / run_.norm;
    const double ratio = (1 - trial) * (1 + trial) / (1 - model);
    if (!(trial < 1 && ratio > 1e-4)) return refuse();
    mu_ *= std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3));
    factor_ = 2;
    is_loaded_ = false;
    return run_.accept();
  }

 private:
  Outcome load() {
    run_.linearise(run_.x);
    const double greatest = system_.load(run_.equations());
    if (!std::isfinite(greatest)) return Outcome::non_finite;
    run_.equations().apply_transposed(run_.f, gradient_);
    const double slope = gradient_.norm();
    if (slope == 0) return Outcome::singular_matrix;
    run_.equations().apply(gradient_, image_);
    const double cosine = slope / image_.norm() * (slope / run_.norm);  // angle of F and B B^T F
    if (!(cosine * cosine >= least_cosine_squared)) return Outcome::not_converged;
    if (mu_ < 0) mu_ = method_.damping * greatest;
    is_loaded_ = true;
    return Outcome::success;
  }

  Outcome refuse() {
    mu_ *= factor_;
    factor_ *= 2;
    run_.reject();
    return std::isfinite(mu_) ? Outcome::success : Outcome::not_converged;
  }

  const LevenbergMarquardt& method_;
  SolverRun& run_;
  DampedSystem system_;
  VectorXd update_, image_, gradient_;
  double mu_ = -1, factor_ = 2;
  bool is_loaded_ = false;  // B is loaded for the current iterate
};

}  // namespace

Report find_root(const LevenbergMarquardt& method, Equations& equations, VectorXd& x,
                 const Observer& observer) {
  constexpr const char* name = "levenberg-marquardt";
  require_option(name, method.damping > 0 && std::isfinite(method.damping), "damping", method.damping,
                 "positive");
  return iterate<Marquardt>(name, method, equations, x, observer, stationary);
}

}  // namespace nlmech::algebraic

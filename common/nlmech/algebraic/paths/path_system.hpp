/// @file
/// Scaled equations with a load parameter, and the bordered linear systems of path following.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <memory>

#include "nlmech/algebraic/paths/loaded.hpp"
#include "nlmech/algebraic/symmetric_solver.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::algebraic {

/// A point or a direction in the space of scaled unknowns y = S x and load m = c load.
struct PathVector {
  Eigen::VectorXd y;         ///< S x
  double m = 0;              ///< c load
  Eigen::VectorXd low = {};  ///< low-order part of S x in a system in long double; empty: 0
  /// Euclidean inner product in (y, m).
  [[nodiscard]] double dot(const PathVector& other) const { return y.dot(other.y) + m * other.m; }
  /// Euclidean norm.
  [[nodiscard]] double norm() const { return std::sqrt(dot(*this)); }
};

/// F(x, load) = 0 with x = y/S, load = m/c and F divided by S, so that lengths of different unknowns are
/// comparable; its matrix K = S^-1 (dF/dx) S^-1, its column q = S^-1 (dF/dload)/c, and systems bordered by q
/// and a row.
///
/// If double does not give the eigenvalue of K nearest to zero at the start to 7 digits, as in a frame of
/// very stiff members, points, F, K and its factors use long double throughout.
class PathSystem {
 public:
  /// @param equations must outlive this object
  /// @param x point at which the scales are computed: scale_of() of the diagonal of dF/dx, unless given
  /// @param load load at which the scales are computed
  /// @param scale diagonal of S, positive; empty: computed
  PathSystem(Loaded& equations, const Eigen::VectorXd& x, double load, const Eigen::VectorXd& scale);
  ~PathSystem();

  /// (x, load) in scaled unknowns.
  [[nodiscard]] PathVector scaled(const Eigen::VectorXd& x, double load) const;
  /// x of a scaled point or direction.
  [[nodiscard]] Eigen::VectorXd unscaled(const Eigen::VectorXd& y) const { return y.cwiseQuotient(scale_); }
  /// S.
  [[nodiscard]] const Eigen::VectorXd& scale() const { return scale_; }
  /// c, the scale of the load: |S K^-1 q|, the size of the displacements per unit load at the start. Where
  /// that exceeds a thousand times the displacements of the start, or K is singular: the size of the latter.
  [[nodiscard]] double load_scale() const { return load_scale_; }
  /// Number of unknowns.
  [[nodiscard]] Eigen::Index size() const { return scale_.size(); }

  /// Adds a step to a point; in a system in long double with the low-order part of the sum.
  void move(PathVector& at, const PathVector& step) const;
  /// Evaluates F at @p at into f(). @return false if it is not finite
  bool residual(const PathVector& at);
  /// The last residual, scaled.
  [[nodiscard]] const Eigen::VectorXd& f() const { return f_; }
  /// |F| of the last residual, Euclidean, not scaled.
  [[nodiscard]] double residual_norm() const { return norm_; }
  /// Evaluates K and q at @p at and factorises K. @return false if they are not finite
  bool linearise(const PathVector& at);
  /// Verifies inertia(): if an eigenvalue is so near to zero that rounding of K and its factors may change
  /// its sign, K is evaluated and factorised in long double; inertia(), solve() and multiply() use it until
  /// the next linearise().
  void certify();
  /// Has certify() switched to long double since the last linearise()?
  [[nodiscard]] bool is_rounded() const { return is_rounded_; }
  /// Inertia of K; if K is not symmetric, `negative` is 1 where det K < 0, else 0.
  [[nodiscard]] const Inertia& inertia() const { return inertia_; }
  /// q.
  [[nodiscard]] const Eigen::VectorXd& load_vector() const { return q_; }
  /// out = K v.
  void multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const;
  /// Largest sum of |entries| in a row of K.
  [[nodiscard]] double norm_of_matrix() const;
  /// out = K(at) v. The factors and multiply() stay those of linearise().
  void multiply_at(const PathVector& at, const Eigen::VectorXd& v, Eigen::VectorXd& out);
  /// x = K^-1 b; not usable where K is singular.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

  /// Solves (K q; r^T d)(y; m) = (f; h), where r = row.y and d = row.m, also where only K is singular: mixed
  /// block elimination (Govaerts 1991) with two steps of iterative refinement.
  /// @return false if the solution is not finite or its residual exceeds 1e-3 of (f; h)
  bool solve_bordered(const PathVector& row, const Eigen::VectorXd& f, double h, PathVector& out);
  /// Solves the bordered system with @p column in place of q.
  bool solve_bordered(const Eigen::VectorXd& column, const PathVector& row, const Eigen::VectorXd& f,
                      double h, PathVector& out);
  /// Sign of the determinant of the matrix of the last bordered system.
  [[nodiscard]] int bordered_sign() const { return sign_; }
  /// Ratio of that determinant to det K. With f = 0 and h = 1 it is 1/m, to the accuracy of K^-1 q; its sign
  /// is consistent with inertia().
  [[nodiscard]] double bordered_ratio() const { return ratio_; }

  /// Status of the equations at the last evaluation.
  [[nodiscard]] Status status() const { return equations_.status(); }
  /// The equations.
  [[nodiscard]] Loaded& equations() { return equations_; }
  /// Counters of evaluations and factorisations.
  Statistics statistics;

 private:
  bool factorise();
  bool factorise_symmetric();
  bool factorise_long();
  [[nodiscard]] double rounding_of_smallest_eigenvalue() const;
  [[nodiscard]] LongVector long_x(const PathVector& at) const;
  void solve_transposed(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  void eliminate(const PathVector& row, double delta, double delta_transposed, const PathVector& right,
                 PathVector& out);

  Loaded& equations_;
  Eigen::VectorXd scale_, x_, f_, q_, column_, left_, right_, work_;
  mutable Eigen::VectorXd balanced_;
  double load_scale_ = 1, norm_ = 0, matrix_norm_ = 0, ratio_ = 0;
  PathVector place_;         // point of the last linearise()
  Eigen::VectorXd balance_;  // S divided by the scales of the factors
  SymmetricSolver symmetric_;
  struct LongFactors;
  std::unique_ptr<LongFactors> long_;  // allocated at first use
  bool is_long_ = false, is_rounded_ = false, is_stiff_ = false;
  Eigen::SparseMatrix<double> sparse_;
  Eigen::SparseMatrix<long double> long_matrix_;
  Eigen::MatrixXd dense_, other_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Inertia inertia_;
  Eigen::Index zero_ = 0;  // number of zero eigenvalues by the factors in double
  PathVector rest_, change_, shortened_;
  int sign_ = 0;
};

/// Approximate null vector of K of norm 1, by inverse iteration with the factors of the system.
[[nodiscard]] Eigen::VectorXd null_direction(const PathSystem& system);

}  // namespace nlmech::algebraic

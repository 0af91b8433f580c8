/// @file
/// Equations with a parameter in scaled unknowns, and the bordered linear systems of path following.
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
  Eigen::VectorXd low = {};  ///< what y leaves of S x, in a system that works in long double; empty: 0
  /// Euclid's product of both.
  [[nodiscard]] double dot(const PathVector& other) const { return y.dot(other.y) + m * other.m; }
  /// Euclid's length.
  [[nodiscard]] double norm() const { return std::sqrt(dot(*this)); }
};

/// F(x, load) = 0 with x = y/S, load = m/c and F divided by S, so that lengths mean something; its matrix
/// K = S^-1 (dF/dx) S^-1, its column q = S^-1 (dF/dload)/c, and systems bordered by q and a row.
///
/// Where double does not tell the softest eigenvalue of K at the start to 7 digits, as in a frame of very
/// stiff members, places, F, K and its factors are in long double all along.
class PathSystem {
 public:
  /// @param equations must outlive this object
  /// @param x where the scales are taken: scale_of() of the diagonal of dF/dx, unless given
  /// @param load where the scales are taken
  /// @param scale diagonal of S, positive; empty: chosen
  PathSystem(Loaded& equations, const Eigen::VectorXd& x, double load, const Eigen::VectorXd& scale);
  ~PathSystem();

  /// (x, load) in scaled unknowns.
  [[nodiscard]] PathVector scaled(const Eigen::VectorXd& x, double load) const;
  /// x of a point or of a direction.
  [[nodiscard]] Eigen::VectorXd unscaled(const Eigen::VectorXd& y) const { return y.cwiseQuotient(scale_); }
  /// S.
  [[nodiscard]] const Eigen::VectorXd& scale() const { return scale_; }
  /// c: a load counts as much as the displacements that it causes at the start, |S K^-1 q|; or, where these
  /// are more than a thousand times those of the start or K is singular, as these.
  [[nodiscard]] double load_scale() const { return load_scale_; }
  /// Number of unknowns.
  [[nodiscard]] Eigen::Index size() const { return scale_.size(); }

  /// Adds a step to a place, with what the sum in double leaves if the system works in long double.
  void move(PathVector& at, const PathVector& step) const;
  /// Does it work in long double all along?
  [[nodiscard]] bool is_stiff() const { return is_stiff_; }
  /// F there, in f(); false if it is not finite.
  bool residual(const PathVector& at);
  /// The residual computed last, scaled.
  [[nodiscard]] const Eigen::VectorXd& f() const { return f_; }
  /// |F|, Euclidean, not scaled, of the residual computed last.
  [[nodiscard]] double residual_norm() const { return norm_; }
  /// K and q there, K factorised; false if they are not finite.
  bool linearise(const PathVector& at);
  /// Makes sure of inertia(): if an eigenvalue is so near to zero that the rounding of K and its factors may
  /// have changed its sign, K is taken and factorised in long double, for inertia(), solve() and multiply()
  /// until the next linearise().
  void certify();
  /// Has certify() found an eigenvalue so near to zero since the last linearise()?
  [[nodiscard]] bool is_rounded() const { return is_rounded_; }
  /// Signs of the eigenvalues of K; if it is not symmetric, `negative` is 1 where det K < 0, and else 0.
  [[nodiscard]] const Inertia& inertia() const { return inertia_; }
  /// q.
  [[nodiscard]] const Eigen::VectorXd& load_vector() const { return q_; }
  /// out = K v.
  void multiply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const;
  /// Largest sum of |entries| in a row of K.
  [[nodiscard]] double norm_of_matrix() const;
  /// out = K(at) v. The factors and multiply() stay those of linearise().
  void multiply_at(const PathVector& at, const Eigen::VectorXd& v, Eigen::VectorXd& out);
  /// x = K^-1 b; useless where K is singular.
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

  /// Solves (K q; r^T d)(y; m) = (f; h), where r = row.y and d = row.m, also where K is singular and the
  /// whole is not: by block elimination mixed after Govaerts (1991), refined twice.
  /// @return false if the solution is not finite or leaves more than 1e-3 of (f; h)
  bool solve_bordered(const PathVector& row, const Eigen::VectorXd& f, double h, PathVector& out);
  /// The same with another column than q.
  bool solve_bordered(const Eigen::VectorXd& column, const PathVector& row, const Eigen::VectorXd& f,
                      double h, PathVector& out);
  /// Sign of the determinant of the matrix of the last bordered system.
  [[nodiscard]] int bordered_sign() const { return sign_; }
  /// That determinant by the one of K. With f = 0 and h = 1 it is 1/m, to as many digits as K^-1 q has: its
  /// sign and that of inertia() go together.
  [[nodiscard]] double bordered_ratio() const { return ratio_; }

  /// What the equations say of the place asked for last.
  [[nodiscard]] Status status() const { return equations_.status(); }
  /// The equations.
  [[nodiscard]] Loaded& equations() { return equations_; }
  /// Evaluations and factorisations so far.
  Statistics statistics;

 private:
  bool factorise();
  bool factorise_symmetric();
  bool factorise_long();
  [[nodiscard]] double rounding_of_softest() const;
  [[nodiscard]] LongVector long_x(const PathVector& at) const;
  void solve_transposed(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  void eliminate(const PathVector& row, double delta, double delta_transposed, const PathVector& right,
                 PathVector& out);

  Loaded& equations_;
  Eigen::VectorXd scale_, x_, f_, q_, column_, left_, right_, work_;
  mutable Eigen::VectorXd balanced_;
  double load_scale_ = 1, norm_ = 0, matrix_norm_ = 0, ratio_ = 0;
  PathVector place_;         // of linearise()
  Eigen::VectorXd balance_;  // S by the scales of the factors
  SymmetricSolver symmetric_;
  struct LongFactors;
  std::unique_ptr<LongFactors> long_;  // made when they are needed
  bool is_long_ = false, is_rounded_ = false, is_stiff_ = false;
  Eigen::SparseMatrix<double> sparse_;
  Eigen::SparseMatrix<long double> long_matrix_;
  Eigen::MatrixXd dense_, other_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Inertia inertia_;
  Eigen::Index zero_ = 0;  // eigenvalues that are zero to the factors in double
  PathVector rest_, change_, shortened_;
  int sign_ = 0;
};

/// A unit vector near the null vector of K, by inverse iteration with the factors of the system.
[[nodiscard]] Eigen::VectorXd null_direction(const PathSystem& system);

}  // namespace nlmech::algebraic

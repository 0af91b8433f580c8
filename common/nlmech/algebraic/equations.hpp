/// @file
/// Interface of the nonlinear equations F(x) = 0, and the report of a solver.
///
/// One interface for all methods. A method is a struct of options, such as Newton or ScalarHomotopy, and a
/// function
///
///     Report find_root(const Method& method, Equations& equations, Eigen::VectorXd& x,
///                      const Observer& observer = {});
///
/// which starts from x, writes its last iterate to x, and returns the outcome in the Report. It allocates
/// only before its first iteration. A method uses the part of Equations that it needs: F alone; products with
/// B = dF/dx and its transpose, without a matrix; or the matrix, to factorise it. The same equations work
/// with all methods.
///
/// Integrators, which solve equations in every step, use the templates of newton.hpp without virtual calls.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <stdexcept>

#include "nlmech/algebraic/newton/newton.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::algebraic {

/// n equations F(x) = 0 for n unknowns, and their derivative B = dF/dx.
class Equations {
 public:
  virtual ~Equations() = default;

  /// Number n of unknowns and equations.
  [[nodiscard]] virtual Eigen::Index size() const = 0;
  /// f = F(x). Where F does not exist, f is not finite.
  virtual void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) = 0;
  /// Linearises at @p x: sets B = dF/dx(x) for apply(), apply_transposed(), matrix() and sparse().
  virtual void linearise(const Eigen::VectorXd& x) = 0;
  /// out = B v. @p v and @p out are different objects.
  virtual void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const = 0;
  /// out = B^T v. @p v and @p out are different objects.
  virtual void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const = 0;
  /// B, n by n, for methods that factorise it.
  /// @throws std::logic_error if the equations offer products only (the default)
  virtual void matrix(Eigen::MatrixXd& b) const;
  /// B in compressed sparse storage, with a fixed sparsity pattern, valid until the next linearise(); null
  /// (the default) if B is not stored sparse.
  [[nodiscard]] virtual const Eigen::SparseMatrix<double>* sparse() const { return nullptr; }
  /// Why F or B did not exist at the last evaluation, if the equations know the cause.
  [[nodiscard]] virtual Status status() const { return {}; }
};

/// F = dV/dx: the roots are stationary points of V, and B, its Hessian, is symmetric.
///
/// Past a limit point |F| has minima that are no roots, and a method that only reduces |F| stops there. V has
/// no such minima: a minimum of V is a root and a stable equilibrium.
class Potential : public Equations {
 public:
  /// Potential V(x); not finite where V does not exist.
  [[nodiscard]] virtual double energy(const Eigen::VectorXd& x) = 0;
};

/// Equations given by two functions, F and dF/dx.
class DenseEquations : public Equations {
 public:
  /// Writes F(x) to its second argument, which is sized.
  using Residual = std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>;
  /// Writes dF/dx to its second argument, which is sized.
  using Derivative = std::function<void(const Eigen::VectorXd&, Eigen::MatrixXd&)>;

  /// @param n number of unknowns, at least 1
  /// @param residual F
  /// @param derivative dF/dx
  /// @throws std::invalid_argument if n is below 1 or a function is empty
  DenseEquations(Eigen::Index n, Residual residual, Derivative derivative);

  [[nodiscard]] Eigen::Index size() const override { return b_.rows(); }
  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) override { residual_(x, f); }
  void linearise(const Eigen::VectorXd& x) override { derivative_(x, b_); }
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override;
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override;
  void matrix(Eigen::MatrixXd& b) const override { b = b_; }

 private:
  Residual residual_;
  Derivative derivative_;
  Eigen::MatrixXd b_;
};

/// Iterate passed to an observer. The references are valid only during the call.
struct Iterate {
  std::int64_t index;        ///< 0 for the start
  double time;               ///< fictitious time, if the method has one; else the index
  const Eigen::VectorXd& x;  ///< the iterate
  const Eigen::VectorXd& f;  ///< F(x)
  double norm;               ///< |F|, Euclidean
};

/// Callback for every accepted iterate, including the start; returns true to continue, false to stop with
/// `interrupted`.
using Observer = std::function<bool(const Iterate&)>;

/// Result of a solve: outcome, counters and residual norms.
struct Report {
  Status status;          ///< success, or the failure with place and remedy
  Statistics statistics;  ///< steps: accepted iterations; right_hand_sides: evaluations of F; jacobians: of B
  double first = 0;       ///< |F| at the start, Euclidean
  double least = 0;       ///< smallest |F| of all iterates
  double last = 0;        ///< |F| at the last iterate, which is in x
  double time = 0;        ///< fictitious time of the last iterate; 0 for methods that have none
  double bound = 0;       ///< bound on `last` applied by checked_against_tolerance(); else 0
};

/// Throws std::invalid_argument, naming @p what, unless @p x has as many components as there are equations.
void require_size(const char* what, const Equations& equations, const Eigen::VectorXd& x);

/// Newton's iteration; needs the matrix. The tolerance bounds the update. `first`, `least` and `last` refer
/// to the iterates at which F was evaluated; the returned root is one update beyond `last`.
/// @throws std::invalid_argument if x has another size than the equations, std::logic_error if they have no
/// matrix
[[nodiscard]] Report find_root(const Newton& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});
/// Damped Newton iteration, as find_root(Newton); the observer and the norms include trial points.
[[nodiscard]] Report find_root(const DampedNewton& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

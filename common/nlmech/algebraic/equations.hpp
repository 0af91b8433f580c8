/// @file
/// F(x) = 0 as every solver of this component sees it, and what every solver reports.
///
/// One interface for all methods. A method is a struct of options, such as Newton or ScalarHomotopy, and a
/// function
///
///     Report find_root(const Method& method, Equations& equations, Eigen::VectorXd& x,
///                      const Observer& observer = {});
///
/// which starts from x, leaves its last iterate there, and tells by the Report how it ended. It allocates
/// before its first iteration and not after. A method takes of Equations what it needs: F alone; products
/// with B = dF/dx and its transpose, which never need a matrix; or the matrix, to factorise it. So the same
/// equations go to all methods, and methods can be set side by side.
///
/// Inside an integrator, where a solve is a part of a step, the templates of newton.hpp do the same without
/// virtual calls.
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

  /// n, of unknowns and equations.
  [[nodiscard]] virtual Eigen::Index size() const = 0;
  /// f = F(x). An f that is not finite says that F does not exist at x.
  virtual void residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) = 0;
  /// From now on B is that of @p x.
  virtual void linearise(const Eigen::VectorXd& x) = 0;
  /// out = B v. @p v and @p out are different objects.
  virtual void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const = 0;
  /// out = B^T v. @p v and @p out are different objects.
  virtual void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const = 0;
  /// B, n by n, for methods that factorise it.
  /// @throws std::logic_error if the equations offer products only, as they do unless they say otherwise
  virtual void matrix(Eigen::MatrixXd& b) const;
  /// B as the equations store it, if that is sparse: compressed, of a pattern that never changes, valid until
  /// the next linearise(). Null, unless the equations say otherwise.
  [[nodiscard]] virtual const Eigen::SparseMatrix<double>* sparse() const { return nullptr; }
  /// Why F or B did not exist where it was asked for last, if the equations know more than that it is not
  /// finite.
  [[nodiscard]] virtual Status status() const { return {}; }
};

/// F = dV/dx: the roots are stationary points of V, and B, its Hessian, is symmetric.
///
/// Past a limit point |F| has minima that are no roots, and a method that only lets |F| fall ends there. V
/// has none of that kind: where V is bounded below, a minimum of V is a root, and a stable equilibrium.
class Potential : public Equations {
 public:
  /// V(x); not finite where V does not exist.
  [[nodiscard]] virtual double energy(const Eigen::VectorXd& x) = 0;
};

/// Equations from two functions.
class DenseEquations : public Equations {
 public:
  /// Writes F(x) to its second argument, which has its size.
  using Residual = std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>;
  /// Writes dF/dx to its second argument, which has its size.
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

/// An iterate as an observer sees it. The references hold only during the call.
struct Iterate {
  std::int64_t index;        ///< 0 for the start
  double time;               ///< fictitious time, for methods that have one; else the index
  const Eigen::VectorXd& x;  ///< where
  const Eigen::VectorXd& f;  ///< F there
  double norm;               ///< |F|, Euclidean
};

/// Called for every accepted iterate, the start included; returns true to go on, false to end with
/// `interrupted`.
using Observer = std::function<bool(const Iterate&)>;

/// How a solver ended and what it did.
struct Report {
  Status status;          ///< success, or which failure, where, and what to change
  Statistics statistics;  ///< steps: accepted iterations; right_hand_sides: evaluations of F; jacobians: of B
  double first = 0;       ///< |F| at the start, Euclidean
  double least = 0;       ///< the least |F| of all iterates
  double last = 0;        ///< |F| at the last iterate, which x holds
  double time = 0;        ///< fictitious time of the last iterate; 0 for methods that have none
  double bound = 0;       ///< what `last` was held to, by held_to_tolerance(); else 0
};

/// Throws std::invalid_argument, naming @p what, unless @p x has as many components as there are equations.
void require_size(const char* what, const Equations& equations, const Eigen::VectorXd& x);

/// Newton's iteration; needs the matrix. Its tolerance is on the update. `first`, `least` and `last` are of
/// the iterates at which F was evaluated: the root that is handed back is one update better than `last`.
/// @throws std::invalid_argument if x has another size than the equations, std::logic_error if they have no
/// matrix
[[nodiscard]] Report find_root(const Newton& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});
/// The same with damped steps; the observer and the norms see trial points too.
[[nodiscard]] Report find_root(const DampedNewton& method, Equations& equations, Eigen::VectorXd& x,
                               const Observer& observer = {});

}  // namespace nlmech::algebraic

/// @file
/// Equations with a parameter, whose solutions form a path.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// A column in long double.
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// n equations F(x, load) = 0 for n unknowns x. K = dF/dx is symmetric, as it is where F is the gradient of a
/// potential for every load, unless is_symmetric() says otherwise.
class Loaded {
 public:
  virtual ~Loaded() = default;

  /// n, of unknowns and equations.
  [[nodiscard]] virtual Eigen::Index size() const = 0;
  /// f = F(x, load). An f that is not finite says that F does not exist there.
  virtual void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) = 0;
  /// From now on K and dF/dload are those at (x, load).
  virtual void linearise(const Eigen::VectorXd& x, double load) = 0;
  /// q = dF/dload; minus the forces of a load of 1, for a structure under dead load.
  virtual void load_vector(Eigen::VectorXd& q) const = 0;
  /// K, n by n.
  virtual void matrix(Eigen::MatrixXd& k) const = 0;
  /// K as the equations store it, if that is sparse; see Equations.
  [[nodiscard]] virtual const Eigen::SparseMatrix<double>* sparse() const { return nullptr; }
  /// K at (x, load) in long double, for the sign of an eigenvalue that the rounding of K hides. Without it
  /// the K of linearise() is all there is.
  /// @return false if the equations have none
  virtual bool long_matrix(const LongVector& x, double load, Eigen::SparseMatrix<long double>& k) {
    static_cast<void>(x), static_cast<void>(load), static_cast<void>(k);
    return false;
  }
  /// f = F(x, load) by sums in long double, of an x in long double; as residual().
  /// @return false if the equations have none, and f is as it was
  virtual bool long_residual(const LongVector& x, double load, Eigen::VectorXd& f) {
    static_cast<void>(x), static_cast<void>(load), static_cast<void>(f);
    return false;
  }
  /// How much v^T F may change if the data of the equations, such as places of nodes, change in their last
  /// digits; 0 if that is not known. An imperfection of a structure that is smaller is none.
  [[nodiscard]] virtual double data_rounding(const Eigen::VectorXd& v) const {
    static_cast<void>(v);
    return 0;
  }
  /// Is K symmetric everywhere?
  [[nodiscard]] virtual bool is_symmetric() const { return true; }
  /// Why F or K did not exist where it was asked for last, if the equations know.
  [[nodiscard]] virtual Status status() const { return {}; }
};

}  // namespace nlmech::algebraic

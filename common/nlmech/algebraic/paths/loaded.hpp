/// @file
/// Equations F(x, load) = 0 with a load parameter, whose solutions form a path.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// Column vector in long double.
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// n equations F(x, load) = 0 for n unknowns x. K = dF/dx is symmetric, as for the gradient of a potential at
/// every load, unless is_symmetric() returns false.
class Loaded {
 public:
  virtual ~Loaded() = default;

  /// Number n of unknowns and equations.
  [[nodiscard]] virtual Eigen::Index size() const = 0;
  /// f = F(x, load). Where F does not exist, f is not finite.
  virtual void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) = 0;
  /// Linearises at (x, load): sets K and dF/dload for load_vector(), matrix() and sparse().
  virtual void linearise(const Eigen::VectorXd& x, double load) = 0;
  /// q = dF/dload; minus the forces of a load of 1, for a structure under dead load.
  virtual void load_vector(Eigen::VectorXd& q) const = 0;
  /// K, n by n.
  virtual void matrix(Eigen::MatrixXd& k) const = 0;
  /// K in compressed sparse storage, or null; see Equations::sparse().
  [[nodiscard]] virtual const Eigen::SparseMatrix<double>* sparse() const { return nullptr; }
  /// K at (x, load) in long double, to determine the sign of an eigenvalue that is lost in the rounding of K.
  /// @return false (the default) if the equations do not provide it; callers then use K of linearise()
  virtual bool long_matrix(const LongVector& x, double load, Eigen::SparseMatrix<long double>& k) {
    static_cast<void>(x), static_cast<void>(load), static_cast<void>(k);
    return false;
  }
  /// f = F(x, load) as residual(), with x and sums in long double.
  /// @return false (the default) if the equations do not provide it; f is then unchanged
  virtual bool long_residual(const LongVector& x, double load, Eigen::VectorXd& f) {
    static_cast<void>(x), static_cast<void>(load), static_cast<void>(f);
    return false;
  }
  /// Change of v^T F under changes of the data of the equations, such as node coordinates, in their last
  /// digits; 0 if unknown. A smaller imperfection of a structure counts as none.
  [[nodiscard]] virtual double data_rounding(const Eigen::VectorXd& v) const {
    static_cast<void>(v);
    return 0;
  }
  /// Is K symmetric everywhere?
  [[nodiscard]] virtual bool is_symmetric() const { return true; }
  /// Why F or K did not exist at the last evaluation, if the equations know.
  [[nodiscard]] virtual Status status() const { return {}; }
};

}  // namespace nlmech::algebraic

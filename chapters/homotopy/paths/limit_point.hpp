/// @file
/// The limit point of a frame as the root of equations, for solvers that know nothing of paths.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/frames/frame.hpp"
#include "nlmech/support/statistics.hpp"

namespace nlmech::chapters::homotopy {

/// The extended system of Moore and Spence (1980) for a frame under the load W q: 2n + 1 equations
///
///     (dU/dx - W q)/|q| = 0,   K phi/k = 0,   (phi^T phi - 1)/2 = 0
///
/// for (x, phi, W). K is the stiffness and phi its null vector; k is a stiffness that makes the second group
/// comparable to the others. The derivative of K phi by x is that of K along phi, by dual numbers, and exact.
class LimitPoint final : public algebraic::Equations {
 public:
  /// @param frame must outlive this object
  /// @param load q
  /// @param stiffness k, positive
  LimitPoint(const frames::Frame& frame, Eigen::VectorXd load, double stiffness);

  /// See Equations.
  [[nodiscard]] Eigen::Index size() const override { return 2 * frame_.size() + 1; }
  /// See Equations.
  void residual(const Eigen::VectorXd& z, Eigen::VectorXd& f) override { status_ = put<double>(z, f); }
  /// See Equations.
  void linearise(const Eigen::VectorXd& z) override { status_ = put_derivative<double>(z, b_); }
  /// See Equations.
  void apply(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override { out.noalias() = b_ * v; }
  /// See Equations.
  void apply_transposed(const Eigen::VectorXd& v, Eigen::VectorXd& out) const override {
    out.noalias() = b_.transpose() * v;
  }
  /// See Equations.
  void matrix(Eigen::MatrixXd& b) const override { b = b_; }
  /// See Equations.
  [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return &b_; }
  /// What the frame said last.
  [[nodiscard]] Status status() const override { return status_; }

  /// W by Newton's iteration in extended precision. @param z near the root
  /// @throws Failure if the frame has no stiffness there
  [[nodiscard]] long double refined(const Eigen::VectorXd& z) const;

 private:
  template <class T>
  using Column = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  template <class T>
  Status put(const Column<T>& z, Column<T>& f) const;
  template <class T>
  Status put_derivative(const Column<T>& z, Eigen::SparseMatrix<T>& b) const;

  const frames::Frame& frame_;
  Eigen::VectorXd load_;
  double stiffness_;
  Eigen::SparseMatrix<double> b_;
  Status status_;
};

/// The equilibrium under a load from rest, with the path's tangent there for phi.
struct LimitPointStart {
  Eigen::VectorXd z;      ///< (x, phi, W)
  double stiffness;       ///< |q| over the displacement for a load factor of 1, by the tangent: k
  Statistics statistics;  ///< what it took
};

/// Energy is minimised under @p factor times the load. @throws Failure if there is no minimum
[[nodiscard]] LimitPointStart limit_point_start(const frames::Frame& frame, const Eigen::VectorXd& load,
                                                double factor);

}  // namespace nlmech::chapters::homotopy

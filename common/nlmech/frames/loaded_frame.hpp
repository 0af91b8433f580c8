/// @file
/// Structures under a growing dead load, as equations with a parameter.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "nlmech/algebraic/paths/loaded.hpp"
#include "nlmech/frames/frame.hpp"
#include "nlmech/frames/williams.hpp"

namespace nlmech::frames {

/// F(x, W) = dU/dx - W q for a frame, W being the load. dF/dx is sparse.
class LoadedFrame : public algebraic::Loaded {
 public:
  /// @param frame the structure; must outlive this object
  /// @param direction q, forces on the unknowns for W = 1
  /// @throws std::invalid_argument if q has another size than the frame, or is not finite
  LoadedFrame(const Frame& frame, Eigen::VectorXd direction);

  /// See Loaded.
  [[nodiscard]] Eigen::Index size() const override { return frame_.size(); }
  /// See Loaded; as frames::Equilibrium.
  void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) override;
  /// See Loaded.
  void linearise(const Eigen::VectorXd& x, double load) override;
  /// -q.
  void load_vector(Eigen::VectorXd& q) const override { q = -direction_; }
  /// See Loaded.
  void matrix(Eigen::MatrixXd& k) const override { k = tangent_; }
  /// See Loaded.
  [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return &tangent_; }
  /// See Loaded.
  bool long_matrix(const algebraic::LongVector& x, double load, Eigen::SparseMatrix<long double>& k) override;
  /// See Loaded.
  bool long_residual(const algebraic::LongVector& x, double load, Eigen::VectorXd& f) override;
  /// See Frame.
  [[nodiscard]] double data_rounding(const Eigen::VectorXd& v) const override {
    return frame_.data_rounding(v);
  }
  /// What the frame said last.
  [[nodiscard]] Status status() const override { return status_; }

 private:
  const Frame& frame_;
  Eigen::VectorXd direction_;
  Eigen::SparseMatrix<double> tangent_;
  Status status_;
};

/// F(delta, W) = (W(delta) - W)/2 for Williams' toggle: one unknown, the drop of the apex. F is not finite at
/// and past the pole of d_5.
class LoadedWilliams : public algebraic::Loaded {
 public:
  /// @throws std::invalid_argument if a number of the toggle is not positive
  explicit LoadedWilliams(const Williams& toggle);

  /// 1
  [[nodiscard]] Eigen::Index size() const override { return 1; }
  /// See Loaded.
  void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) override;
  /// See Loaded.
  void linearise(const Eigen::VectorXd& x, double load) override;
  /// -1/2.
  void load_vector(Eigen::VectorXd& q) const override { q.setConstant(1, -0.5); }
  /// See Loaded.
  void matrix(Eigen::MatrixXd& k) const override { k.setConstant(1, 1, slope_); }

 private:
  Williams toggle_;
  double slope_ = 0;
};

}  // namespace nlmech::frames
